// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/material.h"

namespace weft {
namespace {

DiffuseSurface& diffuse_part(Material& material) {
    return std::visit([](auto& surface) -> DiffuseSurface& { return weft::diffuse_part(surface); },
                      material.surface);
}

/// By value: lobes say what of them is diffuse for changing it, which reads it as well.
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
}

void set_albedo_texture(Material& material, int texture) {
    diffuse_part(material).albedo_texture = texture;
}

}  // namespace weft
