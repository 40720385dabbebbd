// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_bsdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/quote.h"
#include "scene/mitsuba/mitsuba_optics.h"

namespace weft::mitsuba {

namespace {

constexpr double largest_index = 100.0;
constexpr double largest_alpha = 1e6;
// Mitsuba clamps to this.
constexpr float least_alpha = 1e-4F;

/// An index of refraction: a number, or the name of a material.
double read_ior(Object& object, const char* name, const char* missing) {
    const Element* const found = object.find(name);
    if (found == nullptr) return named_ior(missing).value_or(1.0);
    const std::string& text = found->required("value");
    if (found->tag == "string") {
        const std::optional<double> known = named_ior(text);
        if (!known)
            throw input_error(found->place(), fmt::format("{} names the material {}, expected one "
                                                          "of {}",
                                                          name, quote(text), ior_names()));
        return *known;
    }
    if (found->tag != "float" && found->tag != "integer")
        throw input_error(found->place(), fmt::format("{} is a <{}>, expected a <float> or the "
                                                      "<string> of a material",
                                                      name, found->tag));
    const double value = parse_number(*found, text);
    if (!(value >= 1.0 / largest_index && value <= largest_index))
        throw input_error(found->place(), fmt::format("{} is {}, expected {:g} to {:g}", name,
                                                      value, 1.0 / largest_index, largest_index));
    return value;
}

MicrofacetDistribution read_distribution(Object& object) {
    std::string name = object.text("distribution").value_or("beckmann");
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    object.ignore({"sample_visible"});
    if (name == "beckmann") return MicrofacetDistribution::beckmann;
    if (name == "ggx") return MicrofacetDistribution::ggx;
    throw input_error(object.place(), "distribution " + quote(name) + ", expected beckmann or ggx");
}

Roughness read_alpha(Object& object, TextureReader& textures, const char* name) {
    ScalarParameter alpha = textures.scalar(object, name, 0.1, largest_alpha);
    if (!alpha.map.present()) alpha.factor = std::max(alpha.factor, least_alpha);
    return {alpha, RoughnessScale::alpha};
}

/// Roughness along u and across it.
struct RoughnessPair {
    Roughness u, v;
};

RoughnessPair read_roughness(Object& object, TextureReader& textures) {
    const bool has_u = object.find("alpha_u") != nullptr;
    const bool has_v = object.find("alpha_v") != nullptr;
    if (!has_u && !has_v) {
        const Roughness alpha = read_alpha(object, textures, "alpha");
        return {alpha, alpha};
    }
    if (!has_u || !has_v || object.find("alpha") != nullptr)
        throw input_error(object.place(),
                          "'alpha_u' or 'alpha_v' alone or beside 'alpha', expected both of them, "
                          "or 'alpha' alone");
    return {read_alpha(object, textures, "alpha_u"), read_alpha(object, textures, "alpha_v")};
}

ConductorSurface read_conductor(Object& object, TextureReader& textures, Context& context,
                                bool rough) {
    ConductorSurface surface;
    const std::string material = object.text("material").value_or("none");
    const bool has_index = object.find("eta") != nullptr || object.find("k") != nullptr;
    if (has_index && material != "none")
        throw input_error(object.place(),
                          "both a material and 'eta' or 'k', expected one of the two");
    std::optional<ConductorIndex> index = named_conductor(material);
    if (!index) {
        context.warnings.count(object.element(), {"bsdf", "bsdfs"},
                               "metal " + quote(material) + " is not known, aluminium is used");
        index = named_conductor("Al");
    }
    surface.eta = object.colour("eta", ColourUse::medium, index->eta);
    surface.k = object.colour("k", ColourUse::medium, index->k);
    surface.reflectance = textures.reflectance(object, "specular_reflectance", glm::vec3(1.0F));
    if (!rough) return surface;
    const RoughnessPair roughness = read_roughness(object, textures);
    surface.roughness_u = roughness.u;
    surface.roughness_v = roughness.v;
    surface.microfacets = mitsuba_microfacets(read_distribution(object));
    return surface;
}

DielectricSurface read_dielectric(Object& object, TextureReader& textures, bool rough, bool thin) {
    DielectricSurface surface;
    surface.ior_inside = read_ior(object, "int_ior", "bk7");
    surface.ior_outside = read_ior(object, "ext_ior", "air");
    surface.reflectance = textures.reflectance(object, "specular_reflectance", glm::vec3(1.0F));
    surface.transmittance = textures.reflectance(object, "specular_transmittance", glm::vec3(1.0F));
    surface.thin = thin;
    surface.local_index = true;
    if (!rough) return surface;
    const RoughnessPair roughness = read_roughness(object, textures);
    surface.roughness_u = roughness.u;
    surface.roughness_v = roughness.v;
    surface.microfacets = mitsuba_microfacets(read_distribution(object));
    return surface;
}

PlasticSurface read_plastic(Object& object, TextureReader& textures, bool rough) {
    PlasticSurface surface;
    surface.ior_inside = read_ior(object, "int_ior", "polypropylene");
    surface.ior_outside = read_ior(object, "ext_ior", "air");
    surface.diffuse = textures.reflectance(object, "diffuse_reflectance", glm::vec3(0.5F));
    surface.specular = textures.reflectance(object, "specular_reflectance", glm::vec3(1.0F));
    surface.nonlinear = object.boolean("nonlinear", false);
    if (!rough) return surface;
    surface.roughness = read_alpha(object, textures, "alpha");
    surface.microfacets = mitsuba_microfacets(read_distribution(object));
    return surface;
}

double read_principled_ior(Object& object) {
    if (object.find("eta") != nullptr && object.find("specular") != nullptr)
        throw input_error(object.place(), "both 'eta' and 'specular', expected one of the two");
    if (object.find("eta") != nullptr) {
        const double eta = object.number("eta", 1.5);
        if (!(eta >= 1.0 && eta <= largest_index))
            throw input_error(object.place(),
                              fmt::format("eta is {}, expected 1 to {:g}", eta, largest_index));
        return eta;
    }
    const double specular = object.number("specular", 0.5);
    if (!(specular >= 0.0 && specular <= 1.0))
        throw input_error(object.place(), fmt::format("specular is {}, expected 0 to 1", specular));
    return 2.0 / (1.0 - std::sqrt(0.08 * specular)) - 1.0;
}

/// The colour by which a dielectric's reflection is tinted, mixed from white.
glm::vec3 specular_tint(const glm::vec3& base, float tint) {
    const float luminance = glm::dot(base, glm::vec3(0.212671F, 0.715160F, 0.072169F));
    const glm::vec3 hue = luminance > 0.0F ? base / luminance : glm::vec3(1.0F);
    return glm::mix(glm::vec3(1.0F), hue, tint);
}

/// Disney's surface as nearly as metal, dielectric and coat come to it. Sheen and flatness are left
/// out.
MetallicSurface read_principled(Object& object, TextureReader& textures) {
    const auto share = [&](const char* name, double missing) {
        return textures.scalar(object, name, missing, 1.0);
    };
    MetallicSurface surface;
    surface.base_colour = textures.reflectance(object, "base_color", glm::vec3(0.5F));
    surface.metallic = share("metallic", 0.0);
    surface.transmission = share("spec_trans", 0.0);
    surface.transmission_by_root = true;
    surface.solid = surface.transmits();
    surface.ior = static_cast<float>(read_principled_ior(object));
    surface.specular_colour.factor =
        specular_tint(surface.base_colour.factor, share("spec_tint", 0.0).factor);
    surface.roughness.value = share("roughness", 0.5);
    // Across the tangent alpha is r^2 times this aspect, along it r^2 over the aspect.
    const double aspect = std::sqrt(1.0 - 0.9 * share("anisotropic", 0.0).factor);
    const double squared = alpha_of(surface.roughness.value.factor, RoughnessScale::roughness);
    const double along = std::min(squared / aspect, 1.0);
    const double across = squared * aspect;
    surface.roughness.value.factor *= static_cast<float>(std::sqrt(aspect));
    if (across < along)
        surface.anisotropy.strength =
            static_cast<float>(std::sqrt((along - across) / (1.0 - across)));
    surface.clearcoat.factor = share("clearcoat", 0.0);
    surface.clearcoat.factor.factor *= 0.25F;
    const float gloss = share("clearcoat_gloss", 0.0).factor;
    surface.clearcoat.roughness = {{glm::mix(0.1F, 0.001F, gloss)}, RoughnessScale::alpha};
    object.ignore({"sheen", "sheen_tint", "flatness", "diffuse_reflectance_sampling_rate",
                   "main_specular_sampling_rate", "clearcoat_sampling_rate"});
    return surface;
}

}  // namespace

std::optional<SurfaceModel> read_bsdf_model(Object& object, TextureReader& textures,
                                            Context& context) {
    const std::string& type = object.type();
    if (type == "conductor") return read_conductor(object, textures, context, false);
    if (type == "roughconductor") return read_conductor(object, textures, context, true);
    if (type == "dielectric") return read_dielectric(object, textures, false, false);
    if (type == "roughdielectric") return read_dielectric(object, textures, true, false);
    if (type == "thindielectric") return read_dielectric(object, textures, false, true);
    if (type == "plastic") return read_plastic(object, textures, false);
    if (type == "roughplastic") return read_plastic(object, textures, true);
    if (type == "principled") return read_principled(object, textures);
    return std::nullopt;
}

NormalMap read_normal_map(Object& object, TextureReader& textures) {
    const Element* const texture = object.find("normalmap");
    if (texture == nullptr)
        throw input_error(object.place(),
                          "normalmap without a texture, expected a <texture name=\"normalmap\">");
    NormalMap normals;
    normals.map = textures.vectors(*texture);
    normals.mitsuba_frame = true;
    normals.mitsuba_flip = object.boolean("flip_invalid_normals", true);
    normals.mitsuba_shadowing = object.boolean("use_shadowing_function", true);
    return normals;
}

Opacity read_opacity(Object& object, TextureReader& textures) {
    Opacity opacity;
    opacity.mode = OpacityMode::blend;
    opacity.alpha = textures.scalar(object, "opacity", 0.5, 1.0);
    return opacity;
}

}  // namespace weft::mitsuba
