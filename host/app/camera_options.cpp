// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/camera_options.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "app/command_line.h"
#include "app/parse_values.h"
#include "base/error.h"

namespace weft {
namespace {

constexpr const char* from_option = "--look-from";
constexpr const char* at_option = "--look-at";
constexpr const char* up_option = "--up";
constexpr const char* fov_option = "--fov";

std::string text_of(const glm::dvec3& v) {
    return fmt::format("{},{},{}", v.x, v.y, v.z);
}

nlohmann::json json_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

}  // namespace

void add_camera(CLI::App& command) {
    add_value(command, "--camera", "NAME", "Camera of the scene (default: its first)");
    add_value(command, from_option, "X,Y,Z",
              "Where the camera stands instead, in scene units, with --look-at");
    add_value(command, at_option, "X,Y,Z", "What it points at");
    add_value(command, up_option, "X,Y,Z", "What is upwards in its image (default: 0,1,0)");
    add_value(command, fov_option, "DEGREES", "Its field of view (default: that of the camera)");
}

CameraPlacement read_placement(const CLI::App& command) {
    constexpr double least_degrees = 1e-3;
    constexpr double most_degrees = 179.0;
    const auto from = value_of(command, from_option);
    const auto at = value_of(command, at_option);
    const auto up = value_of(command, up_option);
    CameraPlacement placement;
    if (from.has_value() != at.has_value())
        throw usage_error(fmt::format("{0}: says only half of a view, expected {1} with it",
                                      from ? from_option : at_option,
                                      from ? at_option : from_option));
    if (up && !from)
        throw usage_error(
            fmt::format("{}: is for a camera that is placed, expected {} and {} with "
                        "it",
                        up_option, from_option, at_option));
    if (from) {
        CameraView view{parse_vector(from_option, *from), parse_vector(at_option, *at)};
        if (up) view.up = parse_vector(up_option, *up);
        if (!can_point(view))
            throw usage_error(
                view.from == view.at
                    ? fmt::format("{}: is where the camera stands, expected another point than {}",
                                  at_option, from_option)
                    : fmt::format("{}: is along the view from {} to {}, or 0, expected another "
                                  "direction",
                                  up_option, from_option, at_option));
        placement.view = view;
    }
    if (const auto text = value_of(command, fov_option))
        placement.fov = parse_number(fov_option, *text, least_degrees, most_degrees);
    return placement;
}

std::vector<std::string> placement_arguments(const CameraPlacement& placement) {
    std::vector<std::string> arguments;
    if (placement.view) {
        arguments.insert(arguments.end(), {from_option, text_of(placement.view->from), at_option,
                                           text_of(placement.view->at)});
        if (placement.view->up != CameraView{}.up)
            arguments.insert(arguments.end(), {up_option, text_of(placement.view->up)});
    }
    if (placement.fov)
        arguments.insert(arguments.end(), {fov_option, fmt::format("{}", *placement.fov)});
    return arguments;
}

void add_placement_json(const CameraPlacement& placement, nlohmann::json& json) {
    const bool views = placement.view.has_value();
    json["look_from"] = views ? json_of(placement.view->from) : nlohmann::json();
    json["look_at"] = views ? json_of(placement.view->at) : nlohmann::json();
    json["up"] = views ? json_of(placement.view->up) : nlohmann::json();
    json["fov"] = placement.fov ? nlohmann::json(*placement.fov) : nlohmann::json();
}

}  // namespace weft
