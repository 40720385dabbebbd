// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mean_albedo.h"

#include <algorithm>

namespace weft {
namespace {

/// Mean over all directions of Schlick's reflectance.
glm::vec3 schlick_mean(const glm::vec3& f0, float f90) {
    return f0 + (glm::vec3(f90) - f0) / 21.0F;
}

float largest(const glm::vec3& v) {
    return std::max({v.r, v.g, v.b});
}

/// Adds up what the parts of one description reflect.
class AlbedoSum {
  public:
    explicit AlbedoSum(std::span<const TextureStatistics> textures) : textures_(textures) {}

    glm::vec3 operator()(const LambertSurface& s) { return base(s.colour); }
    glm::vec3 operator()(const UnlitSurface& s) { return 0.0F * base(s.colour); }
    glm::vec3 operator()(const MetallicSurface& s) {
        const glm::vec3 colour = base(s.base_colour);
        const float metallic = mean(s.metallic);
        const float strength = mean(s.specular);
        const float root = (s.ior - 1.0F) / (s.ior + 1.0F);
        const glm::vec3 f0 =
            glm::min(mean(s.specular_colour) * root * root, glm::vec3(1.0F)) * strength;
        const glm::vec3 mirror = schlick_mean(f0, strength);
        const float coat = mean(s.clearcoat.factor) * schlick_mean(glm::vec3(0.04F), 1.0F).r;
        const glm::vec3 body = colour * ((1.0F - mean(s.transmission)) * (1.0F - largest(mirror)));
        const glm::vec3 all =
            glm::mix(mirror + body, schlick_mean(colour, 1.0F), metallic) * (1.0F - coat);
        return all + coat;
    }
    glm::vec3 operator()(const SpecularSurface& s) {
        const glm::vec3 f0 = glm::min(mean(s.specular), glm::vec3(1.0F));
        const glm::vec3 mirror = schlick_mean(f0, 1.0F);
        const float scale = s.diffuse_is_scaled ? 1.0F - largest(f0) : 1.0F;
        return base(s.diffuse) * (scale * (1.0F - largest(mirror))) + mirror;
    }
    glm::vec3 operator()(const ConductorSurface& s) {
        const glm::vec3 k2 = s.k * s.k;
        const glm::vec3 less = (s.eta - 1.0F) * (s.eta - 1.0F) + k2;
        const glm::vec3 more = (s.eta + 1.0F) * (s.eta + 1.0F) + k2;
        return mean(s.reflectance) * schlick_mean(less / more, 1.0F);
    }
    glm::vec3 operator()(const DielectricSurface& s) {
        return mean(s.reflectance) * schlick_mean(glm::vec3(normal_reflectance(s)), 1.0F);
    }
    glm::vec3 operator()(const PlasticSurface& s) {
        const float mirror = schlick_mean(glm::vec3(normal_reflectance(s)), 1.0F).r;
        // Of light inside, what is reflected back: by reciprocity of the means over both sides.
        const auto eta = static_cast<float>(s.ior_inside / s.ior_outside);
        const float inner = 1.0F - (1.0F - mirror) / (eta * eta);
        const glm::vec3 diffuse = base(s.diffuse);
        const glm::vec3 lost = s.nonlinear ? diffuse * inner : glm::vec3(inner);
        return diffuse * ((1.0F - mirror) * (1.0F - inner)) / (glm::vec3(1.0F) - lost) +
               mean(s.specular) * mirror;
    }

    /// Mean colour of the texture that the result is to be a factor of; 1 without.
    glm::vec3 texture{1.0F};

  private:
    template <class Boundary>
    static float normal_reflectance(const Boundary& s) {
        const auto root =
            static_cast<float>((s.ior_inside - s.ior_outside) / (s.ior_inside + s.ior_outside));
        return root * root;
    }

    /// Mean linear colour of a texture.
    [[nodiscard]] glm::vec3 mean_colour(const TextureMap& map) const {
        if (!map.present()) return glm::vec3(1.0F);
        return glm::vec3(textures_[static_cast<std::size_t>(map.texture)].mean);
    }

  public:
    [[nodiscard]] float mean(const ScalarParameter& scalar) const {
        if (!scalar.map.present()) return scalar.factor;
        const auto number = static_cast<std::size_t>(scalar.map.texture);
        return scalar.factor * static_cast<float>(textures_[number].mean_of(scalar.map.channel));
    }
    [[nodiscard]] glm::vec3 mean(const ColourParameter& colour) const {
        return colour.factor * mean_colour(colour.map);
    }
    static float luminance_of(const glm::vec3& c) {
        return 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b;
    }

  private:
    glm::vec3 base(const ColourParameter& colour) {
        texture = mean_colour(colour.map);
        return colour.factor * texture;
    }

    std::span<const TextureStatistics> textures_;
};

/// What glass transmits, or 0.
float glass_transmittance(const SurfaceDescription& surface, const AlbedoSum& sum) {
    if (const auto* const s = std::get_if<MetallicSurface>(&surface.model))
        return sum.mean(s->transmission) * (1.0F - sum.mean(s->metallic)) *
               AlbedoSum::luminance_of(sum.mean(s->base_colour));
    if (const auto* const s = std::get_if<DielectricSurface>(&surface.model))
        return AlbedoSum::luminance_of(sum.mean(s->transmittance));
    return 0.0F;
}

}  // namespace

float mean_transmittance(const Material& material, std::span<const TextureStatistics> textures) {
    if (!material.description) return 0.0F;
    const AlbedoSum sum(textures);
    const SurfaceDescription& surface = *material.description;
    const float there =
        surface.opacity.mode == OpacityMode::blend ? sum.mean(surface.opacity.alpha) : 1.0F;
    return std::clamp(1.0F - there * (1.0F - glass_transmittance(surface, sum)), 0.0F, 1.0F);
}

glm::vec3 mean_albedo(const Material& material, std::span<const TextureStatistics> textures) {
    if (!material.description || is_lambertian(*material.description))
        return diffuse_albedo(material);
    AlbedoSum sum(textures);
    const glm::vec3 all = std::visit(sum, material.description->model);
    glm::vec3 factor = all;
    // The texture varies, and what is white beside it does not: the mean is right.
    if (albedo_texture(material) >= 0)
        factor = all / glm::max(sum.texture, glm::vec3(1.0F / 255.0F));
    return glm::clamp(factor, 0.0F, 1.0F);
}

}  // namespace weft
