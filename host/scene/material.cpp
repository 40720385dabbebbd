// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/material.h"

namespace weft {
namespace {

/// One overload for each kind of parameters: what of it is diffuse.
const DiffuseSurface& diffuse_part(const DiffuseSurface& surface) {
    return surface;
}

DiffuseSurface& diffuse_part(DiffuseSurface& surface) {
    return surface;
}

}  // namespace

glm::vec3 diffuse_albedo(const Material& material) {
    return std::visit([](const auto& surface) { return diffuse_part(surface).albedo; },
                      material.surface);
}

int albedo_texture(const Material& material) {
    return std::visit([](const auto& surface) { return diffuse_part(surface).albedo_texture; },
                      material.surface);
}

void set_diffuse_albedo(Material& material, const glm::vec3& albedo) {
    std::visit([&](auto& surface) { diffuse_part(surface).albedo = albedo; }, material.surface);
}

void set_albedo_texture(Material& material, int texture) {
    std::visit([&](auto& surface) { diffuse_part(surface).albedo_texture = texture; },
               material.surface);
}

}  // namespace weft
