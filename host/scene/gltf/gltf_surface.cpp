// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "scene/gltf/gltf_texture_maps.h"

namespace weft {
namespace {

constexpr WarningUnit described_material_unit{"material", "materials"};
constexpr double largest_float = std::numeric_limits<float>::max();
constexpr double largest_ior = 100.0;
constexpr double largest_normal_scale = 1000.0;

/// Reads one material.
class GltfSurfaceReader {
  public:
    GltfSurfaceReader(GltfTextures& textures, WarningCollector& report)
        : maps_(textures, report), report_(report) {}

    GltfDescription read(const JsonValue& material) {
        SurfaceDescription surface;
        const std::optional<JsonValue> pbr = material.find("pbrMetallicRoughness");
        const std::optional<JsonValue> glossy =
            material.extension("KHR_materials_pbrSpecularGlossiness");
        const bool unlit = material.extension("KHR_materials_unlit").has_value();
        const JsonValue* alpha_owner = nullptr;
        if (unlit) {
            surface.model = UnlitSurface{base_colour(pbr)};
            alpha_owner = pbr ? &*pbr : nullptr;
        } else if (glossy) {
            surface.model = specular_glossiness(*glossy);
            alpha_owner = &*glossy;
        } else {
            surface.model = metallic_roughness(material, pbr);
            alpha_owner = pbr ? &*pbr : nullptr;
        }
        if (!unlit) surface.normal_map = normal_map(material, "normalTexture");
        surface.opacity = opacity(material, alpha_owner, glossy && !unlit);
        GltfDescription found;
        if (!is_lambertian(surface)) {
            found.surface = surface;
            found.uv_sets = maps_.uv_sets();
        }
        return found;
    }

  private:
    /// A number of `owner`, clamped to [low, high].
    float number(const JsonValue& owner, const char* key, double otherwise, double low,
                 double high) {
        const double value = owner.number_or(key, otherwise);
        const double clamped = std::clamp(value, low, high);
        if (clamped != value)
            report_.count(owner.place(), described_material_unit,
                          std::string(key) + " lies outside of its range and is clamped");
        return static_cast<float>(clamped);
    }

    float share(const JsonValue& owner, const char* key, double otherwise) {
        return number(owner, key, otherwise, 0.0, 1.0);
    }

    /// The first three numbers of a factor of N, clamped; warns unless `quiet`, which is for those
    /// that have been read before.
    template <std::size_t N>
    glm::vec3 colour(const JsonValue& owner, const char* key, double most, bool quiet = false) {
        std::array<double, N> white{};
        white.fill(1.0);
        const std::array<double, N> values = owner.numbers_or<N>(key, white);
        const glm::dvec3 given(values[0], values[1], values[2]);
        const glm::dvec3 clamped = glm::clamp(given, 0.0, most);
        if (clamped != given && !quiet)
            report_.count(owner.place(), described_material_unit,
                          std::string(key) + " lies outside of its range and is clamped");
        return glm::vec3(clamped);
    }

    ColourParameter base_colour(const std::optional<JsonValue>& pbr) {
        if (!pbr) return {};
        return {colour<4>(*pbr, "baseColorFactor", 1.0, true),
                maps_.read(*pbr, "baseColorTexture", Channel::rgb, true)};
    }

    SurfaceModel metallic_roughness(const JsonValue& material,
                                    const std::optional<JsonValue>& pbr) {
        MetallicSurface surface;
        if (pbr) {
            surface.metallic.factor = share(*pbr, "metallicFactor", 1.0);
            surface.roughness.value.factor = share(*pbr, "roughnessFactor", 1.0);
        }
        read_factors(material, surface);
        // Textures of a lobe that is not there are not read.
        if (surface.is_diffuse()) return LambertSurface{base_colour(pbr)};
        surface.base_colour = base_colour(pbr);
        if (pbr && !surface.metallic.is_zero())
            surface.metallic.map =
                maps_.read(*pbr, "metallicRoughnessTexture", Channel::blue, false);
        if (pbr && surface.roughness.value.factor > 0.0F)
            surface.roughness.value.map =
                maps_.read(*pbr, "metallicRoughnessTexture", Channel::green, false);
        read_textures(material, surface);
        return surface;
    }

    /// The numbers of the extensions.
    void read_factors(const JsonValue& material, MetallicSurface& surface) {
        if (const auto ior = material.extension("KHR_materials_ior")) {
            const bool reflects_all = ior->number_or("ior", 1.5) == 0.0;
            surface.ior = reflects_all ? 0.0F : number(*ior, "ior", 1.5, 1.0, largest_ior);
        }
        if (const auto specular = material.extension("KHR_materials_specular")) {
            surface.specular.factor = share(*specular, "specularFactor", 1.0);
            surface.specular_colour.factor =
                colour<3>(*specular, "specularColorFactor", largest_float);
        }
        if (const auto transmission = material.extension("KHR_materials_transmission"))
            surface.transmission.factor = share(*transmission, "transmissionFactor", 0.0);
        const auto volume = material.extension("KHR_materials_volume");
        if (volume && !surface.transmission.is_zero()) read_volume(*volume, surface);
        if (const auto coat = material.extension("KHR_materials_clearcoat")) {
            surface.clearcoat.factor.factor = share(*coat, "clearcoatFactor", 0.0);
            surface.clearcoat.roughness.value.factor =
                share(*coat, "clearcoatRoughnessFactor", 0.0);
        }
        if (const auto anisotropy = material.extension("KHR_materials_anisotropy")) {
            surface.anisotropy.strength = share(*anisotropy, "anisotropyStrength", 0.0);
            surface.anisotropy.rotation =
                number(*anisotropy, "anisotropyRotation", 0.0, -largest_float, largest_float);
        }
    }

    void read_volume(const JsonValue& volume, MetallicSurface& surface) {
        surface.solid = number(volume, "thicknessFactor", 0.0, 0.0, largest_float) > 0.0F;
        surface.absorption.colour = colour<3>(volume, "attenuationColor", 1.0);
        const double distance = volume.number_or("attenuationDistance", 0.0);
        if (volume.find("attenuationDistance") && !(distance > 0.0))
            report_.count(volume.place(), described_material_unit,
                          "attenuationDistance is not above 0, nothing is absorbed");
        surface.absorption.distance = std::max(distance, 0.0);
    }

    /// The textures of the extensions, but for those that a factor of 0 switches off.
    void read_textures(const JsonValue& material, MetallicSurface& surface) {
        const auto specular = material.extension("KHR_materials_specular");
        if (specular && !surface.specular.is_zero()) {
            surface.specular.map = maps_.read(*specular, "specularTexture", Channel::alpha, true);
            surface.specular_colour.map =
                maps_.read(*specular, "specularColorTexture", Channel::rgb, true);
        }
        const auto transmission = material.extension("KHR_materials_transmission");
        if (transmission && !surface.transmission.is_zero())
            surface.transmission.map =
                maps_.read(*transmission, "transmissionTexture", Channel::red, false);
        const auto anisotropy = material.extension("KHR_materials_anisotropy");
        if (anisotropy && surface.anisotropy.strength > 0.0F)
            surface.anisotropy.map =
                maps_.read(*anisotropy, "anisotropyTexture", Channel::rgb, false);
        const auto coat = material.extension("KHR_materials_clearcoat");
        if (!coat || !surface.clearcoat.present()) return;
        surface.clearcoat.factor.map = maps_.read(*coat, "clearcoatTexture", Channel::red, false);
        if (surface.clearcoat.roughness.value.factor > 0.0F)
            surface.clearcoat.roughness.value.map =
                maps_.read(*coat, "clearcoatRoughnessTexture", Channel::green, false);
        surface.clearcoat.normal_map = normal_map(*coat, "clearcoatNormalTexture");
    }

    SpecularSurface specular_glossiness(const JsonValue& glossy) {
        SpecularSurface surface;
        surface.diffuse = {colour<4>(glossy, "diffuseFactor", 1.0),
                           maps_.read(glossy, "diffuseTexture", Channel::rgb, true)};
        surface.specular = {colour<3>(glossy, "specularFactor", 1.0),
                            maps_.read(glossy, "specularGlossinessTexture", Channel::rgb, true)};
        surface.roughness.scale = RoughnessScale::glossiness;
        surface.roughness.value = {
            share(glossy, "glossinessFactor", 1.0),
            maps_.read(glossy, "specularGlossinessTexture", Channel::alpha, true)};
        surface.diffuse_is_scaled = true;
        return surface;
    }

    NormalMap normal_map(const JsonValue& owner, const char* key) {
        NormalMap normals;
        const std::optional<JsonValue> info = owner.find(key);
        if (!info) return normals;
        normals.map = maps_.read(owner, key, Channel::rgb, false);
        normals.scale = number(*info, "scale", 1.0, -largest_normal_scale, largest_normal_scale);
        return normals;
    }

    /// Alpha is that of the base colour, which `owner` has, or of a specular-glossiness surface's
    /// diffuse colour.
    Opacity opacity(const JsonValue& material, const JsonValue* owner, bool glossy) {
        Opacity opacity;
        const std::string mode = material.string_or("alphaMode", "OPAQUE");
        if (mode == "MASK")
            opacity.mode = OpacityMode::mask;
        else if (mode == "BLEND")
            opacity.mode = OpacityMode::blend;
        else
            return opacity;
        opacity.cutoff = number(material, "alphaCutoff", 0.5, 0.0, largest_float);
        if (owner == nullptr) return opacity;
        const std::array<double, 4> factor = owner->numbers_or<4>(
            glossy ? "diffuseFactor" : "baseColorFactor", {1.0, 1.0, 1.0, 1.0});
        opacity.alpha.factor = static_cast<float>(std::clamp(factor[3], 0.0, 1.0));
        opacity.alpha.map = maps_.read(*owner, glossy ? "diffuseTexture" : "baseColorTexture",
                                       Channel::alpha, true);
        return opacity;
    }

    GltfTextureMaps maps_;
    WarningCollector& report_;
};

}  // namespace

GltfDescription read_gltf_surface(const JsonValue& material, GltfTextures& textures,
                                  WarningCollector& report) {
    return GltfSurfaceReader(textures, report).read(material);
}

SurfaceDescription default_gltf_surface() {
    return {MetallicSurface{}, {}, {}};
}

}  // namespace weft
