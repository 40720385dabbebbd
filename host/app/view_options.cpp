// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/view_options.h"

#include <limits>
#include <string>

#include "app/camera_options.h"
#include "app/command_line.h"
#include "app/device_options.h"
#include "app/frame_options.h"
#include "app/parse_values.h"
#include "base/limits.h"

namespace weft {

void add_view(CLI::App& app) {
    CLI::App& view = add_command(app, "view", "Shows a scene in a browser, to move through");
    add_scene(view);
    add_value(view, "--port", "N",
              "Port of this machine that serves the page (default: a free one)");
    add_value(view, "--socket", "PATH", "Unix socket that serves it instead, for ssh -L");
    add_value(view, "-o,--output", "FOLDER", "Where images are saved (default: nowhere)");
    add_value(view, "--algorithm", "NAME", "As of weft render (default: ais)");
    add_value(view, "--quality", "NAME", "draft, preview or high (default: preview)");
    add_device_choice(
        view,
        "opencl, embree, or native: as embree, but tracing with Weft's own BVH (default: opencl "
        "where there is a device, else embree)");
    add_value(view, "--threads", "N", "CPU threads (default: all)");
    add_value(view, "--size", "WxH", "Size of the image (default: the scene's, else 512x512)");
    add_camera(view);
    add_value(view, "--edits", "FILE",
              "Changes of objects, lights and materials that it begins with, from a JSON file");
    add_value(view, "--frame-rate", "R", "Frames per second of animations (default: 30)");
    add_reading(view);
    add_value(view, "--seed", "N", "Seed of all random numbers (default: 0)");
    add_value(view, "--exposure", "EV", "Exposure in stops (default: 0)");
    add_value(view, "--tone", "NAME", "Tone curve: none, filmic or agx (default: none)");
    add_verbose(view);
}

ViewOptions read_view(const CLI::App& command) {
    ViewOptions view;
    RenderOptions& image = view.image;
    image.scene = *value_of(command, "SCENE");
    image.backend = read_backend(command);
    image.device = read_device(command);
    image.reading = parse_reading(command);
    image.camera = value_of(command, "--camera");
    image.placement = read_placement(command);
    image.verbose = is_given(command, "--verbose");
    if (const auto text = value_of(command, "--algorithm"))
        image.algorithm = static_cast<Algorithm>(
            parse_name("--algorithm", short_algorithm_name(*text), algorithm_names));
    if (const auto text = value_of(command, "--quality"))
        image.quality = static_cast<Quality>(parse_name("--quality", *text, quality_names));
    if (const auto text = value_of(command, "--threads"))
        image.threads = parse_unsigned("--threads", *text, 1, limits::max_threads);
    if (const auto text = value_of(command, "--size")) image.size = parse_size("--size", *text);
    if (const auto text = value_of(command, "--seed"))
        image.seed = parse_unsigned("--seed", *text, 0, std::numeric_limits<std::uint32_t>::max());
    if (const auto text = value_of(command, "--exposure"))
        image.exposure_ev = parse_number("--exposure", *text, -max_exposure_ev, max_exposure_ev);
    if (const auto text = value_of(command, "--tone"))
        image.tone = static_cast<ToneCurve>(parse_name("--tone", *text, tone_names));
    if (const auto text = value_of(command, "--edits")) image.edits = *text;
    if (const auto text = value_of(command, "--frame-rate"))
        image.frame_rate = parse_frame_rate(*text);
    if (const auto text = value_of(command, "--port"))
        view.port = static_cast<std::uint16_t>(
            parse_unsigned("--port", *text, 1, std::numeric_limits<std::uint16_t>::max()));
    if (const auto text = value_of(command, "--socket")) view.socket = *text;
    if (view.port && view.socket)
        throw usage_error("--socket: serves the page instead of --port, expected one of them");
    if (const auto text = value_of(command, "--output")) view.folder = *text;
    return view;
}

}  // namespace weft
