// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_SURFACE_DESCRIPTION_H
#define WEFT_SCENE_SURFACE_SURFACE_DESCRIPTION_H

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/surface/conductor_surface.h"
#include "scene/surface/dielectric_surface.h"
#include "scene/surface/lambert_surface.h"
#include "scene/surface/metallic_surface.h"
#include "scene/surface/normal_map.h"
#include "scene/surface/opacity.h"
#include "scene/surface/plastic_surface.h"
#include "scene/surface/specular_surface.h"
#include "scene/surface/unlit_surface.h"

namespace weft {

using SurfaceModel =
    std::variant<LambertSurface, MetallicSurface, SpecularSurface, ConductorSurface,
                 DielectricSurface, PlasticSurface, UnlitSurface>;

/// What a file says of a surface, as far as that is more than Lambert's law: which model scatters
/// its light, the normals it has and where it is not there.
struct SurfaceDescription {
    SurfaceModel model{};
    NormalMap normal_map{};
    Opacity opacity{};
};

/// Whether the surface is no more than a DiffuseSurface can say.
[[nodiscard]] bool is_lambertian(const SurfaceDescription& surface);

/// Whether some light passes through the surface's material, not only through its gaps.
[[nodiscard]] bool transmits(const SurfaceDescription& surface);

/// The colour that stands for the albedo where edits replace it, or null for metal and glass.
[[nodiscard]] ColourParameter* diffuse_colour(SurfaceDescription& surface);

/// How rough the surface itself is, but not its coat: along both directions, where it has two; none
/// where it is neither rough nor smooth.
[[nodiscard]] std::vector<Roughness*> roughness_of(SurfaceDescription& surface);

/// All textures that the surface has, each as often as it is used.
[[nodiscard]] std::vector<const TextureMap*> texture_maps(const SurfaceDescription& surface);

/// What is out of its range, for errors ("has a roughness outside [0, 1]"), or empty. Indices of
/// textures and of sets of coordinates are checked elsewhere.
[[nodiscard]] std::string surface_problem(const SurfaceDescription& surface);

}  // namespace weft

#endif
