// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_lights.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

void read_cone(const JsonValue& value, PunctualLight& light) {
    const JsonValue spot = value.at("spot");
    constexpr double right_angle = std::numbers::pi / 2;
    const double inner = spot.number_or("innerConeAngle", 0.0);
    const double outer = spot.number_or("outerConeAngle", std::numbers::pi / 4);
    // Exporters round the right angle up to float precision.
    if (outer <= 0.0 || outer > right_angle + 1e-6)
        throw spot.error("outerConeAngle is " + std::to_string(outer) +
                         ", expected above 0 and at most pi/2");
    if (inner < 0.0 || inner >= outer)
        throw spot.error("innerConeAngle is " + std::to_string(inner) +
                         ", expected at least 0 and below outerConeAngle, " +
                         std::to_string(outer));
    light.cos_inner = static_cast<float>(std::cos(inner));
    light.cos_outer = static_cast<float>(std::cos(std::fmin(outer, right_angle)));
}

glm::vec3 read_intensity(const JsonValue& value, WarningCollector& report) {
    const double intensity = value.number_or("intensity", 1.0);
    constexpr double largest = 1e30;
    if (intensity < 0.0 || intensity > largest)
        throw value.at("intensity")
            .error("is " + std::to_string(intensity) + ", expected 0 to 1e30");
    const std::array<double, 3> rgb = value.numbers_or<3>("color", {1.0, 1.0, 1.0});
    const glm::dvec3 colour(rgb[0], rgb[1], rgb[2]);
    const glm::dvec3 clamped = glm::clamp(colour, 0.0, 1.0);
    if (clamped != colour)
        report.count(value.place(), {"light", "lights"},
                     "the colour lies outside [0, 1] and is clamped");
    return glm::vec3(clamped * intensity);
}

}  // namespace

std::optional<PunctualLight> read_gltf_light(const JsonValue& root, const GltfNode& node,
                                             WarningCollector& report) {
    const std::optional<JsonValue> use = node.value.extension("KHR_lights_punctual");
    if (!use) return std::nullopt;
    const JsonValue reference = use->at("light");
    const std::optional<JsonValue> owner = root.extension("KHR_lights_punctual");
    const std::size_t count = owner ? owner->size_of("lights") : 0;
    const std::size_t index = reference.as_index(count, "lights");
    const JsonValue value = owner->at("lights").element(index);
    PunctualLight light;
    light.name = !node.name.empty() ? node.name : value.name_or("light " + std::to_string(index));
    const JsonValue type = value.at("type");
    if (type.as_string() == "point") {
        light.type = LightType::point;
    } else if (type.as_string() == "spot") {
        light.type = LightType::spot;
        read_cone(value, light);
    } else if (type.as_string() == "directional") {
        light.type = LightType::directional;
    } else {
        throw type.error("is " + quote(type.as_string()) + ", expected point, spot or directional");
    }
    light.intensity = read_intensity(value, report);
    light.position = glm::dvec3(node.to_world[3]);
    light.direction = -glm::normalize(glm::dvec3(node.to_world[2]));
    if (value.find("range"))
        report.count(value.place(), {"light", "lights"},
                     "range is not simulated, light fades with the square of the distance only");
    return light;
}

namespace {

double read_yfov(const JsonValue& perspective) {
    const JsonValue fov = perspective.at("yfov");
    const double angle = fov.as_number();
    if (angle <= 0.0 || angle >= std::numbers::pi)
        throw fov.error("is " + std::to_string(angle) + ", expected an angle above 0 and below pi");
    return angle;
}

double read_mag(const JsonValue& orthographic, const char* name) {
    const JsonValue value = orthographic.at(name);
    const double mag = std::abs(value.as_number());
    if (!(mag > 0.0 && mag <= limits::max_coordinate))
        throw value.error("is " + std::to_string(value.as_number()) +
                          ", expected half the extent of what is seen, above 0");
    return mag;
}

void read_orthographic(const JsonValue& orthographic, Camera& camera) {
    camera.half_extent = {read_mag(orthographic, "xmag"), read_mag(orthographic, "ymag")};
    const JsonValue near_plane = orthographic.at("znear");
    camera.near_plane = near_plane.as_number();
    if (!(camera.near_plane >= 0.0 && camera.near_plane <= limits::max_coordinate))
        throw near_plane.error("is " + std::to_string(camera.near_plane) +
                               ", expected a distance of at least 0");
}

}  // namespace

std::optional<Camera> read_gltf_camera(const JsonValue& root, const GltfNode& node,
                                       std::size_t number) {
    const std::optional<JsonValue> reference = node.value.find("camera");
    if (!reference) return std::nullopt;
    const std::size_t index = reference->as_index(root.size_of("cameras"), "cameras");
    const JsonValue value = root.at("cameras").element(index);
    const JsonValue type = value.at("type");
    Camera camera;
    if (type.as_string() == "orthographic")
        read_orthographic(value.at("orthographic"), camera);
    else if (type.as_string() == "perspective")
        camera.fov = read_yfov(value.at("perspective"));
    else
        throw type.error("is " + quote(type.as_string()) +
                         ", expected perspective or orthographic");
    camera.to_world = node.to_world;
    camera.name =
        !node.name.empty() ? node.name : value.name_or("camera " + std::to_string(number));
    return camera;
}

}  // namespace weft
