// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Algorithms of the path family on each backend next to Mitsuba 3, on the same scene files in one
// run.
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
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/path/mitsuba_choice.h"
#include "bench/path/path_algorithms.h"
#include "bench/path/path_candidates.h"
#include "bench/path/path_report.h"
#include "bench/path/path_scenes.h"
#include "bench/path/scratch_folder.h"
#include "render/camera_params.h"
#include "scene/flat_scene.h"

namespace {

using namespace weft;
using namespace weft::bench;

struct Settings {
    bool quick = false;
    bool materials = false;
    std::string scenes = WEFT_SOURCE_DIR "/../shared/data/scenes";
    std::string json;
    std::string device;
    int threads = 0;
    std::string python;
    std::string variant;
    std::uint32_t spp = 0;          ///< 0: by `quick`
    std::uint32_t size = 0;         ///< 0: by `quick`
    std::uint32_t repetitions = 0;  ///< 0: by `quick`
    std::vector<std::string> only;
    std::vector<std::string> algorithms;
    std::vector<std::string> backends{"opencl", "native", "embree"};

    [[nodiscard]] std::uint32_t runs() const {
        return repetitions > 0 ? repetitions : quick ? 3 : 9;
    }
    [[nodiscard]] PathSettings image() const {
        PathSettings settings;
        settings.width = settings.height = size > 0 ? size : quick ? 64 : 128;
        settings.samples.end = spp > 0 ? spp : quick ? 32 : 64;
        return settings;
    }
    [[nodiscard]] PythonPrograms programs() const {
        const char* chosen = std::getenv("WEFT_BENCH_PYTHON");
        if (chosen == nullptr) chosen = std::getenv("WEFT_WITNESS_PYTHON");  // its old name
        const std::string usual = chosen != nullptr && *chosen != '\0' ? chosen : "python3";
        return {python.empty() ? usual : python, WEFT_SOURCE_DIR "/bench"};
    }
};

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    std::vector<std::string> names;
    for (const PathAlgorithm& algorithm : path_algorithms()) names.emplace_back(algorithm.name);
    settings.algorithms = names;
    CLI::App app{"Weft's path tracers against Mitsuba 3: variance times seconds"};
    app.add_flag("--quick", settings.quick, "a smaller image, fewer samples and images");
    app.add_flag("--materials", settings.materials,
                 "scenes with metals, plastics and glass instead, of bench witness");
    app.add_option("--scenes", settings.scenes, "folder of scenes, each DIR/NAME/NAME.xml");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--threads", settings.threads, "threads of every candidate; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--only", settings.only, "measure only the scenes of these names");
    app.add_option("--algorithms", settings.algorithms, "of Weft; default: all that there are")
        ->check(CLI::IsMember(names));
    app.add_option("--backends", settings.backends, "of Weft; default: all that there are")
        ->check(CLI::IsMember({"opencl", "native", "embree"}));
    app.add_option("--python", settings.python,
                   "Python that has mitsuba; default: $WEFT_BENCH_PYTHON, else python3");
    app.add_option("--variant", settings.variant,
                   "of Mitsuba; default: llvm_ad_rgb where it works, else scalar_rgb");
    app.add_option("--spp", settings.spp, "samples per pixel of an image")
        ->check(CLI::Range(1U, limits::max_samples_per_pixel));
    app.add_option("--size", settings.size, "width and height of the image")
        ->check(CLI::Range(1, 1024));
    app.add_option("--repetitions", settings.repetitions, "images by every candidate")
        ->check(CLI::Range(3, 1000));
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return std::nullopt;
    }
    return settings;
}

/// A backend of Weft that is there.
struct Backend {
    std::string name;
    std::unique_ptr<Executor> executor;
};

std::vector<Backend> open_backends(const Settings& settings) {
    std::vector<Backend> backends;
    for (const std::string& name : settings.backends) {
        auto executor = name == "opencl" ? open_opencl(settings.device, settings.threads)
                                         : open_backend(name, "", settings.threads);
        if (executor) backends.push_back({name, std::move(executor)});
    }
    return backends;
}

PathResult run_scene(const Settings& settings, const PathScene& source,
                     const std::vector<Backend>& backends, const MitsubaChoice& mitsuba,
                     const std::filesystem::path& scratch, Diagnostics& diagnostics) {
    const Scene scene = source.scene.load(diagnostics);
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, "", diagnostics);
    const PathSettings image = settings.image();
    std::vector<std::unique_ptr<PathCandidate>> candidates;
    if (mitsuba.available() && !source.scene.file.empty())
        candidates.push_back(std::make_unique<MitsubaPaths>(mitsuba, source.scene.file, image,
                                                            scratch, settings.threads));
    for (const std::string& algorithm : settings.algorithms)
        for (const Backend& backend : backends)
            candidates.push_back(std::make_unique<WeftPaths>(
                path_algorithm(algorithm), backend.name, *backend.executor, flat, camera, image));
    return {
        source.scene.name, source.media, flat.triangles.size(),
        measure_paths(candidates, {image.width, image.height, image.samples.end}, settings.runs())};
}

/// Says which Mitsuba is taken and why no other, and returns it.
MitsubaChoice announced_mitsuba(const Settings& settings) {
    MitsubaChoice mitsuba = choose_mitsuba(settings.programs(), settings.variant);
    if (mitsuba.available())
        for (const std::string& failed : mitsuba.failed) print("does not work: " + failed + "\n");
    print(mitsuba.text() + "\n\n");
    return mitsuba;
}

nlohmann::json header(const Settings& settings, const std::vector<Backend>& backends,
                      const MitsubaChoice& mitsuba) {
    const PathSettings image = settings.image();
    nlohmann::json json{{"benchmark", "path"},
                        {"quick", settings.quick},
                        {"repetitions", settings.runs()},
                        {"size", image.width},
                        {"spp", image.samples.end},
                        {"machine", machine_json(settings.threads)},
                        {"versions", versions_json()},
                        {"opencl", nullptr},
                        {"mitsuba",
                         {{"variant", mitsuba.variant},
                          {"library", mitsuba.library},
                          {"llvm", mitsuba.llvm},
                          {"problem", mitsuba.problem},
                          {"failed", mitsuba.failed}}}};
    json["versions"]["mitsuba"] =
        mitsuba.available() ? nlohmann::json(mitsuba.version) : nlohmann::json();
    for (const Backend& backend : backends)
        if (backend.name == "opencl") json["opencl"] = device_json(*backend.executor);
    return json;
}

void run(const Settings& settings) {
    const auto limit = limit_threads(settings.threads);
    const std::vector<Backend> backends = open_backends(settings);
    const ScratchFolder scratch;
    Diagnostics diagnostics;
    Diagnostics problems;
    std::string left_out;
    const PythonPrograms programs = settings.programs();
    const std::vector<PathScene> scenes =
        settings.materials
            ? path_material_scenes(settings.only, programs, scratch.path(), left_out)
            : path_scenes(settings.scenes, settings.only, programs, scratch.path(), left_out);
    if (!left_out.empty())
        problems.warn("scenes that the benchmark writes", "left out, " + left_out);
    if (scenes.empty()) throw Error(ExitCode::usage, "--only names no scene that is there");
    const MitsubaChoice mitsuba = announced_mitsuba(settings);
    nlohmann::json json = header(settings, backends, mitsuba);
    const PathSettings image = settings.image();
    const double most_z = z_limit(block_count(image.width, image.height) * scenes.size() *
                                  settings.algorithms.size() * backends.size());
    print(path_heading());
    std::vector<PathResult> results;
    for (const PathScene& scene : scenes) {
        results.push_back(
            run_scene(settings, scene, backends, mitsuba, scratch.path(), diagnostics));
        print(path_rows(results.back(), most_z));
        json["scenes"].push_back(path_json(results.back()));
        for (const PathFigures& candidate : results.back().candidates)
            if (!candidate.problem.empty())
                problems.warn(scene.scene.name, candidate.candidate_name.name() + " is left out, " +
                                                    candidate.problem);
    }
    print(path_means(results));
    for (const std::string& problem : problems.warnings()) print(problem + "\n");
    json["summary"] = path_summary(results, most_z);
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
