// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The same frames on every backend, kernel by kernel, in one run: what portability costs on the
// machine at hand. docs/benchmarks.md says how to read it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "bench/common/bench_main.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/kernels/copy_speed.h"
#include "bench/kernels/kernel_report.h"
#include "device/native/native_executor.h"
#include "render/camera_params.h"
#include "scene/flat_scene.h"
#include "scene/load/load_scene.h"

namespace {

using namespace weft;
using namespace weft::bench;
namespace fs = std::filesystem;

const std::vector<MeteredMethod> all_methods{{"ais", Algorithm::ais}, {"amax", Algorithm::amax},
                                             {"igi", Algorithm::igi}, {"ir", Algorithm::ir},
                                             {"ic", Algorithm::ic},   {"path", Algorithm::path}};

/// In the order of the tables: ratios are to the first that is there.
const std::vector<std::string> all_backends{"native", "opencl", "embree"};

struct Settings {
    bool quick = false;
    std::string scenes = WEFT_SOURCE_DIR "/scenes";
    std::string json;
    std::string device;
    int threads = 0;
    std::uint32_t size = 0;         ///< 0: by `quick`
    std::uint32_t repetitions = 0;  ///< 0: by `quick`
    std::vector<std::string> only;
    std::vector<std::string> methods;
    std::vector<std::string> backends;

    [[nodiscard]] static bool among(const std::vector<std::string>& names,
                                    const std::string& name) {
        return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
    }
    [[nodiscard]] MeteredRun run() const {
        MeteredRun run;
        run.size = size > 0 ? size : quick ? 96 : 512;
        run.repetitions = repetitions > 0 ? repetitions : quick ? 3 : 9;
        run.path_samples = quick ? 2 : 4;
        return run;
    }
    [[nodiscard]] std::vector<MeteredMethod> wanted_methods() const {
        std::vector<MeteredMethod> wanted;
        for (const MeteredMethod& method : all_methods)
            if (among(methods, method.name)) wanted.push_back(method);
        return wanted;
    }
};

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const MeteredMethod& method : all_methods) names.push_back(method.name);
    return names;
}

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app{"The same frames on OpenCL, on native kernels and with Embree, kernel by kernel"};
    app.add_flag("--quick", settings.quick, "a small image and few repetitions");
    app.add_option("--scenes", settings.scenes, "folder of the scene files");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--threads", settings.threads, "threads of every backend; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--only", settings.only, "measure only the scenes of these file names");
    app.add_option("--methods", settings.methods, "measure only these algorithms")
        ->check(CLI::IsMember(method_names()));
    app.add_option("--backends", settings.backends, "measure only these backends")
        ->check(CLI::IsMember(all_backends));
    app.add_option("--size", settings.size, "width and height of the image")
        ->check(CLI::Range(16, 4096));
    app.add_option("--repetitions", settings.repetitions, "timed frames of every algorithm")
        ->check(CLI::Range(1, 1000));
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return std::nullopt;
    }
    return settings;
}

/// The scene files that are there: a small one, a large one, one with media; or those named.
std::vector<fs::path> wanted_scenes(const Settings& settings) {
    const fs::path folder = settings.scenes;
    std::vector<std::string> names = settings.only;
    if (names.empty()) {
        const bool conference = fs::is_regular_file(folder / "conference.gltf");
        names = {"cornell-box.gltf", conference ? "conference.gltf" : "gallery.gltf",
                 "cornell-box-fog.gltf"};
    }
    std::vector<fs::path> files;
    for (const std::string& name : names)
        if (fs::is_regular_file(folder / name)) files.push_back(folder / name);
    if (files.empty())
        throw Error(ExitCode::usage,
                    fmt::format("{} holds none of the scenes, expected such as cornell-box.gltf",
                                folder.string()));
    return files;
}

/// The executors of a run.
struct Backends {
    std::vector<std::unique_ptr<Executor>> executors;
    std::vector<MeteredBackend> metered;
};

Backends open_backends(const Settings& settings) {
    Backends backends;
    for (const std::string& name : all_backends) {
        if (!Settings::among(settings.backends, name)) continue;
        auto executor = name == "opencl" ? open_opencl(settings.device, settings.threads)
                                         : open_backend(name, "", settings.threads);
        if (!executor) {
            print("No OpenCL device was found: the backend opencl is left out.\n");
            continue;
        }
        backends.metered.push_back({name, *executor});
        backends.executors.push_back(std::move(executor));
    }
    if (backends.metered.empty())
        throw Error(ExitCode::device, "no backend is left, expected an OpenCL device or another");
    return backends;
}

nlohmann::json scene_json(const Settings& settings, const fs::path& file, const Backends& backends,
                          Diagnostics& diagnostics) {
    const Scene scene = load_scene(file, diagnostics);
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, "", diagnostics);
    return kernel_json(meter_scene(file.filename().string(), flat, camera, backends.metered,
                                   settings.wanted_methods(), settings.run()));
}

void run(const Settings& settings) {
    const auto limit = limit_threads(settings.threads);
    const Backends backends = open_backends(settings);
    const MeteredRun frames = settings.run();
    nlohmann::json json{{"benchmark", "kernels"},
                        {"quick", settings.quick},
                        {"size", frames.size},
                        {"repetitions", frames.repetitions},
                        {"warm_up", frames.warm_up},
                        {"path_samples", frames.path_samples},
                        {"machine", machine_json(settings.threads)},
                        {"versions", versions_json()},
                        {"scenes", nlohmann::json::array()}};
    print(kernel_legend());
    Diagnostics diagnostics;
    for (const fs::path& file : wanted_scenes(settings)) {
        json["scenes"].push_back(scene_json(settings, file, backends, diagnostics));
        print(kernel_tables(json["scenes"].back()));
    }
    for (const MeteredBackend& backend : backends.metered) {
        const double speed = copy_speed(backend.executor.device());
        print(fmt::format("{}: copies move {:.1f} GB/s\n", backend.name, speed * 1e-9));
        nlohmann::json device = device_json(backend.executor);
        device["copy_bytes_per_second"] = speed;
        device["label"] = backend.name;
        device["builds"] = builds_json(backend.executor);
        json["devices"].push_back(device);
    }
    json["summary"] = kernel_summary(json["scenes"]);
    print("\n" + json["summary"].dump(2) + "\n");
    if (!settings.json.empty()) write_json(settings.json, json);
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("kernels", [&] {
        int status = 0;
        const auto settings = parse(argc, argv, status);
        if (settings) run(*settings);
        return status;
    });
}
