// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/material.h"

namespace weft {
namespace {

DiffuseSurface& diffuse_part(Material& material) {
    return std::visit([](auto& surface) -> DiffuseSurface& { return weft::diffuse_part(surface); },
                      material.surface);
}

/// The diffuse part of a material's surface, from a copy, since lobes give access to it only in
/// surfaces that may be changed.
DiffuseSurface diffuse_part(const Material& material) {
    return std::visit([](auto surface) { return weft::diffuse_part(surface); }, material.surface);
}

}  // namespace

glm::vec3 diffuse_albedo(const Material& material) {
    return diffuse_part(material).albedo;
}

int albedo_texture(const Material& material) {
    return diffuse_part(material).albedo_texture;
}

void set_diffuse_albedo(Material& material, const glm::vec3& albedo) {
    diffuse_part(material).albedo = albedo;
    if (!material.description) return;
    if (ColourParameter* const colour = diffuse_colour(*material.description))
        colour->factor = albedo;
}

void set_albedo_texture(Material& material, int texture) {
    diffuse_part(material).albedo_texture = texture;
    if (!material.description) return;
    if (ColourParameter* const colour = diffuse_colour(*material.description))
        colour->map.texture = texture;
}

std::optional<double> perceived_roughness(const Material& material) {
    if (!material.description || is_lambertian(*material.description)) return {};
    SurfaceDescription surface = *material.description;
    const std::vector<Roughness*> found = roughness_of(surface);
    if (found.empty()) return {};
    return perceived(*found.front());
}

void fade_roughness(Material& material, double goal, double share) {
    if (!perceived_roughness(material)) return;
    for (Roughness* const found : roughness_of(*material.description)) {
        const double before = perceived(*found);
        set_perceived(*found, share < 1.0 ? before + (goal - before) * share : goal);
    }
}

}  // namespace weft
