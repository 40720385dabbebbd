// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_PIXEL_SURFACES_H
#define WEFT_DENOISE_PIXEL_SURFACES_H

#include <array>
#include <cstddef>

#include "denoise/denoise_view.h"
#include "denoise/padding.h"
#include "image/image.h"

namespace weft {

/// Tells which pixels show one surface, so that light may be shared between them: those that lie in
/// a plane with similar normals, and in scenes with media those of similar albedo.
class PixelSurfaces {
  public:
    /// Reads the layers normal, depth and albedo. Throws std::invalid_argument where one is
    /// missing.
    PixelSurfaces(const Image& image, const DenoiseView& view, const Padding& padding);

    /// Sets those weights of the strip at place `i` to 0 whose pixel shows another surface than the
    /// one `dx` and `dy` pixels away does. Along a plane the inverse depth is linear over the image
    /// (for parallel rays, the depth): where it goes on from a pixel is compared with what the
    /// other has.
    void keep_same(std::size_t i, int dx, int dy, float* weights) const;

  private:
    void find_slopes(const DenoiseView& view);
    void keep_parallel(std::size_t i, std::size_t j, float* weights) const;

    Padding padding_;
    bool media_;
    PaddedPlane nearness_;           ///< inverse depth, or depth of parallel rays; 0: nothing
    PaddedPlane slope_x_, slope_y_;  ///< its change from pixel to pixel
    PaddedPlane reach_;              ///< how far it may be from where it is expected
    std::array<PaddedPlane, 3> normal_;
    PaddedPlane has_normal_;             ///< 1 or 0
    std::array<PaddedPlane, 3> albedo_;  ///< empty without media
};

}  // namespace weft

#endif
