// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_METALLIC_SURFACE_H
#define WEFT_SCENE_SURFACE_METALLIC_SURFACE_H

#include "scene/surface/absorption.h"
#include "scene/surface/anisotropy.h"
#include "scene/surface/clearcoat.h"
#include "scene/surface/roughness.h"

namespace weft {

/// The metallic-roughness surface of glTF 2.0 with its extensions: by `metallic` a metal, else a
/// dielectric whose inside is diffuse, or by `transmission` clear. Also MTL files with Pr or Pm,
/// and what stands for Mitsuba's principled surfaces.
struct MetallicSurface {
    ColourParameter base_colour{};  ///< times vertex colour
    ScalarParameter metallic{};     ///< [0, 1]
    Roughness roughness{};
    Anisotropy anisotropy{};
    float ior = 1.5F;                    ///< from 1 on; 0: specular_colour is the reflectance
    ScalarParameter specular{};          ///< [0, 1], strength of the dielectric's reflection
    ColourParameter specular_colour{};   ///< of the dielectric's reflection, from 0 on
    ScalarParameter transmission{0.0F};  ///< [0, 1]
    bool transmission_by_root = false;   ///< each crossing is tinted by the root of base_colour
    bool solid = false;                  ///< what transmits encloses a volume; false: a thin wall
    Absorption absorption{};             ///< inside of a solid
    Clearcoat clearcoat{};

    [[nodiscard]] bool transmits() const {
        return !transmission.is_zero() && !(metallic.factor == 1.0F && !metallic.map.present());
    }
    /// Whether nothing but its diffuse part reflects light.
    [[nodiscard]] bool is_diffuse() const {
        return metallic.is_zero() && specular.is_zero() && transmission.is_zero() &&
               !clearcoat.present();
    }
};

}  // namespace weft

#endif
