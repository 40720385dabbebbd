// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/scaling_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/scaling/least_squares.h"

namespace weft::bench {
namespace {

/// A law with its parameters.
struct FittedLaw {
    std::string text;
    nlohmann::json parameters;
    std::function<double(double)> at;
};

std::optional<FittedLaw> fit_constant(std::span<const double> y) {
    double inverse = 0.0;
    double squares = 0.0;
    for (const double value : y) {
        if (!(value > 0.0)) return std::nullopt;
        inverse += 1.0 / value;
        squares += 1.0 / (value * value);
    }
    if (y.empty()) return std::nullopt;
    const double constant = inverse / squares;
    return FittedLaw{"constant", {{"constant", constant}}, [=](double) { return constant; }};
}

std::optional<FittedLaw> fit(const Law& law, std::span<const double> x, std::span<const double> y) {
    if (law.kind == LawKind::constant) return fit_constant(y);
    if (law.kind == LawKind::amdahl) {
        const auto found = fit_amdahl(x, y);
        if (!found) return std::nullopt;
        return FittedLaw{"single (serial + (1 - serial) / x)",
                         {{"single", found->single}, {"serial", found->serial}},
                         [fitted = *found](double count) { return fitted.at(count); }};
    }
    const bool logarithmic = law.kind == LawKind::logarithmic;
    const auto measure = [=, flat_from = law.flat_from](double value) {
        const double counted = std::min(value, flat_from);
        return logarithmic ? std::log10(counted) : counted;
    };
    std::vector<double> measured;
    for (const double value : x) measured.push_back(measure(value));
    const auto found = fit_line(measured, y);
    if (!found) return std::nullopt;
    const std::string of_x = std::isfinite(law.flat_from)
                                 ? fmt::format("min(x, {:g})", law.flat_from)
                                 : std::string("x");
    return FittedLaw{
        logarithmic ? "offset + slope log10(" + of_x + ")" : "offset + slope " + of_x,
        {{"offset", found->offset}, {"slope", found->slope}},
        [measure, fitted = *found](double value) { return fitted.at(measure(value)); }};
}

}  // namespace

nlohmann::json law_json(const Law& law, std::span<const double> x, std::span<const double> y) {
    const auto power = fit_power(x, y);
    const auto fitted = fit(law, x, y);
    if (!power || !fitted) return {};
    std::vector<double> expected;
    for (const double value : x) expected.push_back(fitted->at(value));
    return {{"text", fitted->text},
            {"parameters", fitted->parameters},
            {"expected", expected},
            {"relative_rms", relative_rms(expected, y)},
            {"exponent", power->exponent}};
}

}  // namespace weft::bench
