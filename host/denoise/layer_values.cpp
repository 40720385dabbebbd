// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/layer_values.h"

#include <stdexcept>
#include <string>

namespace weft {

std::span<const float> layer_values(const Image& image, std::string_view name,
                                    std::size_t channels) {
    const std::size_t values = channels * image.width * image.height;
    const Layer* const layer = image.find(name);
    if (layer == nullptr || layer->channels.size() < channels || layer->values.size() < values)
        throw std::invalid_argument("the image lacks the layer \"" + std::string(name) +
                                    "\" that denoising needs");
    return std::span(layer->values).first(values);
}

}  // namespace weft
