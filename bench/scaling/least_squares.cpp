// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/least_squares.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"

namespace weft::bench {
namespace {

void check_lengths(std::span<const double> x, std::span<const double> y) {
    if (x.size() != y.size())
        throw Error(ExitCode::device, "a fit was given lists of different lengths");
}

bool positive(std::span<const double> values) {
    return std::all_of(values.begin(), values.end(),
                       [](double value) { return value > 0.0 && std::isfinite(value); });
}

/// The weighted line, about the weighted means: sums of squares about 0 would cancel.
std::optional<LineFit> weighted_line(std::span<const double> x, std::span<const double> y,
                                     std::span<const double> weights) {
    if (x.empty()) return std::nullopt;
    const auto [least, most] = std::minmax_element(x.begin(), x.end());
    if (!(*most > *least)) return std::nullopt;
    double total = 0.0;
    double mean_x = 0.0;
    double mean_y = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        total += weights[i];
        mean_x += weights[i] * x[i];
        mean_y += weights[i] * y[i];
    }
    mean_x /= total;
    mean_y /= total;
    double covariance = 0.0;
    double variance = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        covariance += weights[i] * (x[i] - mean_x) * (y[i] - mean_y);
        variance += weights[i] * (x[i] - mean_x) * (x[i] - mean_x);
    }
    const double slope = covariance / variance;
    return LineFit{mean_y - slope * mean_x, slope};
}

}  // namespace

double PowerFit::at(double x) const {
    return factor * std::pow(x, exponent);
}

double AmdahlFit::at(double threads) const {
    return single * (serial + (1.0 - serial) / threads);
}

std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y) {
    check_lengths(x, y);
    if (!positive(y)) return std::nullopt;
    std::vector<double> weights;
    for (const double value : y) weights.push_back(1.0 / (value * value));
    return weighted_line(x, y, weights);
}

std::optional<PowerFit> fit_power(std::span<const double> x, std::span<const double> y) {
    check_lengths(x, y);
    if (!positive(x) || !positive(y)) return std::nullopt;
    std::vector<double> log_x;
    std::vector<double> log_y;
    for (std::size_t i = 0; i < x.size(); ++i) {
        log_x.push_back(std::log(x[i]));
        log_y.push_back(std::log(y[i]));
    }
    const auto line = weighted_line(log_x, log_y, std::vector<double>(x.size(), 1.0));
    if (!line) return std::nullopt;
    return PowerFit{std::exp(line->offset), line->slope};
}

std::optional<AmdahlFit> fit_amdahl(std::span<const double> threads, std::span<const double> y) {
    check_lengths(threads, y);
    if (!positive(threads)) return std::nullopt;
    std::vector<double> inverse;
    for (const double count : threads) inverse.push_back(1.0 / count);
    const auto line = fit_line(inverse, y);
    if (!line) return std::nullopt;
    const double single = line->at(1.0);
    if (!(single > 0.0)) return std::nullopt;
    return AmdahlFit{single, line->offset / single};
}

double relative_rms(std::span<const double> expected, std::span<const double> y) {
    check_lengths(expected, y);
    double sum = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        const double error = expected[i] / y[i] - 1.0;
        sum += error * error;
    }
    return y.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(y.size()));
}

}  // namespace weft::bench
