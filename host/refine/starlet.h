// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_REFINE_STARLET_H
#define WEFT_REFINE_STARLET_H

#include <cstdint>
#include <span>
#include <vector>

#include "refine/surface_runs.h"

namespace weft {

/// Values of the pixels of an image, row-major.
struct Plane {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> values;

    [[nodiscard]] float at(std::uint32_t x, std::uint32_t y) const {
        return values[std::size_t{y} * width + x];
    }
};

/// Whether a run is long enough for `smooth` with that step to change it.
[[nodiscard]] bool is_smoothed(Run run, std::int64_t step);

/// Smooths planes in place with the B3 spline (1, 4, 6, 4, 1)/16 along rows and columns, whose taps
/// lie `step` pixels apart. Each run of a row or column is smoothed as if it were all of it, so
/// that nothing of one surface gets into another: it is mirrored in its last pixels, and left as it
/// is where it is shorter than four steps. Runs on all cores, with the same result on any number of
/// them.
void smooth(std::span<Plane* const> planes, std::uint32_t step, const SurfaceRuns& runs);

/// The plane, smoothed so over whole rows and columns.
[[nodiscard]] Plane smoothed(const Plane& plane, std::uint32_t step);

/// How many scales of detail an image of this size is split into: the largest details are about
/// half as wide as its shorter side; at most 8.
[[nodiscard]] std::uint32_t starlet_scales(std::uint32_t width, std::uint32_t height);

/// Splits off the finest details that are left in `coarse`, and leaves what is coarser: the starlet
/// transform (Starck, Fadili and Murtagh 2007, "The Undecimated Wavelet Decomposition and its
/// Reconstruction"), within the runs of surfaces. The details of all scales, which count from 0 on,
/// and the last coarse plane add up to the image.
[[nodiscard]] std::vector<Plane> take_details(std::span<Plane* const> coarse, std::uint32_t scale,
                                              const SurfaceRuns& runs);

}  // namespace weft

#endif
