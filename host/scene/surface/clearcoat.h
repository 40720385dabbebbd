// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_CLEARCOAT_H
#define WEFT_SCENE_SURFACE_CLEARCOAT_H

#include "scene/surface/normal_map.h"
#include "scene/surface/roughness.h"

namespace weft {

/// A clear layer of index 1.5 on top of a surface.
struct Clearcoat {
    ScalarParameter factor{0.0F};  ///< [0, 1], 0: no coat
    Roughness roughness{ScalarParameter{0.0F}};
    NormalMap normal_map{};  ///< none: the coat lies on the unperturbed surface

    [[nodiscard]] bool present() const { return !factor.is_zero(); }
};

}  // namespace weft

#endif
