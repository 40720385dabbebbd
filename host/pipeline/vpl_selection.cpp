// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/vpl_selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "plan/work_order.h"
#include "scene/flat_scene.h"

namespace weft {
namespace {

/// What is added to the light of each point, as a share of their mean: a dark point would count all
/// its light as much as a bright one, though the eye cannot see it.
constexpr double adaptation = 0.1;

std::vector<double> importances(const VplCandidates& candidates) {
    const std::size_t vpls = candidates.vpls.size();
    const std::size_t points = candidates.contributions.size() / std::max<std::size_t>(1, vpls);
    std::vector<double> light(points, 0.0);
    for (std::size_t i = 0; i < vpls; ++i)
        for (std::size_t k = 0; k < points; ++k)
            light[k] += candidates.contributions[i * points + k];
    const auto lit = std::ranges::count_if(light, [](double l) { return l > 0.0; });
    std::vector<double> importance(vpls, 0.0);
    if (lit == 0) return importance;
    const double mean = std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(lit);
    std::vector<double> worth(points);
    for (std::size_t k = 0; k < points; ++k) worth[k] = 1.0 / (light[k] + adaptation * mean);
    for (std::size_t i = 0; i < vpls; ++i)
        for (std::size_t k = 0; k < points; ++k)
            importance[i] += candidates.contributions[i * points + k] * worth[k];
    return importance;
}

/// Adds `share` of a probability that goes by `weights`; returns whether they say anything.
bool add_share(const std::vector<double>& weights, double share, std::vector<double>& to) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(sum > 0.0) || !std::isfinite(sum)) return false;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += share * (weights[i] / sum);
    return true;
}

/// The VPLs with a probability in the order of Morton's curve through their places.
std::vector<std::uint32_t> along_curve(std::span<const shared::Vpl> vpls,
                                       const std::vector<double>& probabilities) {
    std::vector<std::uint32_t> order;
    std::array<float, 3> low{}, high{};
    const auto place = [&](std::uint32_t i) {
        const shared::float4& p = vpls[i].position;
        return std::array<float, 3>{p.x, p.y, p.z};
    };
    for (std::uint32_t i = 0; i < vpls.size(); ++i) {
        if (!(probabilities[i] > 0.0)) continue;
        const auto p = place(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = order.empty() ? p[axis] : std::min(low[axis], p[axis]);
            high[axis] = order.empty() ? p[axis] : std::max(high[axis], p[axis]);
        }
        order.push_back(i);
    }
    std::vector<std::uint32_t> codes(vpls.size());
    for (const std::uint32_t i : order) {
        const auto p = place(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double size = double{high[axis]} - low[axis];
            const double share = size > 0.0 ? (double{p[axis]} - low[axis]) / size : 0.0;
            codes[i] |= spread_bits(static_cast<std::uint32_t>(share * 1023.0)) << axis;
        }
    }
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return codes[a] != codes[b] ? codes[a] < codes[b] : a < b;
    });
    return order;
}

/// Random number for roulette of VPL `number` of a set, in (0, 1]. Those of consecutive VPLs cover
/// it evenly.
float roulette_number(std::uint32_t number, double turn) {
    constexpr double golden = 0.6180339887498949;
    const double along = turn + golden * number;
    return static_cast<float>(1.0 - (along - std::floor(along)) * (1.0 - 0x1p-24));
}

}  // namespace

std::vector<double> choice_probabilities(const VplCandidates& candidates, double by_flux) {
    std::vector<double> fluxes;
    fluxes.reserve(candidates.vpls.size());
    for (const shared::Vpl& vpl : candidates.vpls)
        fluxes.push_back(luminance({vpl.flux.x, vpl.flux.y, vpl.flux.z}));
    std::vector<double> probabilities(candidates.vpls.size(), 0.0);
    if (!add_share(fluxes, by_flux, probabilities)) return probabilities;
    if (!add_share(importances(candidates), 1.0 - by_flux, probabilities))
        add_share(fluxes, 1.0 - by_flux, probabilities);
    return probabilities;
}

std::vector<shared::Vpl> select_vpls(const VplCandidates& candidates, std::uint32_t count,
                                     double start, double turn) {
    const std::vector<double> probabilities = choice_probabilities(candidates, chosen_by_flux);
    shared::Vpl dark{};
    dark.normal.z = 1.0F;
    dark.flux.w = 1.0F;
    std::vector<shared::Vpl> chosen;
    chosen.reserve(count);
    double passed = 0.0;
    std::uint32_t drawn = 0;
    for (const std::uint32_t i : along_curve(candidates.vpls, probabilities)) {
        const double expected = probabilities[i] * count;
        passed += expected;
        const std::uint32_t before = drawn;
        while (drawn < count && drawn + start < passed) ++drawn;
        if (drawn == before) continue;
        const auto weight = static_cast<float>((drawn - before) / expected);
        shared::Vpl vpl = candidates.vpls[i];
        vpl.flux.x *= weight;
        vpl.flux.y *= weight;
        vpl.flux.z *= weight;
        vpl.flux.w = roulette_number(static_cast<std::uint32_t>(chosen.size()), turn);
        chosen.push_back(vpl);
    }
    chosen.resize(count, dark);
    return chosen;
}

}  // namespace weft
