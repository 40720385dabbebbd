// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/surface_lobes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {
namespace {

constexpr double widest_sharp = 1e-3;
constexpr double widest_glossy = 0.25;
// EVEN_ALPHA and EVEN_REFLECTANCE of kernels/bsdf/seen_lobes.h.
constexpr double even_alpha = 0.5;
constexpr double even_reflectance = 0.08;

double greatest(const glm::vec3& colour) {
    return static_cast<double>(std::max({colour.r, colour.g, colour.b}));
}

/// Share of light that a smooth boundary reflects at normal incidence.
double normal_reflectance(double ior) {
    const double root = (ior - 1.0) / (ior + 1.0);
    return root * root;
}

/// Gathers the lobes of one surface.
class LobeCollector {
  public:
    explicit LobeCollector(std::span<const TextureStatistics> textures) : textures_(textures) {}

    void operator()(const LambertSurface&) { add_diffuse(); }
    void operator()(const UnlitSurface&) { lobes.push_back({"unlit", true}); }
    void operator()(const MetallicSurface& s) {
        const bool all_metal = s.metallic.factor == 1.0F && !s.metallic.map.present();
        const bool all_clear = s.transmission.factor == 1.0F && !s.transmission.map.present();
        // Along the direction in which anisotropy stretches the lobe, alpha is mixed towards 1.
        SurfaceLobe shape = lobe_with("", s.roughness, s.roughness);
        const double strength = s.anisotropy.strength;
        shape.most_alpha += (1.0 - shape.most_alpha) * strength * strength;
        if (!s.metallic.is_zero()) add(shape, "metal", false);
        if (!all_metal && !s.specular.is_zero()) {
            shape.most_reflectance = std::min(1.0, normal_reflectance(static_cast<double>(s.ior)) *
                                                       greatest(s.specular_colour.factor)) *
                                     static_cast<double>(s.specular.factor);
            add(shape, "dielectric", false);
        }
        if (s.transmits()) add(shape, s.solid ? "glass" : "thin glass", true);
        if (!all_metal && !all_clear) add_diffuse();
        if (s.clearcoat.present()) {
            lobes.push_back(lobe_with("clear coat", s.clearcoat.roughness, s.clearcoat.roughness));
            lobes.back().most_reflectance = normal_reflectance(1.5);
        }
    }
    void operator()(const SpecularSurface& s) {
        if (s.specular.factor != glm::vec3(0.0F)) {
            lobes.push_back(lobe_with("reflection", s.roughness, s.roughness));
            lobes.back().most_reflectance = greatest(s.specular.factor);
        }
        if (s.diffuse.factor != glm::vec3(0.0F)) add_diffuse();
    }
    void operator()(const ConductorSurface& s) {
        lobes.push_back(lobe_with("metal", s.roughness_u, s.roughness_v));
    }
    void operator()(const DielectricSurface& s) {
        const SurfaceLobe shape = lobe_with("", s.roughness_u, s.roughness_v);
        add(shape, "dielectric", false);
        add(shape, s.thin ? "thin glass" : "glass", true);
    }
    void operator()(const PlasticSurface& s) {
        lobes.push_back(lobe_with("dielectric", s.roughness, s.roughness));
        lobes.back().most_reflectance =
            normal_reflectance(s.ior_inside / s.ior_outside) * greatest(s.specular.factor);
        add_diffuse();
    }

    std::vector<SurfaceLobe> lobes;

  private:
    void add_diffuse() { lobes.push_back({"diffuse", true}); }

    void add(SurfaceLobe shape, const char* name, bool transmits) {
        shape.name = name;
        shape.transmits = transmits;
        lobes.push_back(shape);
    }

    [[nodiscard]] SurfaceLobe lobe_with(const char* name, const Roughness& u,
                                        const Roughness& v) const {
        SurfaceLobe lobe{name};
        lobe.least_alpha = 1e9;
        for (const Roughness* roughness : {&u, &v}) {
            const TextureMap& map = roughness->value.map;
            ValueRange range{1.0, 1.0};
            if (map.present())
                range = textures_[static_cast<std::size_t>(map.texture)].range_of(map.channel);
            for (const double value : {range.least, range.most}) {
                const double alpha = alpha_of(roughness->value.factor * value, roughness->scale);
                lobe.least_alpha = std::min(lobe.least_alpha, alpha);
                lobe.most_alpha = std::max(lobe.most_alpha, alpha);
            }
        }
        return lobe;
    }

    std::span<const TextureStatistics> textures_;
};

bool is_anisotropic(const SurfaceDescription& surface) {
    if (const auto* const s = std::get_if<MetallicSurface>(&surface.model))
        return s->anisotropy.strength > 0.0F;
    const auto differ = [](const Roughness& u, const Roughness& v) {
        return u.value.factor != v.value.factor || u.value.map != v.value.map;
    };
    if (const auto* const s = std::get_if<ConductorSurface>(&surface.model))
        return differ(s->roughness_u, s->roughness_v);
    if (const auto* const s = std::get_if<DielectricSurface>(&surface.model))
        return differ(s->roughness_u, s->roughness_v);
    return false;
}

bool absorbs(const SurfaceDescription& surface) {
    const auto* const s = std::get_if<MetallicSurface>(&surface.model);
    return s != nullptr && s->solid && sigma_a(s->absorption) != glm::dvec3(0.0);
}

}  // namespace

bool is_nearly_diffuse(const SurfaceLobe& lobe) {
    return lobe.least_alpha >= even_alpha && lobe.most_reflectance <= even_reflectance;
}

LobeWidth width_of(double alpha) {
    if (alpha < std::ldexp(1.0, -12)) return LobeWidth::delta;
    if (alpha <= widest_sharp) return LobeWidth::sharp;
    return alpha < widest_glossy ? LobeWidth::glossy : LobeWidth::rough;
}

const char* name_of(LobeWidth width) {
    switch (width) {
        case LobeWidth::delta:
            return "delta";
        case LobeWidth::sharp:
            return "sharp";
        case LobeWidth::glossy:
            return "glossy";
        case LobeWidth::rough:
            return "rough";
    }
    return "";
}

std::vector<SurfaceLobe> lobes_of(const SurfaceDescription& surface,
                                  std::span<const TextureStatistics> textures) {
    LobeCollector collector(textures);
    std::visit(collector, surface.model);
    return std::move(collector.lobes);
}

std::vector<std::string> effects_of(const SurfaceDescription& surface,
                                    std::span<const SurfaceLobe> lobes) {
    std::vector<std::string> effects;
    const auto add = [&](const char* effect) {
        if (std::find(effects.begin(), effects.end(), effect) == effects.end())
            effects.emplace_back(effect);
    };
    for (const SurfaceLobe& lobe : lobes) {
        if (lobe.is_diffuse) continue;
        if (width_of(lobe.least_alpha) <= LobeWidth::sharp)
            add(lobe.transmits ? "refraction" : "mirror reflection");
        if (width_of(lobe.most_alpha) > LobeWidth::sharp)
            add(lobe.transmits ? "glossy refraction" : "glossy reflection");
    }
    if (absorbs(surface)) add("absorption");
    if (is_anisotropic(surface)) add("anisotropy");
    if (surface.normal_map.present()) add("normal maps");
    if (surface.opacity.mode != OpacityMode::opaque) add("gaps by alpha");
    if (std::holds_alternative<UnlitSurface>(surface.model)) add("unlit colour");
    return effects;
}

}  // namespace weft
