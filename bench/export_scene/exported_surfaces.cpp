// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/export_scene/exported_surfaces.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace weft::bench {
namespace {

using nlohmann::json;

json colour_json(const glm::vec3& c) {
    return {c.r, c.g, c.b};
}

json map_json(const TextureMap& map) {
    if (!map.present()) return nullptr;
    static constexpr const char* names[] = {"rgb", "red", "green", "blue", "alpha", "luminance"};
    return {{"texture", map.texture}, {"channel", names[static_cast<std::size_t>(map.channel)]}};
}

json parameter_json(const ColourParameter& colour) {
    return {{"factor", colour_json(colour.factor)}, {"map", map_json(colour.map)}};
}

json parameter_json(const ScalarParameter& scalar) {
    return {{"factor", scalar.factor}, {"map", map_json(scalar.map)}};
}

json normal_map_json(const NormalMap& normals) {
    if (!normals.present()) return nullptr;
    return {{"map", map_json(normals.map)}, {"scale", normals.scale}};
}

json opacity_json(const Opacity& opacity) {
    static constexpr const char* modes[] = {"opaque", "mask", "blend"};
    return {{"mode", modes[static_cast<std::size_t>(opacity.mode)]},
            {"cutoff", opacity.cutoff},
            {"alpha", parameter_json(opacity.alpha)}};
}

/// The roughness as glTF has it; null where a map has it on another scale.
json roughness_json(const Roughness& roughness) {
    if (roughness.scale == RoughnessScale::roughness) return parameter_json(roughness.value);
    if (roughness.value.map.present()) return nullptr;
    return {{"factor", perceived(roughness)}, {"map", nullptr}};
}

json model_json(const MetallicSurface& s) {
    const json roughness = roughness_json(s.roughness);
    const json coat_roughness = roughness_json(s.clearcoat.roughness);
    if (roughness.is_null() || coat_roughness.is_null()) return {{"model", "other"}};
    return {{"model", "metallic"},
            {"base_colour", parameter_json(s.base_colour)},
            {"metallic", parameter_json(s.metallic)},
            {"roughness", roughness},
            {"anisotropy",
             {{"strength", s.anisotropy.strength},
              {"rotation", s.anisotropy.rotation},
              {"map", map_json(s.anisotropy.map)}}},
            {"ior", s.ior},
            {"specular", parameter_json(s.specular)},
            {"specular_colour", parameter_json(s.specular_colour)},
            {"transmission", parameter_json(s.transmission)},
            {"tints_by_root", s.transmission_by_root},
            {"solid", s.solid},
            {"absorption",
             {{"colour", colour_json(s.absorption.colour)}, {"distance", s.absorption.distance}}},
            {"clearcoat",
             {{"factor", parameter_json(s.clearcoat.factor)},
              {"roughness", coat_roughness},
              {"normal_map", normal_map_json(s.clearcoat.normal_map)}}}};
}

json model_json(const LambertSurface& s) {
    return {{"model", "lambert"}, {"base_colour", parameter_json(s.colour)}};
}

json model_json(const UnlitSurface& s) {
    return {{"model", "unlit"}, {"base_colour", parameter_json(s.colour)}};
}

/// Models that glTF 2.0 does not have.
template <class Other>
json model_json(const Other&) {
    return {{"model", "other"}};
}

bool has_direction(const SurfaceDescription& surface) {
    const auto* const s = std::get_if<MetallicSurface>(&surface.model);
    return s != nullptr && s->anisotropy.strength > 0.0F;
}

}  // namespace

bool has_described_surface(const Material& material) {
    return material.description.has_value() && !is_lambertian(*material.description);
}

std::optional<SurfaceCoordinates> surface_coordinates(const Material& material) {
    if (!has_described_surface(material)) return std::nullopt;
    const std::vector<const TextureMap*> maps = texture_maps(*material.description);
    for (const TextureMap* const map : maps)
        if (map->present()) return SurfaceCoordinates{map->uv_set, map->to_uv};
    if (has_direction(*material.description)) return SurfaceCoordinates{};
    return std::nullopt;
}

json exported_surface(const Material& material) {
    if (!has_described_surface(material)) return nullptr;
    const SurfaceDescription& surface = *material.description;
    json told = std::visit([](const auto& model) { return model_json(model); }, surface.model);
    told["normal_map"] = normal_map_json(surface.normal_map);
    told["opacity"] = opacity_json(surface.opacity);
    const auto coordinates = surface_coordinates(material);
    const std::vector<const TextureMap*> maps = texture_maps(surface);
    told["several_coordinates"] = std::any_of(maps.begin(), maps.end(), [&](const TextureMap* map) {
        return map->present() &&
               (map->uv_set != coordinates->uv_set || map->to_uv != coordinates->to_uv);
    });
    return told;
}

}  // namespace weft::bench
