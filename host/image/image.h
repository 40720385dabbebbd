// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_IMAGE_H
#define WEFT_IMAGE_IMAGE_H

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// One plane group of an image, e.g. "direct" with channels R, G, B. Planar: all values of
/// channel 0, then of channel 1, ...; each plane row-major, top row first.
struct Layer {
    std::string name;      ///< empty for the beauty layer
    std::string channels;  ///< one character a channel: "RGB", "XYZ", "Z", "Y", "A"
    std::vector<float> values;
    bool words = false;  ///< the values are the bits of unsigned integers, for layers named
                         ///< word_layer_prefix
    bool half = false;   ///< files hold the values as 16-bit floats, for layers of no light
};

/// The layer of one channel, "A", that holds the alpha of beauty. In files it is a channel of
/// beauty, and comes back as one.
inline constexpr std::string_view alpha_layer_name = "alpha";

/// The layer that holds the beauty as it was rendered, where beauty is that without its noise.
inline constexpr std::string_view noisy_layer_name = "noisy";

/// Names of layers of words begin with this and a dot.
inline constexpr std::string_view word_layer_prefix = "weft.sums";

/// An image of several layers of one size, linear Rec.709 where it holds colour.
struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<Layer> layers;
    std::map<std::string, std::string> metadata;

    /// The layer of that name, or nullptr.
    [[nodiscard]] const Layer* find(std::string_view name) const;
};

}  // namespace weft

#endif
