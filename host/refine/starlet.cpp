// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/starlet.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace weft {

bool is_smoothed(Run run, std::int64_t step) {
    // No tap is mirrored more than once then.
    return 4 * step <= std::int64_t{run.length()};
}

namespace {

constexpr std::array<float, 3> spline{6.0F / 16.0F, 4.0F / 16.0F, 1.0F / 16.0F};
constexpr std::array<std::int64_t, 4> offsets{-2, -1, 1, 2};  // of the taps beside the middle one

/// The place in a run that `x` falls on where the run is mirrored in its last places.
std::int64_t mirrored(std::int64_t x, Run run) {
    if (x < run.begin) return 2 * std::int64_t{run.begin} - x;
    return x < run.end ? x : 2 * (std::int64_t{run.end} - 1) - x;
}

/// The sum of five values, symmetric in both directions, so that mirrored images smooth alike.
float weighted(float middle, float near_low, float near_high, float far_low, float far_high) {
    return spline[0] * middle + spline[1] * (near_low + near_high) +
           spline[2] * (far_low + far_high);
}

/// Smooths one run of a row.
void smooth_run(const float* from, float* to, Run run, std::int64_t step) {
    if (!is_smoothed(run, step)) {
        std::copy(from + run.begin, from + run.end, to + run.begin);
        return;
    }
    const auto value = [&](std::int64_t x) { return from[mirrored(x, run)]; };
    const auto mirrored_tap = [&](std::int64_t x) {
        return weighted(from[x], value(x - step), value(x + step), value(x - 2 * step),
                        value(x + 2 * step));
    };
    const std::int64_t begin = run.begin + 2 * step;
    const std::int64_t end = run.end - 2 * step;
    for (std::int64_t x = run.begin; x < begin; ++x) to[x] = mirrored_tap(x);
    for (std::int64_t x = begin; x < end; ++x)
        to[x] = weighted(from[x], from[x - step], from[x + step], from[x - 2 * step],
                         from[x + 2 * step]);
    for (std::int64_t x = end; x < run.end; ++x) to[x] = mirrored_tap(x);
}

/// Where the taps of the pixels of a row lie in the columns.
class ColumnTaps {
  public:
    ColumnTaps(const SurfaceRuns& runs, std::uint32_t y, std::int64_t step)
        : width_(runs.width), first_(std::size_t{y} * width_), columns_(&runs.columns[first_]) {
        const bool are_alike = std::all_of(columns_, columns_ + width_, [&](const Run& run) {
            return (run.begin == columns_->begin && run.end == columns_->end) ||
                   (has_all(run, y, step) && has_all(*columns_, y, step));
        });
        // With the same rows for all pixels, one of each tap does.
        const std::size_t count = are_alike ? 1 : width_;
        for (std::size_t k = 0; k < offsets.size(); ++k) {
            taps_[k].resize(count);
            for (std::size_t x = 0; x < count; ++x) {
                const std::int64_t row = is_smoothed(columns_[x], step)
                                             ? mirrored(y + offsets[k] * step, columns_[x])
                                             : std::int64_t{y};
                taps_[k][x] = static_cast<std::size_t>(row) * width_ + x;
            }
        }
    }

    void smooth(const float* from, float* to) const {
        const auto& [far_low, near_low, near_high, far_high] = taps_;
        const float* const middle = from + first_;
        float* const row = to + first_;
        if (far_low.size() == width_) {
            for (std::size_t x = 0; x < width_; ++x)
                row[x] = weighted(middle[x], from[near_low[x]], from[near_high[x]],
                                  from[far_low[x]], from[far_high[x]]);
            return;
        }
        const float* const a = from + near_low[0];
        const float* const b = from + near_high[0];
        const float* const c = from + far_low[0];
        const float* const d = from + far_high[0];
        for (std::size_t x = 0; x < width_; ++x)
            row[x] = weighted(middle[x], a[x], b[x], c[x], d[x]);
    }

  private:
    static bool has_all(Run run, std::uint32_t y, std::int64_t step) {
        return is_smoothed(run, step) && run.begin + 2 * step <= y && y + 2 * step < run.end;
    }

    std::size_t width_;
    std::size_t first_;  ///< pixel of the row
    const Run* columns_;
    std::array<std::vector<std::size_t>, offsets.size()> taps_;
};

}  // namespace

void smooth(std::span<Plane* const> planes, std::uint32_t step, const SurfaceRuns& runs) {
    const std::size_t width = runs.width;
    std::vector<Plane> rows;
    for (const Plane* const plane : planes)
        rows.push_back({plane->width, plane->height, std::vector<float>(plane->values.size())});
    tbb::parallel_for(std::uint32_t{0}, runs.height, [&](std::uint32_t y) {
        const std::size_t first = y * width;
        for (std::uint32_t x = 0; x < width; x = runs.rows[first + x].end)
            for (std::size_t k = 0; k < planes.size(); ++k)
                smooth_run(&planes[k]->values[first], &rows[k].values[first], runs.rows[first + x],
                           step);
    });
    tbb::parallel_for(std::uint32_t{0}, runs.height, [&](std::uint32_t y) {
        const ColumnTaps taps(runs, y, step);
        for (std::size_t k = 0; k < planes.size(); ++k)
            taps.smooth(rows[k].values.data(), planes[k]->values.data());
    });
}

Plane smoothed(const Plane& plane, std::uint32_t step) {
    Plane result = plane;
    const std::array planes{&result};
    smooth(planes, step, SurfaceRuns(plane.width, plane.height));
    return result;
}

std::uint32_t starlet_scales(std::uint32_t width, std::uint32_t height) {
    constexpr std::uint32_t most = 8;
    std::uint32_t scales = 1;
    while (scales < most && (8U << scales) <= std::min(width, height)) ++scales;
    return scales;
}

std::vector<Plane> take_details(std::span<Plane* const> coarse, std::uint32_t scale,
                                const SurfaceRuns& runs) {
    std::vector<Plane> details;
    for (const Plane* const plane : coarse) details.push_back(*plane);
    smooth(coarse, 1U << scale, runs);
    tbb::parallel_for(std::uint32_t{0}, runs.height, [&](std::uint32_t y) {
        const std::size_t first = std::size_t{y} * runs.width;
        for (std::size_t k = 0; k < coarse.size(); ++k)
            for (std::size_t i = first; i < first + runs.width; ++i)
                details[k].values[i] -= coarse[k]->values[i];
    });
    return details;
}

}  // namespace weft
