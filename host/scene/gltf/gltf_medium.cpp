// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_medium.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

constexpr double largest_coefficient = 1e30;
constexpr double largest_emission = 1e30;
// Least value of an attenuation colour: black absorbs much, but not infinitely.
constexpr double least_colour = 1e-30;

/// Coefficients per unit of length, by channel.
glm::dvec3 coefficients(const JsonValue& value, const char* name) {
    const std::array<double, 3> found = value.numbers_or<3>(name, {0.0, 0.0, 0.0});
    for (const double x : found)
        if (!(x >= 0.0 && x <= largest_coefficient))
            throw value.error(fmt::format("{} has the coefficient {}, expected 0 to {}", name, x,
                                          largest_coefficient));
    return {found[0], found[1], found[2]};
}

/// Radiance per unit of length, by channel.
glm::vec3 emission_of(const JsonValue& value) {
    const std::array<double, 3> found = value.numbers_or<3>("emission", {0.0, 0.0, 0.0});
    for (const double x : found)
        if (!(x >= 0.0 && x <= largest_emission))
            throw value.error(
                fmt::format("emission has the value {}, expected 0 to {}", x, largest_emission));
    return {glm::dvec3(found[0], found[1], found[2])};
}

/// Absorption by KHR_materials_volume: after attenuationDistance white light has attenuationColor.
glm::dvec3 attenuation(const JsonValue& value) {
    const std::optional<JsonValue> volume = value.extension("KHR_materials_volume");
    if (!volume || !volume->find("attenuationDistance")) return glm::dvec3(0.0);
    const double distance = volume->number_or("attenuationDistance", 1.0);
    if (!(distance > 0.0))
        throw volume->error(
            fmt::format("attenuationDistance is {}, expected more than 0", distance));
    const std::array<double, 3> colour = volume->numbers_or<3>("attenuationColor", {1.0, 1.0, 1.0});
    glm::dvec3 absorbed(0.0);
    for (int c = 0; c < 3; ++c) {
        const double left = colour.at(static_cast<std::size_t>(c));
        if (!(left >= 0.0 && left <= 1.0))
            throw volume->error(
                fmt::format("attenuationColor has the value {}, expected 0 to 1", left));
        absorbed[c] =
            std::min(-std::log(std::max(left, least_colour)) / distance, largest_coefficient);
    }
    return absorbed;
}

}  // namespace

std::optional<Medium> read_gltf_medium(const JsonValue& value, const std::string& name,
                                       GltfDensities& densities) {
    const std::optional<JsonValue> extension = value.extension("WEFT_medium");
    if (!extension) return std::nullopt;
    const glm::dvec3 scattered = coefficients(*extension, "scattering");
    const glm::dvec3 absorbed = coefficients(*extension, "absorption") + attenuation(value);
    const double g = extension->number_or("anisotropy", 0.0);
    Medium medium;
    medium.name = name;
    medium.type = "homogeneous";
    medium.emission = emission_of(*extension);
    medium.anisotropy = static_cast<float>(g);
    if (!(std::abs(medium.anisotropy) < 1.0F))
        throw extension->error(
            fmt::format("anisotropy is {}, expected more than -1 and less than 1", g));
    for (int c = 0; c < 3; ++c) {
        const double extinction = scattered[c] + absorbed[c];
        medium.sigma_t[c] = static_cast<float>(extinction);
        medium.albedo[c] = extinction > 0.0 ? static_cast<float>(scattered[c] / extinction) : 0.0F;
    }
    if (const std::optional<JsonValue> density = extension->find("density"))
        densities.read(*density, medium);
    return medium;
}

std::optional<Medium> read_gltf_outer_medium(const JsonValue& root, GltfDensities& densities) {
    const std::size_t scenes = root.size_of("scenes");
    if (scenes == 0) return std::nullopt;
    const std::optional<JsonValue> chosen = root.find("scene");
    const std::size_t scene = chosen ? chosen->as_index(scenes, "scenes") : 0;
    return read_gltf_medium(root.at("scenes").element(scene), "fog", densities);
}

}  // namespace weft
