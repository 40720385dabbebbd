// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_CHANNEL_NAME_H
#define WEFT_IMAGE_CHANNEL_NAME_H

#include <string>

#include "image/image.h"

namespace weft {

/// The name of a channel among those of all layers, in files and for other programs: of beauty and
/// alpha the letter alone.
[[nodiscard]] inline std::string full_channel_name(const Layer& layer, char channel) {
    if (layer.name.empty() || layer.name == alpha_layer_name) return std::string(1, channel);
    return layer.name + "." + channel;
}

}  // namespace weft

#endif
