// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_message.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "base/error.h"
#include "base/json_file.h"
#include "base/json_text.h"
#include "base/json_value.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

constexpr const char* place = "message#";
constexpr double max_exposure_ev = 100.0;
constexpr double least_fov = 1e-3;
constexpr double most_fov = 179.0;

/// The message as JSON.
nlohmann::json parsed(std::string_view text) {
    if (text.size() > max_view_message_bytes)
        throw input_error(place, fmt::format("has {} bytes, expected at most {}", text.size(),
                                             max_view_message_bytes));
    nlohmann::json json = read_json_text(text, place);
    if (!json.is_object()) throw input_error(place, "is not valid, expected a JSON object");
    return json;
}

double number(const JsonValue& value, double least, double most) {
    const double found = value.as_number();
    if (!(found >= least && found <= most))
        throw value.error(fmt::format("is {}, expected {} to {}", found, least, most));
    return found;
}

std::uint32_t whole(const JsonValue& value, std::uint32_t most) {
    const std::uint64_t found = value.as_integer();
    if (found > most) throw value.error(fmt::format("is {}, expected at most {}", found, most));
    return static_cast<std::uint32_t>(found);
}

std::uint32_t whole(const JsonValue& value) {
    return whole(value, std::numeric_limits<std::uint32_t>::max());
}

glm::dvec3 vector(const JsonValue& value) {
    if (value.size() != 3) throw value.error("has another length, expected three numbers");
    glm::dvec3 v(0.0);
    for (int axis = 0; axis < 3; ++axis)
        v[axis] = number(value.element(static_cast<std::size_t>(axis)), -limits::max_coordinate,
                         limits::max_coordinate);
    return v;
}

template <typename Enumeration>
Enumeration named(const JsonValue& value, std::span<const std::string_view> names) {
    const std::string& text = value.as_string();
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == text) return static_cast<Enumeration>(i);
    throw value.error("is " + quote(text) + ", which is none of the known names");
}

FilmSize size_of(const JsonValue& value) {
    if (value.size() != 2) throw value.error("has another length, expected width and height");
    const FilmSize size{whole(value.element(0), limits::max_film_edge),
                        whole(value.element(1), limits::max_film_edge)};
    if (size.width == 0 || size.height == 0 ||
        std::size_t{size.width} * size.height > limits::max_film_pixels)
        throw value.error("is no size of an image");
    return size;
}

ViewCamera camera_of(const JsonValue& message, const JsonValue& value) {
    ViewCamera camera;
    camera.view = {vector(value.at("from")), vector(value.at("at")), vector(value.at("up"))};
    camera.fov = number(value.at("fov"), least_fov, most_fov);
    if (!can_point(camera.view)) throw value.error("is no view: no camera can point that way");
    camera.moving = message.bool_or("moving", false);
    camera.state = whole(message.at("state"));
    return camera;
}

ViewComparison comparison_of(const JsonValue& value) {
    constexpr double least_seconds = 0.01;
    constexpr double most_seconds = 3600.0;
    return {named<Algorithm>(value.at("algorithm"), algorithm_names),
            named<Quality>(value.at("quality"), quality_names),
            number(value.at("seconds"), least_seconds, most_seconds)};
}

ViewSettings settings_of(const JsonValue& message, const JsonValue& value,
                         const nlohmann::json& json) {
    ViewSettings settings;
    if (const auto member = value.find("algorithm"))
        settings.algorithm = named<Algorithm>(*member, algorithm_names);
    if (const auto member = value.find("quality"))
        settings.quality = named<Quality>(*member, quality_names);
    if (const auto member = value.find("size")) settings.size = size_of(*member);
    if (const auto member = value.find("exposure"))
        settings.exposure_ev = number(*member, -max_exposure_ev, max_exposure_ev);
    if (const auto member = value.find("tone"))
        settings.tone = named<ToneCurve>(*member, tone_names);
    if (const auto member = value.find("paused")) settings.paused = member->as_bool();
    if (const auto member = value.find("camera")) settings.camera = member->as_string();
    if (const auto member = value.find("frame"))
        settings.frame = whole(*member, limits::max_frames - 1);
    if (const auto member = value.find("samples"))
        settings.samples = whole(*member, limits::max_samples_per_pixel);
    if (const auto member = value.find("overlay")) settings.overlay = member->as_string();
    if (const auto member = value.find("compare"))
        settings.compare =
            json.at("compare").is_null() ? std::nullopt : std::optional(comparison_of(*member));
    if (const auto member = value.find("trust")) settings.trust = member->as_bool();
    settings.moving = message.bool_or("moving", false);
    settings.state = whole(message.at("state"));
    return settings;
}

ViewPick pick_of(const JsonValue& value) {
    if (value.size() != 2) throw value.error("has another length, expected two numbers");
    return {whole(value.element(0)), whole(value.element(1))};
}

ViewEdit edit_of(const JsonValue& message, const nlohmann::json& json) {
    if (!json.at("edit").is_object())
        throw message.at("edit").error("is no object, expected an edit");
    return {json_line(json.at("edit")), message.bool_or("continues", false),
            message.bool_or("moving", false), whole(message.at("state"))};
}

ViewUndo undo_of(const JsonValue& message, const JsonValue& value) {
    const std::string& text = value.as_string();
    if (text != "last" && text != "all")
        throw value.error("is " + quote(text) + ", expected last or all");
    return {text == "all", whole(message.at("state"))};
}

}  // namespace

ViewMessage read_view_message(std::string_view text) {
    const nlohmann::json json = parsed(text);
    const JsonValue message(json, place);
    if (const auto value = message.find("camera")) return camera_of(message, *value);
    if (const auto value = message.find("ack")) return ViewAck{whole(*value)};
    if (const auto value = message.find("set")) return settings_of(message, *value, json.at("set"));
    if (const auto value = message.find("pick")) return pick_of(*value);
    if (message.find("edit")) return edit_of(message, json);
    if (const auto value = message.find("undo")) return undo_of(message, *value);
    if (const auto value = message.find("measure")) return ViewMeasure{value->as_bool()};
    if (const auto value = message.find("adopt")) return ViewAdopt{whole(*value)};
    if (const auto value = message.find("save"))
        return ViewSave{named<SavedFile>(*value, saved_file_names)};
    if (const auto value = message.find("token")) return ViewKey{value->as_string()};
    throw message.error("is of no known kind");
}

std::uint32_t state_of(const ViewMessage& message) {
    return std::visit(
        [](const auto& asked) -> std::uint32_t {
            if constexpr (requires { asked.state; }) return asked.state;
            return 0;
        },
        message);
}

}  // namespace weft
