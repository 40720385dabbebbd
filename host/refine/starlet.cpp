// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/starlet.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace weft {
namespace {

constexpr std::array<float, 3> spline{6.0F / 16.0F, 4.0F / 16.0F, 1.0F / 16.0F};

/// The place in [0, size) that `x` falls on where the line is mirrored in its last places.
std::uint32_t mirrored(std::int64_t x, std::uint32_t size) {
    if (size == 1) return 0;
    const std::int64_t period = 2 * (std::int64_t{size} - 1);
    const std::int64_t place = ((x % period) + period) % period;
    return static_cast<std::uint32_t>(std::min(place, period - place));
}

template <class Work>
void for_rows(std::uint32_t height, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, height),
                      [&](const tbb::blocked_range<std::uint32_t>& rows) {
                          for (std::uint32_t y = rows.begin(); y < rows.end(); ++y) work(y);
                      });
}

/// The sum of five values, symmetric in both directions, so that mirrored images smooth alike.
float weighted(float middle, float near_low, float near_high, float far_low, float far_high) {
    return spline[0] * middle + spline[1] * (near_low + near_high) +
           spline[2] * (far_low + far_high);
}

void smooth_row(const float* from, float* to, std::uint32_t width, std::int64_t step) {
    const auto value = [&](std::int64_t x) { return from[mirrored(x, width)]; };
    const auto mirrored_tap = [&](std::int64_t x) {
        return weighted(from[x], value(x - step), value(x + step), value(x - 2 * step),
                        value(x + 2 * step));
    };
    const std::int64_t begin = std::min<std::int64_t>(2 * step, width);
    const std::int64_t end = std::max<std::int64_t>(begin, std::int64_t{width} - 2 * step);
    for (std::int64_t x = 0; x < begin; ++x) to[x] = mirrored_tap(x);
    for (std::int64_t x = begin; x < end; ++x)
        to[x] = weighted(from[x], from[x - step], from[x + step], from[x - 2 * step],
                         from[x + 2 * step]);
    for (std::int64_t x = end; x < width; ++x) to[x] = mirrored_tap(x);
}

}  // namespace

Plane smoothed(const Plane& plane, std::uint32_t step) {
    const std::size_t width = plane.width;
    Plane rows{plane.width, plane.height, std::vector<float>(plane.values.size())};
    for_rows(plane.height, [&](std::uint32_t y) {
        smooth_row(&plane.values[y * width], &rows.values[y * width], plane.width, step);
    });
    Plane result{plane.width, plane.height, std::vector<float>(plane.values.size())};
    for_rows(plane.height, [&](std::uint32_t y) {
        const auto row = [&](std::int64_t offset) {
            return &rows.values[mirrored(y + offset * step, plane.height) * width];
        };
        const float* const far_low = row(-2);
        const float* const near_low = row(-1);
        const float* const near_high = row(1);
        const float* const far_high = row(2);
        const float* const middle = &rows.values[y * width];
        float* const to = &result.values[y * width];
        for (std::size_t x = 0; x < width; ++x)
            to[x] = weighted(middle[x], near_low[x], near_high[x], far_low[x], far_high[x]);
    });
    return result;
}

std::uint32_t starlet_scales(std::uint32_t width, std::uint32_t height) {
    constexpr std::uint32_t most = 8;
    std::uint32_t scales = 1;
    while (scales < most && (8U << scales) <= std::min(width, height)) ++scales;
    return scales;
}

Plane take_detail(Plane& coarse, std::uint32_t scale) {
    Plane detail = smoothed(coarse, 1U << scale);
    std::swap(detail, coarse);
    for_rows(detail.height, [&](std::uint32_t y) {
        const std::size_t first = std::size_t{y} * detail.width;
        for (std::size_t i = first; i < first + detail.width; ++i)
            detail.values[i] -= coarse.values[i];
    });
    return detail;
}

}  // namespace weft
