// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_REFINE_SURFACE_RUNS_H
#define WEFT_REFINE_SURFACE_RUNS_H

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace weft {

/// Places [begin, end) of a row or column.
struct Run {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    [[nodiscard]] std::uint32_t length() const { return end - begin; }
};

/// The rows and columns of an image, cut at the edges of surfaces: for each pixel the part of its
/// row and the part of its column that show the same surface without a break.
struct SurfaceRuns {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<Run> rows;     ///< by pixel, row-major: where in its row its run lies
    std::vector<Run> columns;  ///< the same of its column

    /// Whole rows and columns.
    SurfaceRuns(std::uint32_t wide, std::uint32_t high);
};

/// Finds the edges by the layers "depth", "normal" and "albedo", as far as the image has them. Two
/// pixels beside each other are apart where their normals are, where one's albedo is more than
/// twice the other's, or where the depth leaps by more than the slopes beside them explain. What
/// lies behind all surfaces has the depth 0. A pixel that shows parts of two surfaces is apart from
/// both.
[[nodiscard]] SurfaceRuns find_surface_runs(const Image& image);

}  // namespace weft

#endif
