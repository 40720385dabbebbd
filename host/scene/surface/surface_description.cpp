// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/surface/surface_description.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

constexpr float largest_ior = 100.0F;
constexpr float largest_scale = 1000.0F;  // of normals

void add(const TextureMap& map, std::vector<const TextureMap*>& maps) {
    if (map.present()) maps.push_back(&map);
}

/// The textures of each model.
class Maps {
  public:
    explicit Maps(std::vector<const TextureMap*>& maps) : maps_(maps) {}

    void operator()(const LambertSurface& s) { add_all({&s.colour.map}); }
    void operator()(const UnlitSurface& s) { add_all({&s.colour.map}); }
    void operator()(const MetallicSurface& s) {
        add_all({&s.base_colour.map, &s.metallic.map, &s.roughness.value.map, &s.anisotropy.map,
                 &s.specular.map, &s.specular_colour.map, &s.transmission.map,
                 &s.clearcoat.factor.map, &s.clearcoat.roughness.value.map,
                 &s.clearcoat.normal_map.map});
    }
    void operator()(const SpecularSurface& s) {
        add_all({&s.diffuse.map, &s.specular.map, &s.roughness.value.map});
    }
    void operator()(const ConductorSurface& s) {
        add_all({&s.reflectance.map, &s.roughness_u.value.map, &s.roughness_v.value.map});
    }
    void operator()(const DielectricSurface& s) {
        add_all({&s.reflectance.map, &s.transmittance.map, &s.roughness_u.value.map,
                 &s.roughness_v.value.map});
    }
    void operator()(const PlasticSurface& s) {
        add_all({&s.diffuse.map, &s.specular.map, &s.roughness.value.map});
    }

  private:
    void add_all(std::initializer_list<const TextureMap*> maps) {
        for (const TextureMap* map : maps) add(*map, maps_);
    }

    std::vector<const TextureMap*>& maps_;
};

bool is_share(float x) {
    return x >= 0.0F && x <= 1.0F;
}

bool is_colour(const ColourParameter& c) {
    return is_share(c.factor.r) && is_share(c.factor.g) && is_share(c.factor.b);
}

bool is_positive(const glm::vec3& v) {
    return v.r >= 0.0F && v.g >= 0.0F && v.b >= 0.0F && std::isfinite(v.r + v.g + v.b);
}

bool is_index(double ior) {
    return ior >= 1.0 / largest_ior && ior <= largest_ior;
}

bool is_roughness(const Roughness& roughness) {
    const float value = roughness.value.factor;
    const bool may_exceed_one =
        roughness.scale == RoughnessScale::alpha || roughness.scale == RoughnessScale::exponent;
    return value >= 0.0F && (may_exceed_one ? std::isfinite(value) : value <= 1.0F);
}

bool is_scale(const NormalMap& map) {
    return std::abs(map.scale) <= largest_scale;
}

/// The first requirement that does not hold. Comparisons are such that NaN fails them.
struct Requirement {
    bool holds;
    const char* otherwise;
};

std::string first_problem(std::initializer_list<Requirement> requirements) {
    for (const Requirement& requirement : requirements)
        if (!requirement.holds) return requirement.otherwise;
    return {};
}

constexpr const char* bad_colour = "has a colour outside [0, 1]";
constexpr const char* bad_roughness = "has a roughness outside of its range";
constexpr const char* bad_index = "has an index of refraction outside [0.01, 100]";

std::string problem(const LambertSurface& s) {
    return first_problem({{is_colour(s.colour), bad_colour}});
}

std::string problem(const UnlitSurface& s) {
    return first_problem({{is_colour(s.colour), bad_colour}});
}

std::string problem(const MetallicSurface& s) {
    const Clearcoat& coat = s.clearcoat;
    return first_problem(
        {{is_colour(s.base_colour), bad_colour},
         {is_share(s.metallic.factor), "has a metallic factor outside [0, 1]"},
         {is_roughness(s.roughness), bad_roughness},
         {is_share(s.anisotropy.strength), "has an anisotropy outside [0, 1]"},
         {std::isfinite(s.anisotropy.rotation),
          "has an anisotropy in a direction that is not finite"},
         {s.ior == 0.0F || (s.ior >= 1.0F && s.ior <= largest_ior),
          "has an index of refraction that is neither 0 nor in [1, 100]"},
         {is_share(s.specular.factor), "has a specular factor outside [0, 1]"},
         {is_positive(s.specular_colour.factor),
          "has a specular colour that is negative or not finite"},
         {is_share(s.transmission.factor), "has a transmission outside [0, 1]"},
         {is_colour({s.absorption.colour, {}}), "has an attenuation colour outside [0, 1]"},
         {s.absorption.distance >= 0.0 && std::isfinite(s.absorption.distance),
          "has an attenuation distance that is negative or not finite"},
         {is_share(coat.factor.factor), "has a clear coat outside [0, 1]"},
         {is_roughness(coat.roughness), "has a clear coat with a roughness outside [0, 1]"},
         {is_scale(coat.normal_map), "has a clear coat with normals scaled beyond 1000"}});
}

std::string problem(const SpecularSurface& s) {
    return first_problem({{is_colour(s.diffuse), bad_colour},
                          {is_colour(s.specular), "has a specular colour outside [0, 1]"},
                          {is_roughness(s.roughness), bad_roughness}});
}

std::string problem(const ConductorSurface& s) {
    return first_problem(
        {{is_positive(s.eta) && is_positive(s.k),
          "has a complex index of refraction that is negative or not finite"},
         {is_colour(s.reflectance), bad_colour},
         {is_roughness(s.roughness_u) && is_roughness(s.roughness_v), bad_roughness}});
}

std::string problem(const DielectricSurface& s) {
    return first_problem(
        {{is_index(s.ior_inside) && is_index(s.ior_outside), bad_index},
         {is_colour(s.reflectance) && is_colour(s.transmittance), bad_colour},
         {is_roughness(s.roughness_u) && is_roughness(s.roughness_v), bad_roughness}});
}

std::string problem(const PlasticSurface& s) {
    return first_problem({{is_index(s.ior_inside) && is_index(s.ior_outside), bad_index},
                          {is_colour(s.diffuse) && is_colour(s.specular), bad_colour},
                          {is_roughness(s.roughness), bad_roughness}});
}

}  // namespace

bool is_lambertian(const SurfaceDescription& surface) {
    if (surface.normal_map.present() || surface.opacity.mode != OpacityMode::opaque) return false;
    if (std::holds_alternative<LambertSurface>(surface.model)) return true;
    const auto* const metallic = std::get_if<MetallicSurface>(&surface.model);
    return metallic != nullptr && metallic->is_diffuse();
}

bool transmits(const SurfaceDescription& surface) {
    if (std::holds_alternative<DielectricSurface>(surface.model)) return true;
    const auto* const metallic = std::get_if<MetallicSurface>(&surface.model);
    return metallic != nullptr && metallic->transmits();
}

ColourParameter* diffuse_colour(SurfaceDescription& surface) {
    if (auto* const s = std::get_if<LambertSurface>(&surface.model)) return &s->colour;
    if (auto* const s = std::get_if<UnlitSurface>(&surface.model)) return &s->colour;
    if (auto* const s = std::get_if<MetallicSurface>(&surface.model)) return &s->base_colour;
    if (auto* const s = std::get_if<SpecularSurface>(&surface.model)) return &s->diffuse;
    if (auto* const s = std::get_if<PlasticSurface>(&surface.model)) return &s->diffuse;
    return nullptr;
}

std::vector<Roughness*> roughness_of(SurfaceDescription& surface) {
    if (auto* const s = std::get_if<MetallicSurface>(&surface.model)) return {&s->roughness};
    if (auto* const s = std::get_if<SpecularSurface>(&surface.model)) return {&s->roughness};
    if (auto* const s = std::get_if<PlasticSurface>(&surface.model)) return {&s->roughness};
    if (auto* const s = std::get_if<ConductorSurface>(&surface.model))
        return {&s->roughness_u, &s->roughness_v};
    if (auto* const s = std::get_if<DielectricSurface>(&surface.model))
        return {&s->roughness_u, &s->roughness_v};
    return {};
}

std::vector<const TextureMap*> texture_maps(const SurfaceDescription& surface) {
    std::vector<const TextureMap*> maps;
    std::visit(Maps(maps), surface.model);
    add(surface.normal_map.map, maps);
    add(surface.opacity.alpha.map, maps);
    return maps;
}

std::string surface_problem(const SurfaceDescription& surface) {
    std::string of_model =
        std::visit([](const auto& model) { return problem(model); }, surface.model);
    if (!of_model.empty()) return of_model;
    const Opacity& opacity = surface.opacity;
    return first_problem({{is_scale(surface.normal_map), "has normals scaled beyond 1000"},
                          {opacity.cutoff >= 0.0F && std::isfinite(opacity.cutoff),
                           "has a cut-off of alpha that is negative or not finite"},
                          {is_share(opacity.alpha.factor), "has an alpha outside [0, 1]"}});
}

}  // namespace weft
