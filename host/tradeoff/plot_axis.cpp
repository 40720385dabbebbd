// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr double room = 0.04;  ///< on each side, as a share of the range

/// A round number as short as a label has to be.
std::string tick_text(double value) {
    if (value == 0.0) return "0";
    const double magnitude = std::abs(value);
    if (magnitude >= 1e-4 && magnitude < 1e6) return fmt::format("{:.6g}", value);
    const double power = std::floor(std::log10(magnitude) + 1e-9);
    return fmt::format("{:.3g}e{:.0f}", value / std::pow(10.0, power), power);
}

/// The smallest number of 1, 2 or 5 times a power of ten that is not below `least`.
double round_step(double least) {
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
    return 10.0 * power;
}

/// About five round numbers between two others.
std::vector<AxisTick> linear_ticks(double low, double high) {
    std::vector<AxisTick> ticks;
    const double step = round_step((high - low) / 6.0);
    if (!(step > 0.0) || !std::isfinite(step)) return ticks;
    const double first = std::ceil(low / step - 1e-9);
    const double last = std::floor(high / step + 1e-9);
    for (double i = first; i <= last && ticks.size() < 20; i += 1.0) {
        const double value = i == 0.0 ? 0.0 : i * step;
        ticks.push_back({value, tick_text(value)});
    }
    return ticks;
}

/// Powers of ten between two logarithms, with ticks between them where these are few.
std::vector<AxisTick> logarithmic_ticks(double start, double end) {
    std::vector<AxisTick> ticks;
    const double decades = end - start;
    const double every = std::max(1.0, std::ceil(decades / 8.0));
    for (double power = std::floor(start / every) * every; power <= end; power += every) {
        for (int factor = 1; factor <= 9; ++factor) {
            if (factor > 1 && decades > 5.0) break;
            const double value = factor * std::pow(10.0, power);
            const double place = power + std::log10(factor);
            if (place < start - 1e-9 || place > end + 1e-9 || !(value > 0.0)) continue;
            const bool named = factor == 1 || (decades <= 3.0 && (factor == 2 || factor == 5));
            ticks.push_back({value, named ? tick_text(value) : ""});
        }
    }
    const auto named = std::count_if(ticks.begin(), ticks.end(),
                                     [](const AxisTick& tick) { return !tick.text.empty(); });
    return named >= 2 ? ticks : linear_ticks(std::pow(10.0, start), std::pow(10.0, end));
}

}  // namespace

bool has_place(double value, AxisScale scale) {
    if (!std::isfinite(value) || std::abs(value) > 1e300) return false;
    return scale == AxisScale::linear || value >= 1e-300;
}

PlotAxis::PlotAxis(AxisScale scale, std::span<const double> values) : scale_(scale) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const double value : values) {
        if (!has_place(value, scale_)) continue;
        least = std::min(least, along(value));
        most = std::max(most, along(value));
    }
    if (least <= most) {
        const double magnitude = std::max(std::abs(least), std::abs(most));
        const bool from_zero = scale_ == AxisScale::linear && least >= 0.0;
        if (from_zero) least = 0.0;
        // Labels of six digits could not tell apart ticks between values closer than that.
        const double closest = scale_ == AxisScale::logarithmic ? 1e-4 : 1e-4 * magnitude;
        if (most - least <= closest) {
            const double half = scale_ == AxisScale::logarithmic ? std::log10(2.0)
                                : magnitude > 0.0                ? 0.5 * magnitude
                                                                 : 1.0;
            if (!from_zero) least -= half;
            most += half;
        }
        const double margin = room * (most - least);
        start_ = from_zero ? 0.0 : least - margin;
        end_ = most + margin;
    }
    ticks_ = scale_ == AxisScale::logarithmic ? logarithmic_ticks(start_, end_)
                                              : linear_ticks(start_, end_);
    std::erase_if(ticks_, [this](const AxisTick& tick) { return !has_place(tick.value, scale_); });
}

double PlotAxis::along(double value) const {
    return scale_ == AxisScale::logarithmic ? std::log10(value) : value;
}

double PlotAxis::position(double value) const {
    return std::clamp((along(value) - start_) / (end_ - start_), 0.0, 1.0);
}

double PlotAxis::low() const {
    return scale_ == AxisScale::logarithmic ? std::pow(10.0, start_) : start_;
}

double PlotAxis::high() const {
    return scale_ == AxisScale::logarithmic ? std::pow(10.0, end_) : end_;
}

}  // namespace weft
