// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_BACKGROUND_H
#define WEFT_IMAGE_BACKGROUND_H

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "image/image.h"

namespace weft {

/// What takes the place of the environment where the camera's rays meet nothing. Images are
/// rendered without it and know by their alpha where it belongs; what writes them puts it there.
struct Background {
    bool transparent = true;  ///< none: alpha says how much of it would be seen
    glm::vec3 colour{0.0F};   ///< linear Rec.709, where it is not transparent

    bool operator==(const Background&) const = default;
};

/// "transparent", or the colour as three linear numbers, "1,0.5,0".
[[nodiscard]] std::string to_string(const Background& background);

/// The alpha of beauty, one value a pixel; empty where the image has none. Beauty is premultiplied
/// with it.
[[nodiscard]] std::span<const float> alpha_of(const Image& image);

/// Puts a colour behind an image: adds its share to beauty, rendered and denoised, and to emission,
/// of which background is a part, and makes alpha 1. Does nothing where the background is
/// transparent or the image has no alpha.
void put_behind(const Background& background, Image& image);

}  // namespace weft

#endif
