// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_surface.h"

#include <algorithm>
#include <string>

namespace weft {
namespace {

constexpr WarningUnit mtl_surface_unit{"material", "materials"};
constexpr double largest_exponent = 1e9;
constexpr double largest_mtl_ior = 100.0;
constexpr double largest_strength = 1000.0;
// Of a map_Ns without Ns, which goes up to that.
constexpr double usual_exponent = 1000.0;
// The reflectance of varnish, which a coat keeps however bright the surface below it is.
constexpr float least_coat = 0.04F;

float largest(const glm::vec3& colour) {
    return std::max({colour.r, colour.g, colour.b});
}

/// Makes the description of one material.
class MtlDescriber {
  public:
    MtlDescriber(const MtlMaterial& source, const ColourParameter& diffuse,
                 const MtlMapReader& read_map, WarningCollector& report)
        : source_(source), diffuse_(diffuse), read_map_(read_map), report_(report) {}

    std::optional<SurfaceDescription> describe() {
        SurfaceDescription surface{model(), {}, {}};
        if (source_.normal_map) {
            surface.normal_map.map = read_map_(*source_.normal_map, MtlMapUse::normals);
            surface.normal_map.scale =
                number(source_.normal_map->strength, -largest_strength, largest_strength, "-bm");
        }
        // Clear glass has its transparency by itself.
        if (!std::holds_alternative<DielectricSurface>(surface.model)) surface.opacity = opacity();
        if (is_lambertian(surface)) return std::nullopt;
        return surface;
    }

  private:
    SurfaceModel model() {
        if (source_.roughness || source_.metallic || source_.roughness_map || source_.metallic_map)
            return metallic();
        const double illum = source_.illumination.value_or(2.0);
        const glm::vec3 specular =
            source_.specular.value_or(glm::vec3(source_.specular_map ? 1.0F : 0.0F));
        const bool reflects = largest(specular) > 0.0F;
        if (is_one_of(illum, {4.0, 6.0, 7.0, 9.0}) ||
            (dissolve() < 1.0 && source_.ior.value_or(1.0) > 1.0 && illum >= 4.0))
            return glass();
        if (!reflects) return LambertSurface{diffuse_};
        SpecularSurface surface;
        surface.diffuse = diffuse_;
        surface.specular = {specular, map(source_.specular_map, MtlMapUse::colour)};
        surface.roughness.scale = RoughnessScale::exponent;
        if (is_one_of(illum, {3.0, 5.0, 8.0})) {
            surface.roughness = {{0.0F}, RoughnessScale::alpha};
            return surface;
        }
        const float room = std::max(1.0F - largest(diffuse_.factor), least_coat);
        surface.specular.factor *= std::min(room / largest(specular), 1.0F);
        const double exponent =
            source_.exponent.value_or(source_.exponent_map ? usual_exponent : 0.0);
        surface.roughness.value = {number(exponent, 0.0, largest_exponent, "Ns"),
                                   map(source_.exponent_map, MtlMapUse::number)};
        return surface;
    }

    MetallicSurface metallic() {
        MetallicSurface surface;
        surface.base_colour = diffuse_;
        surface.metallic = {
            number(source_.metallic.value_or(source_.metallic_map ? 1.0 : 0.0), 0.0, 1.0, "Pm"),
            map(source_.metallic_map, MtlMapUse::number)};
        surface.roughness.value = {number(source_.roughness.value_or(1.0), 0.0, 1.0, "Pr"),
                                   map(source_.roughness_map, MtlMapUse::number)};
        surface.clearcoat.factor = {number(source_.coat.value_or(0.0), 0.0, 1.0, "Pc")};
        surface.clearcoat.roughness.value = {
            number(source_.coat_roughness.value_or(0.0), 0.0, 1.0, "Pcr")};
        return surface;
    }

    DielectricSurface glass() {
        DielectricSurface surface;
        surface.ior_inside = number(source_.ior.value_or(1.0), 1.0, largest_mtl_ior, "Ni");
        surface.transmittance.factor = source_.filter.value_or(glm::vec3(1.0F));
        return surface;
    }

    Opacity opacity() {
        Opacity opacity;
        const double share = dissolve();
        if (share == 1.0 && !source_.dissolve_map) return opacity;
        opacity.mode = OpacityMode::blend;
        opacity.alpha = {number(share, 0.0, 1.0, "d"), map(source_.dissolve_map, MtlMapUse::alpha)};
        return opacity;
    }

    [[nodiscard]] double dissolve() const {
        return source_.dissolve.value_or(1.0 - source_.transparency.value_or(0.0));
    }

    static bool is_one_of(double value, std::initializer_list<double> list) {
        return std::find(list.begin(), list.end(), value) != list.end();
    }

    TextureMap map(const std::optional<MtlMap>& image, MtlMapUse use) {
        return image ? read_map_(*image, use) : TextureMap{};
    }

    float number(double value, double low, double high, const char* name) {
        const double clamped = std::clamp(value, low, high);
        if (clamped != value)
            report_.count(source_.place, mtl_surface_unit,
                          std::string(name) + " lies outside of its range and is clamped");
        return static_cast<float>(clamped);
    }

    const MtlMaterial& source_;
    const ColourParameter& diffuse_;
    const MtlMapReader& read_map_;
    WarningCollector& report_;
};

}  // namespace

std::optional<SurfaceDescription> describe_mtl(const MtlMaterial& source,
                                               const ColourParameter& diffuse,
                                               const MtlMapReader& read_map,
                                               WarningCollector& report) {
    return MtlDescriber(source, diffuse, read_map, report).describe();
}

}  // namespace weft
