// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_LOBES_H
#define WEFT_SCENE_SURFACE_LOBES_H

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/texture_statistics.h"

namespace weft {

/// How wide a lobe scatters, by alpha, the slope of its microfacets.
enum class LobeWidth : std::uint8_t {
    delta,   ///< below 2^-12: a mirror, or clear glass
    sharp,   ///< up to 10^-3, about the angle of a pixel
    glossy,  ///< below 1/4
    rough,   ///< from 1/4 on
};

[[nodiscard]] LobeWidth width_of(double alpha);
[[nodiscard]] const char* name_of(LobeWidth width);

/// One way in which a surface that is described scatters light.
struct SurfaceLobe {
    const char* name = "";    ///< "metal", "clear coat", ...
    bool is_diffuse = false;  ///< without a width
    bool transmits = false;
    double least_alpha = 0.0;  ///< over the texture, where roughness has one
    double most_alpha = 0.0;
    double most_reflectance = 1.0;  ///< at normal incidence, over the textures
};

/// Whether the light of such a lobe that reflects is all but that of a diffuse surface: it is wide
/// everywhere, and faint but at grazing angles.
[[nodiscard]] bool is_nearly_diffuse(const SurfaceLobe& lobe);

/// The lobes that a surface has anywhere. `textures` are by texture of the scene.
[[nodiscard]] std::vector<SurfaceLobe> lobes_of(const SurfaceDescription& surface,
                                                std::span<const TextureStatistics> textures);

/// What a renderer has to do for a surface beyond diffuse light, in words.
[[nodiscard]] std::vector<std::string> effects_of(const SurfaceDescription& surface,
                                                  std::span<const SurfaceLobe> lobes);

}  // namespace weft

#endif
