// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/denoise_view.h"

#include "scene/field_of_view.h"

namespace weft {

DenoiseView denoise_view(const Camera& camera, std::uint32_t width, std::uint32_t height,
                         bool media) {
    const double aspect = static_cast<double>(width) / height;
    const double half =
        camera.orthographic() ? half_height(camera, aspect) : vertical_tangent(camera, aspect);
    return {.orthographic = camera.orthographic(), .pixel = 2.0 * half / height, .media = media};
}

}  // namespace weft
