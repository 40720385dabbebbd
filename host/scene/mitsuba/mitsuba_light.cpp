// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_light.h"

#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/texture/environment_file.h"

namespace weft::mitsuba {

namespace {

/// Mitsuba's emitters shine along +z of their own space.
glm::dvec3 direction_of(Object& object, const glm::dmat4& to_world, const glm::dvec3& local) {
    const glm::dvec3 direction = glm::dmat3(to_world) * local;
    const double length = glm::length(direction);
    if (!(length > 0.0) || !std::isfinite(length))
        throw input_error(object.place(),
                          "emitter without a direction, expected a vector of "
                          "finite length above 0");
    return direction / length;
}

glm::dvec3 position_of(Object& object, const glm::dmat4& to_world) {
    const glm::dvec3 position(to_world[3]);
    if (glm::any(glm::greaterThan(glm::abs(position), glm::dvec3(limits::max_coordinate))))
        throw input_error(object.place(), "position too far out, expected coordinates below 1e15");
    return position;
}

PunctualLight read_point(Object& object) {
    PunctualLight light;
    light.type = LightType::point;
    light.intensity = object.colour("intensity", ColourUse::emission, glm::vec3(1.0F));
    glm::dmat4 to_world = object.transform("to_world");
    if (const std::optional<glm::dvec3> position = object.vector("position"))
        to_world[3] = glm::dvec4(*position, 1.0);
    light.position = position_of(object, to_world);
    return light;
}

PunctualLight read_spot(Object& object) {
    PunctualLight light;
    light.type = LightType::spot;
    light.intensity = object.colour("intensity", ColourUse::emission, glm::vec3(1.0F));
    const double cutoff = object.number("cutoff_angle", 20.0);
    const double beam = object.number("beam_width", 0.75 * cutoff);
    if (!(cutoff > 0.0 && cutoff <= 180.0 && beam >= 0.0 && beam <= cutoff))
        throw input_error(object.place(),
                          "bad spot angles, expected 0 <= beam_width <= "
                          "cutoff_angle <= 180");
    light.cos_inner = static_cast<float>(std::cos(glm::radians(beam)));
    light.cos_outer = static_cast<float>(std::cos(glm::radians(cutoff)));
    light.linear_edge = true;
    const glm::dmat4 to_world = object.transform("to_world");
    light.position = position_of(object, to_world);
    light.direction = direction_of(object, to_world, {0.0, 0.0, 1.0});
    return light;
}

PunctualLight read_directional(Object& object) {
    PunctualLight light;
    light.type = LightType::directional;
    light.intensity = object.colour("irradiance", ColourUse::emission, glm::vec3(1.0F));
    const glm::dmat4 to_world = object.transform("to_world");
    const std::optional<glm::dvec3> direction = object.vector("direction");
    light.direction = direction ? direction_of(object, glm::dmat4(1.0), *direction)
                                : direction_of(object, to_world, {0.0, 0.0, 1.0});
    return light;
}

void set_environment(const Object& object, Environment environment, Context& context,
                     Scene& scene) {
    if (scene.environment)
        context.warnings.count(object.element(), {"environment light", "environment lights"},
                               "not the first, left out");
    else
        scene.environment = std::move(environment);
}

/// The rotation that to_world is, which may also mirror and scale evenly.
glm::dmat3 rotation_of(Object& object) {
    const glm::dmat3 to_world(object.transform("to_world"));
    const double scale = std::cbrt(std::abs(glm::determinant(to_world)));
    const glm::dmat3 turn = to_world / scale;
    const glm::dmat3 square = glm::transpose(turn) * turn;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(square[i][j] - (i == j ? 1.0 : 0.0)) < 1e-4))
                throw input_error(object.place(),
                                  "envmap that to_world distorts, expected a rotation");
    // Free of what is left of the file's rounding.
    const glm::dvec3 x = glm::normalize(turn[0]);
    const glm::dvec3 y = glm::normalize(turn[1] - glm::dot(turn[1], x) * x);
    const glm::dvec3 z = glm::cross(x, y);
    return {x, y, glm::dot(z, turn[2]) < 0.0 ? -z : z};
}

/// Mitsuba's u is atan2(x, -z) / 2 pi: its x axis is the -z, and its z axis the x, of the image.
Environment read_envmap(Object& object, Context& context) {
    EnvironmentFile file = read_environment(object.file());
    if (file.mended > 0)
        context.warnings.count(object.element(), {"image", "images"},
                               "with values that are negative or not finite, taken as 0 or 65504");
    file.image->rows_at_poles = true;
    const double scale = object.number("scale", 1.0);
    if (!(scale >= 0.0) || !std::isfinite(static_cast<float>(scale)))
        throw input_error(object.place(), "bad scale of an envmap, expected 0 or more");
    const glm::dmat3 turned{{0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}};
    return {glm::vec3(static_cast<float>(scale)), file.image, rotation_of(object) * turned};
}

}  // namespace

void read_light(const Element& emitter, Context& context, Scene& scene) {
    Object object(emitter, context);
    const std::string& type = object.type();
    object.ignore({"sampling_weight"});
    std::optional<PunctualLight> light;
    if (type == "point") {
        light = read_point(object);
    } else if (type == "spot") {
        light = read_spot(object);
    } else if (type == "directional") {
        light = read_directional(object);
    } else if (type == "constant") {
        set_environment(
            object, Environment{object.colour("radiance", ColourUse::emission, glm::vec3(1.0F))},
            context, scene);
        object.ignore({"to_world"});
    } else if (type == "envmap") {
        set_environment(object, read_envmap(object, context), context, scene);
        object.ignore({"mis_compensation"});
    } else {
        context.warnings.count(emitter, {"emitter", "emitters"},
                               "type " + quote(type) + " is not supported, left out");
        return;
    }
    object.report_unused();
    if (!light) return;
    light->name = object.id_or(type);
    scene.lights.push_back(std::move(*light));
}

}  // namespace weft::mitsuba
