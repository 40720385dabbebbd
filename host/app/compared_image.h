// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_COMPARED_IMAGE_H
#define WEFT_APP_COMPARED_IMAGE_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "metrics/rgb_view.h"

namespace weft {

/// The layer of an image that is compared, its values finite.
struct ComparedImage {
    std::string place;  ///< the file, for messages
    std::vector<float> rgb;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool display_referred = false;

    [[nodiscard]] RgbView view() const { return {rgb, width, height}; }
};

/// The colours of one layer of the image in the file `place`, beauty unless it is named; grey ones
/// of a layer of one channel. Throws Error (exit code 2) where the layer is missing or holds no
/// colours, or a value is not finite.
[[nodiscard]] ComparedImage compared_image(const Image& image, const std::string& place,
                                           const std::optional<std::string>& layer_name);

/// Throws Error (exit code 2) unless `image` has the size of the reference.
void check_same_size(const ComparedImage& image, const ComparedImage& reference);

}  // namespace weft

#endif
