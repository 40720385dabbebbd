// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/frame_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "app/command_line.h"
#include "app/options.h"
#include "app/parse_values.h"
#include "base/json_file.h"
#include "base/limits.h"

namespace weft {
namespace {

/// Whether some frame of the output `given` is written to `other`.
bool is_numbered_output(const std::filesystem::path& given, const std::filesystem::path& other) {
    const std::filesystem::path output = given.lexically_normal();
    const std::filesystem::path path = other.lexically_normal();
    const std::string name = path.filename().string();
    const std::string begin = output.stem().string() + ".";
    const std::string end = output.extension().string();
    if (path.parent_path() != output.parent_path() || name.size() <= begin.size() + end.size() ||
        !name.starts_with(begin) || !name.ends_with(end))
        return false;
    const std::string number = name.substr(begin.size(), name.size() - begin.size() - end.size());
    return number.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

void add_frames(CLI::App& render) {
    add_value(render, "--frames", "A:B",
              "Frames A to B - 1 of the scene's animation, each an image of its own");
    add_value(render, "--frame", "N", "Instead: one image, of frame N of that animation");
    add_value(render, "--frame-rate", "R",
              "Frames per second of --frames and --frame (default: 30)");
    add_value(render, "--edits", "FILE",
              "Changes of objects, lights and materials over the frames, from a JSON file");
}

double parse_frame_rate(const std::string& text) {
    constexpr double least_rate = 1e-6;
    constexpr double most_rate = 1000.0;
    return parse_number("--frame-rate", text, least_rate, most_rate);
}

void read_frames(const CLI::App& command, RenderOptions& options) {
    if (const auto text = value_of(command, "--frames"))
        options.frames = parse_frames("--frames", *text);
    if (const auto text = value_of(command, "--frame")) {
        options.frame = parse_unsigned("--frame", *text, 0, limits::max_frames - 1);
        if (options.frames)
            throw usage_error(
                "--frame: is one image instead of those of --frames, expected one of them");
    }
    const auto check_animated = [&](const char* name) {
        if (!options.chosen_frames())
            throw usage_error(std::string(name) +
                              ": is for animations, expected it together with --frames or --frame");
    };
    if (const auto text = value_of(command, "--frame-rate")) {
        options.frame_rate = parse_frame_rate(*text);
        check_animated("--frame-rate");
    }
    if (const auto text = value_of(command, "--edits")) {
        options.edits = *text;
        check_animated("--edits");
    }
    if (!options.frames) return;
    for (const char* const name : {"--samples", "--part", "--resume"})
        if (value_of(command, name))
            throw usage_error(std::string(name) +
                              ": is for a single image, expected it without --frames");
    if (options.stats && is_numbered_output(options.output, *options.stats))
        throw usage_error("--stats: names the same file as one of the images of --frames");
}

GivenEdits given_edits(const std::filesystem::path& given) {
    const std::string& text = given.native();
    if (!text.starts_with('{'))
        return {read_json_file(given, limits::max_text_file_bytes), given.string()};
    return {read_json_text(text, "--edits"), "--edits"};
}

EditTimeline read_edits(const std::filesystem::path& given, Scene& scene) {
    const GivenEdits edits = given_edits(given);
    return read_scene_edits(edits.json, edits.place, scene);
}

std::filesystem::path numbered_output(const std::filesystem::path& output, std::uint32_t frame) {
    std::filesystem::path path = output;
    return path.replace_filename(
        fmt::format("{}.{:04}{}", output.stem().string(), frame, output.extension().string()));
}

}  // namespace weft
