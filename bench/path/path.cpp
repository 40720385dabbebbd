// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The path tracer on each backend next to Mitsuba 3, on the same scene files in one run.
// docs/benchmarks.md says how to read it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "bench/common/bench_main.h"
#include "bench/common/bench_scenes.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/path/path_candidates.h"
#include "bench/path/path_report.h"
#include "device/native/native_executor.h"
#include "render/camera_params.h"
#include "scene/flat_scene.h"

namespace {

using namespace weft;
using namespace weft::bench;

struct Settings {
    bool quick = false;
    std::string scenes = WEFT_SOURCE_DIR "/../shared/data/scenes";
    std::string json;
    std::string device;
    int threads = 0;
    std::string python;
    std::uint32_t spp = 0;          ///< 0: by `quick`
    std::uint32_t size = 0;         ///< 0: by `quick`
    std::uint32_t repetitions = 0;  ///< 0: by `quick`
    std::vector<std::string> only;

    [[nodiscard]] bool wants(const BenchScene& scene) const {
        return only.empty() || std::find(only.begin(), only.end(), scene.name) != only.end();
    }
    [[nodiscard]] std::uint32_t runs() const {
        return repetitions > 0 ? repetitions : quick ? 3 : 5;
    }
    [[nodiscard]] PathSettings image() const {
        PathSettings settings;
        settings.width = settings.height = size > 0 ? size : quick ? 128 : 256;
        settings.samples.end = spp > 0 ? spp : quick ? 8 : 16;
        return settings;
    }
    [[nodiscard]] MitsubaSettings mitsuba() const {
        const char* chosen = std::getenv("WEFT_BENCH_PYTHON");
        if (chosen == nullptr) chosen = std::getenv("WEFT_WITNESS_PYTHON");  // its old name
        const std::string usual = chosen != nullptr && *chosen != '\0' ? chosen : "python3";
        return {python.empty() ? usual : python,
                WEFT_SOURCE_DIR "/bench/cross_validation/mitsuba_speed.py", threads};
    }
};

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app{"Weft's path tracer against Mitsuba 3, in million samples per second"};
    app.add_flag("--quick", settings.quick, "a smaller image, fewer samples and runs");
    app.add_option("--scenes", settings.scenes, "folder of scenes, each DIR/NAME/NAME.xml");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--threads", settings.threads, "threads of every candidate; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--only", settings.only, "measure only the scenes of these names");
    app.add_option("--python", settings.python,
                   "Python that has mitsuba; default: $WEFT_BENCH_PYTHON, else python3");
    app.add_option("--spp", settings.spp, "samples per pixel")
        ->check(CLI::Range(1U, limits::max_samples_per_pixel));
    app.add_option("--size", settings.size, "width and height of the image")
        ->check(CLI::Range(1, 4096));
    app.add_option("--repetitions", settings.repetitions, "timed runs of every candidate")
        ->check(CLI::Range(3, 1000));
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return std::nullopt;
    }
    return settings;
}

/// Weft's backends; OpenCL is null where there is none.
struct Backends {
    std::unique_ptr<Executor> opencl;
    std::unique_ptr<Executor> native;
    std::unique_ptr<Executor> embree;
};

/// Scene files, or generated scenes where there are none.
std::vector<BenchScene> wanted_scenes(const Settings& settings) {
    std::vector<BenchScene> scenes = bench_scenes(
        settings.scenes, {"cornell-box", "sibenik", "conference", "office", "desk"}, true);
    const bool files = !scenes.front().file.empty();
    std::erase_if(scenes, [&](const BenchScene& scene) {
        return !settings.wants(scene) || (files && scene.file.empty());
    });
    if (scenes.empty()) throw Error(ExitCode::usage, "--only names no scene that is there");
    return scenes;
}

PathResult run_scene(const Settings& settings, const BenchScene& source, const Backends& backends,
                     std::string& version, Diagnostics& diagnostics) {
    const Scene scene = source.load(diagnostics);
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, "", diagnostics);
    const PathSettings image = settings.image();
    std::vector<std::unique_ptr<PathCandidate>> candidates;
    const auto add_own = [&](const char* name, Executor* executor) {
        if (executor != nullptr)
            candidates.push_back(std::make_unique<WeftPaths>(name, *executor, flat, camera, image));
    };
    add_own(paths_opencl, backends.opencl.get());
    add_own(paths_native, backends.native.get());
    add_own(paths_embree, backends.embree.get());
    for (const char* const variant : {paths_scalar, paths_llvm}) {
        if (source.file.empty()) break;
        auto mitsuba =
            std::make_unique<MitsubaPaths>(settings.mitsuba(), variant, source.file, image);
        if (version.empty()) version = mitsuba->version();
        candidates.push_back(std::move(mitsuba));
    }
    const std::uint64_t samples = std::uint64_t{image.width} * image.height * image.samples.end;
    return {source.name, flat.triangles.size(),
            measure_paths(candidates, samples, settings.runs())};
}

void run(const Settings& settings) {
    const auto limit = limit_threads(settings.threads);
    const Backends backends{open_opencl(settings.device, settings.threads),
                            make_native_executor(NativeTraversal::own_bvh, settings.threads),
                            make_native_executor(NativeTraversal::embree, settings.threads)};
    const PathSettings image = settings.image();
    nlohmann::json json{{"benchmark", "path"},
                        {"quick", settings.quick},
                        {"repetitions", settings.runs()},
                        {"size", image.width},
                        {"spp", image.samples.end},
                        {"machine", machine_json(settings.threads)},
                        {"versions", versions_json()},
                        {"opencl", nullptr}};
    if (backends.opencl) json["opencl"] = device_json(*backends.opencl);
    print(path_heading());
    Diagnostics diagnostics;
    Diagnostics problems;
    std::string version;
    std::vector<PathResult> results;
    for (const BenchScene& scene : wanted_scenes(settings)) {
        results.push_back(run_scene(settings, scene, backends, version, diagnostics));
        print(path_row(results.back()));
        json["scenes"].push_back(path_json(results.back()));
        for (const PathFigures& candidate : results.back().candidates)
            if (!candidate.problem.empty())
                problems.warn(candidate.figures.name, "not available, " + candidate.problem);
    }
    for (const std::string& problem : problems.warnings()) print(problem + "\n");
    json["versions"]["mitsuba"] = version.empty() ? nlohmann::json() : nlohmann::json(version);
    json["summary"] = path_summary(results);
    print("\n" + json["summary"].dump(2) + "\n");
    if (!settings.json.empty()) write_json(settings.json, json);
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("path", [&] {
        int status = 0;
        const auto settings = parse(argc, argv, status);
        if (settings) run(*settings);
        return status;
    });
}
