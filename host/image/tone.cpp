// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/tone.h"

#define NATIVE_KERNELS "kernels/film/tone.h"
#include "shared/native_functions.h"

namespace weft {

std::string_view to_string(ToneCurve curve) {
    return tone_names.at(static_cast<std::size_t>(curve));
}

glm::vec3 toned(ToneCurve curve, const glm::vec3& colour) {
    const native::float3 shown =
        native::toned(static_cast<native::uint>(curve), native::f3(colour.x, colour.y, colour.z));
    return {shown.x, shown.y, shown.z};
}

}  // namespace weft
