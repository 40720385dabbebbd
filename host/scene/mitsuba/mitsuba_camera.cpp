// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft::mitsuba {

namespace {

FovAxis read_fov_axis(Object& object) {
    static constexpr std::array<std::pair<const char*, FovAxis>, 5> names = {{
        {"x", FovAxis::x},
        {"y", FovAxis::y},
        {"diagonal", FovAxis::diagonal},
        {"smaller", FovAxis::smaller},
        {"larger", FovAxis::larger},
    }};
    const std::string text = object.text("fov_axis").value_or("x");
    for (const auto& [name, axis] : names) {
        if (text == name) return axis;
    }
    throw input_error(object.place(),
                      "fov_axis " + quote(text) + ", expected x, y, diagonal, smaller or larger");
}

/// `50mm`: the angle that the diagonal of 35 mm film covers.
double fov_of_focal_length(Object& object, std::string text) {
    if (text.size() > 2 && text.compare(text.size() - 2, 2, "mm") == 0)
        text.resize(text.size() - 2);
    const double millimetres = parse_number(object.element(), text);
    if (!(millimetres > 0.0))
        throw input_error(object.place(), "focal_length not above 0, expected millimetres");
    return 2.0 * std::atan(std::hypot(36.0, 24.0) / (2.0 * millimetres));
}

void read_fov(Object& object, Camera& camera) {
    const std::optional<std::string> focal_length = object.text("focal_length");
    camera.fov_axis = read_fov_axis(object);
    if (object.find("fov") == nullptr) {
        camera.fov = fov_of_focal_length(object, focal_length.value_or("50mm"));
        camera.fov_axis = FovAxis::diagonal;
        return;
    }
    if (focal_length)
        throw input_error(object.place(), "both fov and focal_length, expected one of them");
    const double degrees = object.number("fov", 0.0);
    if (!(degrees > 0.0 && degrees < 180.0))
        throw input_error(object.place(),
                          fmt::format("fov of {} degrees, expected 0 to 180", degrees));
    camera.fov = glm::radians(degrees);
}

/// Mitsuba's camera looks along +z and has +x on the left of the image, Weft's looks along -z
/// and has +x on the right: half a turn about y. Returns by how much the transform scales each
/// axis.
glm::dvec3 read_pose(Object& object, Camera& camera) {
    const glm::dmat4 file = object.transform("to_world");
    glm::dmat3 axes(file);
    glm::dvec3 scale(1.0);
    for (int i = 0; i < 3; ++i) {
        const double length = glm::length(axes[i]);
        scale[i] = length;
        if (!(length > 0.0) || !std::isfinite(length))
            throw input_error(object.place(),
                              "camera to_world cannot be inverted, expected a "
                              "rotation and a translation");
        axes[i] /= length;
    }
    constexpr double tolerance = 1e-4;
    if (std::abs(glm::dot(axes[0], axes[1])) > tolerance ||
        std::abs(glm::dot(axes[1], axes[2])) > tolerance ||
        std::abs(glm::dot(axes[2], axes[0])) > tolerance)
        throw input_error(object.place(),
                          "camera to_world shears, expected a rotation and a translation");
    if (glm::any(
            glm::greaterThan(glm::abs(glm::dvec3(file[3])), glm::dvec3(limits::max_coordinate))))
        throw input_error(object.place(), "camera too far out, expected coordinates below 1e15");
    camera.mirror_x = glm::determinant(axes) < 0.0;
    const glm::dvec3 right = camera.mirror_x ? axes[0] : -axes[0];
    camera.to_world = glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(axes[1], 0.0),
                                 glm::dvec4(-axes[2], 0.0), file[3]);
    return scale;
}

/// Mitsuba's orthographic camera shows [-1, 1] of its own x axis, and as much of y as the image is
/// high; its transform scales that.
void read_extent(Object& object, const glm::dvec3& scale, Context& context, const Element& sensor,
                 Camera& camera) {
    constexpr double default_near = 0.01;
    constexpr double tolerance = 1e-4;
    if (std::abs(scale.x - scale.y) > tolerance * scale.x)
        context.warnings.once(sensor,
                              "to_world scales x and y of the sensor differently: the scale of x "
                              "is used for both");
    camera.half_extent = {scale.x, 0.0};
    camera.near_plane = object.number("near_clip", default_near) * scale.z;
    if (!(camera.near_plane >= 0.0))
        throw input_error(object.place(), "near_clip below 0, expected a distance");
}

std::uint32_t read_edge(Object& film, const char* name, long missing) {
    const long edge = film.integer(name).value_or(missing);
    if (edge < 1 || edge > static_cast<long>(limits::max_film_edge))
        throw input_error(film.place(), fmt::format("film {} of {} pixels, expected 1 to {}", name,
                                                    edge, limits::max_film_edge));
    return static_cast<std::uint32_t>(edge);
}

FilmSize read_film(Object& sensor, Context& context) {
    const std::vector<const Element*> films = sensor.nested("film");
    if (films.size() > 1)
        throw input_error(films[1]->place(), "a second film in a sensor, expected one");
    if (films.empty()) return {768, 576};
    Object film(*films.front(), context);
    const FilmSize size{read_edge(film, "width", 768), read_edge(film, "height", 576)};
    if (std::size_t{size.width} * size.height > limits::max_film_pixels)
        throw input_error(film.place(),
                          fmt::format("film of {} x {} pixels, expected at most {}", size.width,
                                      size.height, limits::max_film_pixels));
    film.ignore({"file_format", "pixel_format", "component_format", "compensate", "sample_border",
                 "banner"});
    (void)film.nested("rfilter");
    film.report_unused();
    return size;
}

/// Media are attached by reference, with or without a name.
int read_medium(Object& object, MediumReader& media) {
    const Element* medium = object.find("medium");
    const std::vector<const Element*> unnamed = object.nested("medium");
    if (medium == nullptr && !unnamed.empty()) medium = unnamed.front();
    return media.index(medium);
}

}  // namespace

void read_camera(const Element& sensor, Context& context, MediumReader& media, Scene& scene) {
    Object object(sensor, context);
    const bool orthographic = object.type() == "orthographic";
    if (!orthographic && object.type() != "perspective" && object.type() != "thinlens") {
        context.warnings.count(sensor, {"sensor", "sensors"},
                               "type " + quote(object.type()) + " is not supported, left out");
        return;
    }
    Camera camera;
    camera.name = object.id_or(fmt::format("camera{}", scene.cameras.size()));
    const glm::dvec3 scale = read_pose(object, camera);
    if (orthographic)
        read_extent(object, scale, context, sensor, camera);
    else
        read_fov(object, camera);
    const FilmSize film = read_film(object, context);
    const int medium = read_medium(object, media);
    (void)object.nested("sampler");
    object.ignore({"near_clip", "far_clip", "shutter_open", "shutter_close"});
    if (object.type() == "thinlens") {
        context.warnings.count(sensor, {"sensor", "sensors"},
                               "depth of field is not supported, everything is sharp");
        object.ignore({"aperture_radius", "focus_distance"});
    }
    object.report_unused();
    if (scene.cameras.empty()) {
        scene.film = film;
        scene.camera_medium = medium;
    } else if (film.width != scene.film->width || film.height != scene.film->height ||
               medium != scene.camera_medium) {
        context.warnings.count(sensor, {"sensor", "sensors"},
                               "film size and medium differ, those of the first are used");
    }
    scene.cameras.push_back(std::move(camera));
}

}  // namespace weft::mitsuba
