// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_materials.h"

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "base/quote.h"
#include "scene/gltf/gltf_medium.h"
#include "scene/gltf/gltf_surface.h"
#include "scene/mesh_tangents.h"

namespace weft {
namespace {

struct Unsimulated {
    const char* key;
    const char* message;
};

constexpr WarningUnit material_unit{"material", "materials"};

/// What no algorithm renders.
constexpr std::array unsimulated_extensions = {
    Unsimulated{"KHR_materials_diffuse_transmission",
                "diffuse transmission is not simulated, an opaque surface is rendered instead"},
    Unsimulated{"KHR_materials_sheen", "sheen is not simulated, it is left out"},
    Unsimulated{"KHR_materials_iridescence", "iridescence is not simulated, it is left out"},
    Unsimulated{"KHR_materials_dispersion",
                "dispersion is not simulated, all colours are refracted alike"},
};

/// What else is more than a diffuse surface, for MaterialDetail::diffuse.
constexpr std::array undiffuse_extensions = {
    Unsimulated{"KHR_materials_unlit",
                "unlit material is not simulated, a lit diffuse surface is rendered instead"},
    Unsimulated{"KHR_materials_transmission",
                "transmission is not simulated, an opaque surface is rendered instead"},
    Unsimulated{"KHR_materials_volume",
                "material volume is not simulated, an opaque surface is rendered instead"},
    Unsimulated{"KHR_materials_clearcoat",
                "clear coat is not simulated, the bare base colour is rendered instead"},
    Unsimulated{"KHR_materials_specular",
                "specular reflection is not simulated, a diffuse surface is rendered instead"},
    Unsimulated{"KHR_materials_anisotropy",
                "anisotropic reflection is not simulated, a diffuse surface is rendered instead"},
    Unsimulated{"KHR_materials_ior",
                "index of refraction is not simulated, a diffuse surface is rendered instead"},
    Unsimulated{"KHR_materials_pbrSpecularGlossiness",
                "specular-glossiness material is not simulated, the metallic-roughness base "
                "colour is rendered instead"},
};

/// Whether the extension only says that a dielectric has no reflection but its diffuse one.
bool is_lambert(const JsonValue& value, std::string_view key) {
    return key == "KHR_materials_specular" &&
           value.extension("KHR_materials_specular")->number_or("specularFactor", 1.0) == 0.0;
}

}  // namespace

GltfMaterials::GltfMaterials(const GltfDocument& document, GltfTextures& textures,
                             WarningCollector& report, GltfDensities& densities,
                             MaterialDetail detail, std::vector<Material>& materials,
                             std::vector<Medium>& media)
    : root_(document.root()),
      textures_(textures),
      report_(report),
      densities_(densities),
      detail_(detail),
      materials_(materials),
      media_(media) {}

const GltfSurface& GltfMaterials::surface(const std::optional<JsonValue>& reference) {
    constexpr std::size_t default_material = std::numeric_limits<std::size_t>::max();
    const std::size_t index =
        reference ? reference->as_index(root_.size_of("materials"), "materials") : default_material;
    if (const auto known = surfaces_.find(index); known != surfaces_.end()) return known->second;
    GltfSurface surface;
    if (reference) {
        surface = convert(root_.at("materials").element(index), index);
    } else {
        Material material;
        material.name = "default";
        material.surface = DiffuseSurface{glm::vec3{1.0F}};
        if (detail_ == MaterialDetail::full) material.description = default_gltf_surface();
        surface.material = static_cast<std::uint32_t>(materials_.size());
        materials_.push_back(std::move(material));
    }
    return surfaces_.emplace(index, surface).first->second;
}

GltfSurface GltfMaterials::convert(const JsonValue& value, std::size_t index) {
    GltfSurface surface;
    Material material;
    material.name = value.name_or("material " + std::to_string(index));
    if (std::optional<Medium> medium = read_gltf_medium(value, material.name, densities_)) {
        surface.medium = static_cast<int>(media_.size());
        media_.push_back(*std::move(medium));
        return surface;
    }
    material.surface = base_colour(value, surface);
    material.emission = emission(value, surface);
    material.emission.both_sides = value.bool_or("doubleSided", false);
    material.two_sided = true;
    report_unsimulated(value);
    if (detail_ == MaterialDetail::full) describe(value, material, surface);
    surface.material = static_cast<std::uint32_t>(materials_.size());
    materials_.push_back(std::move(material));
    return surface;
}

void GltfMaterials::describe(const JsonValue& value, Material& material, GltfSurface& surface) {
    GltfDescription found = read_gltf_surface(value, textures_, report_);
    surface.uv_sets = std::move(found.uv_sets);
    if (found.surface) {
        surface.tangent_set = tangent_uv_set(*found.surface);
        surface.has_alpha = found.surface->opacity.mode != OpacityMode::opaque;
        const auto* const metallic = std::get_if<MetallicSurface>(&found.surface->model);
        surface.is_solid = metallic != nullptr && metallic->solid;
        surface.is_wall = metallic != nullptr && !metallic->solid &&
                          metallic->transmission.factor > 0.0F &&
                          value.extension("KHR_materials_ior").has_value();
        if (metallic != nullptr && metallic->transmission.factor > 0.0F &&
            found.surface->opacity.mode == OpacityMode::blend)
            report_.count(value.place(), material_unit,
                          "transmission together with alphaMode BLEND, both let light pass");
    }
    material.description = found.surface;
}

std::uint32_t GltfMaterials::thin(std::uint32_t material) {
    const auto [known, added] =
        thin_.try_emplace(material, static_cast<std::uint32_t>(materials_.size()));
    if (!added) return known->second;
    Material wall = materials_[material];
    auto& surface = std::get<MetallicSurface>(wall.description->model);
    surface.solid = false;
    surface.absorption = {};
    materials_.push_back(std::move(wall));
    return known->second;
}

DiffuseSurface GltfMaterials::base_colour(const JsonValue& value, GltfSurface& surface) {
    DiffuseSurface diffuse{glm::vec3{1.0F}};
    const std::optional<JsonValue> pbr = value.find("pbrMetallicRoughness");
    if (!pbr) return diffuse;
    const std::array<double, 4> factor =
        pbr->numbers_or<4>("baseColorFactor", {1.0, 1.0, 1.0, 1.0});
    diffuse.albedo = colour(*pbr, glm::dvec3(factor[0], factor[1], factor[2]), "baseColorFactor");
    const std::optional<JsonValue> info = pbr->find("baseColorTexture");
    if (!info) return diffuse;
    const std::optional<int> texture = textures_.add(info->at("index"));
    if (!texture) return diffuse;
    diffuse.albedo_texture = *texture;
    surface.base_colour_uvs = read_gltf_uvs(*info);
    return diffuse;
}

Emission GltfMaterials::emission(const JsonValue& value, GltfSurface& surface) {
    const std::array<double, 3> factor = value.numbers_or<3>("emissiveFactor", {0.0, 0.0, 0.0});
    const glm::vec3 base =
        colour(value, glm::dvec3(factor[0], factor[1], factor[2]), "emissiveFactor");
    double strength = 1.0;
    if (const std::optional<JsonValue> extension =
            value.extension("KHR_materials_emissive_strength")) {
        strength = extension->number_or("emissiveStrength", 1.0);
        if (strength < 0.0 || strength > 1e30)
            throw extension->error("emissiveStrength is " + std::to_string(strength) +
                                   ", expected 0 to 1e30");
    }
    Emission emission;
    emission.radiance = base * static_cast<float>(strength);
    const std::optional<JsonValue> info = value.find("emissiveTexture");
    if (!info || emission.radiance == glm::vec3{0.0F}) return emission;
    const std::optional<int> texture = textures_.add(info->at("index"));
    if (!texture) return emission;
    emission.texture = *texture;
    surface.emission_uvs = read_gltf_uvs(*info);
    return emission;
}

glm::vec3 GltfMaterials::colour(const JsonValue& place, const glm::dvec3& value, const char* what) {
    const glm::dvec3 clamped = glm::clamp(value, 0.0, 1.0);
    if (clamped != value)
        report_.count(place.place(), material_unit,
                      std::string(what) + " lies outside [0, 1] and is clamped");
    return glm::vec3(clamped);
}

void GltfMaterials::report_unsimulated(const JsonValue& value) {
    const auto report = [&](const auto& extensions) {
        for (const Unsimulated& extension : extensions)
            if (value.extension(extension.key) && !is_lambert(value, extension.key))
                report_.count(value.place(), material_unit, extension.message);
    };
    report(unsimulated_extensions);
    const std::string mode = value.string_or("alphaMode", "OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
        throw value.at("alphaMode").error("is " + quote(mode) + ", expected OPAQUE, MASK or BLEND");
    if (detail_ == MaterialDetail::full) return;
    report(undiffuse_extensions);
    const auto not_simulated = [&](const std::string& message) {
        report_.count(value.place(), material_unit, message);
    };
    const std::optional<JsonValue> pbr = value.find("pbrMetallicRoughness");
    if (!pbr || pbr->number_or("metallicFactor", 1.0) > 0.0)
        not_simulated(
            "metallic reflection is not simulated, a diffuse surface is rendered "
            "instead");
    if (pbr &&
        (pbr->number_or("roughnessFactor", 1.0) < 1.0 || pbr->find("metallicRoughnessTexture")))
        not_simulated("roughness below 1 is not simulated, a diffuse surface is rendered instead");
    if (value.find("normalTexture"))
        not_simulated("normal maps are not simulated, the unperturbed normals are used instead");
    if (mode != "OPAQUE")
        not_simulated("alphaMode " + mode +
                      " is not simulated, an opaque surface is rendered instead");
}

}  // namespace weft
