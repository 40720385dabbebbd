// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/image.h"

#include <algorithm>

namespace weft {

const Layer* Image::find(std::string_view name) const {
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [&](const Layer& layer) { return layer.name == name; });
    return found == layers.end() ? nullptr : &*found;
}

}  // namespace weft
