// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a scene as Weft renders it in a form that any other renderer can be given: triangles in
// world space by material, lights and camera. docs/benchmarks.md describes the files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "bench/common/bench_main.h"
#include "bench/export_scene/exported_scene.h"
#include "render/camera_params.h"
#include "scene/load/load_scene.h"

namespace {

using namespace weft;
using namespace weft::bench;

struct Settings {
    std::string scene;
    std::string folder;
    std::string camera;
    std::vector<std::uint32_t> size{512, 512};
    SceneReading reading;
};

void add_options(CLI::App& app, Settings& settings) {
    app.add_option("SCENE", settings.scene, "a scene that weft render reads")->required();
    app.add_option("-o,--output", settings.folder, "folder to write, made where it is not there")
        ->required();
    app.add_option("--camera", settings.camera, "camera of the scene; default: its first");
    app.add_option("--size", settings.size, "width and height of images; default: 512 512")
        ->expected(2)
        ->check(CLI::Range(1U, limits::max_film_edge));
    app.add_option("--environment", settings.reading.environment,
                   "an image of the environment, as of weft render");
}

void run(const Settings& settings) {
    Diagnostics diagnostics;
    const Scene scene = load_scene(settings.scene, diagnostics, settings.reading);
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, settings.camera, diagnostics);
    if (camera.orthographic())
        throw input_error(settings.scene,
                          "has an orthographic camera, expected a perspective one, "
                          "which other renderers are given");
    for (const std::string& warning : diagnostics.warnings()) fmt::print(stderr, "{}\n", warning);
    write_exported_scene(settings.folder, scene, flat, camera,
                         {settings.size[0], settings.size[1]});
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("export_scene", [&] {
        Settings settings;
        CLI::App app{"Writes a scene in a form that other renderers can be given"};
        add_options(app, settings);
        if (const auto code = parse_arguments(app, argc, argv)) return *code;
        run(settings);
        return 0;
    });
}
