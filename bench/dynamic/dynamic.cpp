// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Sequences of frames in which things happen: indirect light by virtual lights, by records made for
// each frame, and by records that outlast their frame; times, rays, records, errors and flicker in
// one run. docs/benchmarks.md says how to read it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "bench/common/bench_main.h"
#include "bench/common/bench_scenes.h"
#include "bench/common/growing_report.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/common/references_folder.h"
#include "bench/dynamic/dynamic_methods.h"
#include "bench/dynamic/dynamic_report.h"
#include "bench/dynamic/dynamic_run.h"
#include "bench/dynamic/dynamic_sequences.h"
#include "bench/dynamic/static_light.h"
#include "device/native/native_executor.h"
#include "device/shared_scene.h"
#include "render/camera_params.h"
#include "scene/load/load_scene.h"
#include "scene/pose_scene.h"
#include "tradeoff/error_values.h"
#include "tradeoff/reference_images.h"

namespace {

using namespace weft;
using namespace weft::bench;
namespace fs = std::filesystem;

struct Settings {
    bool quick = false;
    bool validation = false;
    bool single = false;  ///< frames of scenes that hold still
    bool resume = false;
    std::string scenes = WEFT_SOURCE_DIR "/../shared/data/scenes";
    std::string json;
    std::string report;
    std::string backend = "opencl";
    std::string device;
    std::string references = references_folder(WEFT_SOURCE_DIR).string();
    int threads = 0;
    std::uint32_t size = 0;           ///< 0: by `quick`
    std::uint32_t frames = 0;         ///< 0: by `quick`
    std::uint32_t converged = 0;      ///< 0: by `quick`
    std::uint32_t reference_spp = 0;  ///< 0: by `quick`
    std::uint32_t repetitions = 0;    ///< 0: by `quick`
    std::optional<Visible> visible;   ///< else by `quick`
    std::vector<std::string> only, sequences, algorithms;

    [[nodiscard]] bool wants(const std::string& name) const { return named(only, name); }
    [[nodiscard]] bool wants_method(const std::string& name) const {
        return named(algorithms, name);
    }
    [[nodiscard]] std::vector<Event> events(const std::string& scene) const {
        if (sequences.empty()) return events_in(scene);
        const std::vector<std::string> names = event_names();
        std::vector<Event> found;
        for (std::size_t i = 0; i < names.size(); ++i)
            if (named(sequences, names[i])) found.push_back(static_cast<Event>(i));
        return found;
    }
    [[nodiscard]] DynamicRun run() const {
        return {or_else(size, 128, 512), or_else(frames, 5, 12), or_else(converged, 2, 8),
                visible.value_or(quick ? Visible::last : Visible::all),
                report.empty() ? fs::path() : fs::path(report) / "pictures"};
    }
    [[nodiscard]] StaticRun static_run() const {
        return {or_else(size, 128, 512), or_else(repetitions, 3, 5), or_else(converged, 2, 8)};
    }
    [[nodiscard]] std::uint32_t spp() const { return or_else(reference_spp, 64, 2500); }
    [[nodiscard]] fs::path json_file() const {
        return json.empty() && !report.empty() ? fs::path(report) / "dynamic.json" : fs::path(json);
    }

  private:
    static bool named(const std::vector<std::string>& names, const std::string& name) {
        return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
    }
    [[nodiscard]] std::uint32_t or_else(std::uint32_t given, std::uint32_t when_quick,
                                        std::uint32_t usually) const {
        return given > 0 ? given : quick ? when_quick : usually;
    }
};

void add_options(CLI::App& app, Settings& settings) {
    app.add_flag("--quick", settings.quick, "a smaller image, fewer frames");
    app.add_flag("--audit", settings.validation,
                 "instead of times: compare all kept records with records computed anew");
    app.add_flag("--static", settings.single,
                 "single frames of scenes that hold still: times and errors");
    app.add_flag("--resume", settings.resume, "go on with the run that --json holds");
    app.add_option("--scenes", settings.scenes, "folder of scenes, each DIR/NAME/NAME.xml");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--report", settings.report,
                   "folder for the JSON and small images, for dynamic_report.py");
    app.add_option("--threads", settings.threads, "threads; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--backend", settings.backend, "what renders")
        ->check(CLI::IsMember({"opencl", "embree", "native"}));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--only", settings.only, "measure only the scenes of these names");
    app.add_option("--sequences", settings.sequences, "make only these, in every scene")
        ->check(CLI::IsMember(event_names()));
    app.add_option("--methods", settings.algorithms, "measure only the methods of these names");
    app.add_option("--size", settings.size, "width and height of the image")
        ->check(CLI::Range(16, 4096));
    app.add_option("--frames", settings.frames, "frames of every sequence")
        ->check(CLI::Range(3, 1000));
    app.add_option("--converged", settings.converged, "frames of ir that make a converged one")
        ->check(CLI::Range(1, 10000));
    app.add_option("--visible", settings.visible, "in which frames to ask HDR-VDP")
        ->transform(CLI::CheckedTransformer(std::map<std::string, Visible>{
            {"none", Visible::none}, {"last", Visible::last}, {"all", Visible::all}}));
    app.add_option("--repetitions", settings.repetitions, "of --static: frames of every method")
        ->check(CLI::Range(1, 1000));
    app.add_option("--references", settings.references,
                   "of --static: folder of references, each with its halves");
    app.add_option("--reference-spp", settings.reference_spp, "of --static: samples of new ones")
        ->check(CLI::Range(2U, limits::max_samples_per_pixel));
}

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app{"Frames in which things happen: instant and temporal instant caching"};
    add_options(app, settings);
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return std::nullopt;
    }
    if (settings.validation && settings.single)
        throw Error(ExitCode::usage, "--static: keeps no records, expected it without --audit");
    if (settings.resume && settings.json_file().empty())
        throw Error(ExitCode::usage, "--resume: expected --json or --report with it");
    if (!settings.report.empty()) {
        std::error_code error;
        fs::create_directories(settings.report, error);
        if (error) throw Error(ExitCode::output, settings.report, error.message());
    }
    return settings;
}

/// The scene files that are there; where there are none, those that come with Weft.
std::vector<BenchScene> wanted_scenes(const Settings& settings) {
    std::vector<BenchScene> scenes = bench_scenes(
        settings.scenes, {"cornell-box", "office", "desk", "conference", "sibenik"}, true);
    std::erase_if(scenes, [](const BenchScene& scene) { return scene.file.empty(); });
    if (scenes.empty())
        for (const char* const name : {"cornell-box.gltf", "gallery.gltf"}) {
            const fs::path file = fs::path(WEFT_SOURCE_DIR) / "scenes" / name;
            scenes.push_back(
                {name, [file](Diagnostics& diagnostics) { return load_scene(file, diagnostics); },
                 file});
        }
    std::erase_if(scenes, [&](const BenchScene& scene) { return !settings.wants(scene.name); });
    if (scenes.empty()) throw Error(ExitCode::usage, "--only names no scene that is there");
    return scenes;
}

std::vector<DynamicMethod> wanted_methods(const Settings& settings) {
    std::vector<DynamicMethod> methods =
        dynamic_methods([](const std::string& text) { print(text + "\n"); });
    std::erase_if(methods, [&](const DynamicMethod& m) { return !settings.wants_method(m.name); });
    if (methods.empty()) throw Error(ExitCode::usage, "--methods names none that is there");
    return methods;
}

nlohmann::json header_of(const Settings& settings, const char* mode,
                         const std::vector<DynamicMethod>& methods, const Executor& executor) {
    const DynamicRun run = settings.run();
    std::vector<std::string> names;
    for (const DynamicMethod& method : methods) names.push_back(method.name);
    return {{"benchmark", "dynamic"},
            {"mode", mode},
            {"quick", settings.quick},
            {"size", run.edge},
            {"frames", run.frames},
            {"converged", run.converged},
            {"methods", names},
            {"machine", machine_json(settings.threads)},
            {"versions", versions_json()},
            {"device", device_json(executor)}};
}

/// Sequences of all scenes, measured or validated; `table` shows one.
void run_sequences(const Settings& settings, const std::vector<DynamicMethod>& methods,
                   Executor& executor, GrowingReport& report, decltype(measure_sequence)* make,
                   std::string (*table)(const nlohmann::json&)) {
    Diagnostics diagnostics;
    for (const BenchScene& source : wanted_scenes(settings)) {
        std::optional<DynamicScene> scene;
        for (const Event event : settings.events(source.name)) {
            if (report.has({{"scene", source.name}, {"happening", to_string(event)}})) continue;
            if (!scene) scene = load_dynamic_scene(source, diagnostics);
            report.add(make(*scene, event, methods, settings.run(), executor));
            print(table(report.parts().back()));
        }
    }
}

void resume(const Settings& settings, GrowingReport& report) {
    if (settings.resume)
        report.resume({"mode", "size", "frames", "converged", "methods", "device"});
}

void measure_all(const Settings& settings, Executor& executor) {
    const std::vector<DynamicMethod> methods = wanted_methods(settings);
    GrowingReport report(settings.json_file(), header_of(settings, "sequences", methods, executor),
                         "sequences", sequence_summary);
    resume(settings, report);
    print(sequence_heading());
    run_sequences(settings, methods, executor, report, measure_sequence, sequence_table);
    print("\n" + report.summary().dump(2) + "\n");
}

/// Whether every kept record is what it would be if computed anew.
bool validate_all(const Settings& settings, Executor& executor) {
    const std::vector<DynamicMethod> methods = wanted_methods(settings);
    GrowingReport report(settings.json_file(), header_of(settings, "audit", methods, executor),
                         "sequences", validation_summary);
    resume(settings, report);
    print(fmt::format("{:>12} {:>9} {:>16} {:>9} {:>12} {:>9} {:>14} {:>14}\n", "scene", "what",
                      "method", "frames", "compared", "differ", "traced", "affected"));
    run_sequences(settings, methods, executor, report, validate_sequence, validation_table);
    print("\n" + report.summary().dump(2) + "\n");
    if (report.summary()["compared"] == 0)
        throw Error(ExitCode::usage,
                    "no record was compared, expected sequences in which light changes");
    return report.summary()["differing"] == 0;
}

nlohmann::json static_scene(const Settings& settings, const BenchScene& source,
                            const std::vector<DynamicMethod>& methods, Executor& executor,
                            Executor& path_executor) {
    Diagnostics diagnostics;
    Scene scene = source.load(diagnostics);
    hold_still(scene);
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, "", diagnostics);
    const StaticRun run = settings.static_run();
    SharedScene path_shared(path_executor);
    ReferenceImages images(settings.references, path_shared,
                           [](const std::string& text) { print(text + "\n"); });
    ReferenceWish wish{source.name, run.edge, true, settings.spp()};
    wish.with_halves = true;
    const Reference reference = images.find(flat, camera, wish);
    nlohmann::json reference_json = reference.json();
    if (const auto noise = noise_relmse_of(reference.image))
        reference_json["noise_relmse"] = *noise;
    SharedScene shared(executor);
    const StaticReferences references{reference.image,
                                      many_vpls(shared, flat, camera, run.edge, run.converged)};
    return {{"scene", source.name},
            {"reference", reference_json},
            {"methods", measure_static(shared, flat, camera, methods, references, run)}};
}

void measure_single(const Settings& settings, Executor& executor) {
    const std::vector<DynamicMethod> methods = wanted_methods(settings);
    const auto path_executor = make_native_executor(NativeTraversal::own_bvh, settings.threads);
    nlohmann::json header = header_of(settings, "static", methods, executor);
    header["reference_spp"] = settings.spp();
    header["repetitions"] = settings.static_run().repetitions;
    GrowingReport report(settings.json_file(), header, "scenes", static_summary);
    if (settings.resume)
        report.resume(
            {"mode", "size", "converged", "methods", "reference_spp", "repetitions", "device"});
    print(static_heading());
    for (const BenchScene& source : wanted_scenes(settings)) {
        if (report.has({{"scene", source.name}})) continue;
        report.add(static_scene(settings, source, methods, executor, *path_executor));
        print(static_table(report.parts().back()));
    }
    print("\n" + report.summary().dump(2) + "\n");
}

/// The exit code.
int run(const Settings& settings) {
    const auto limit = limit_threads(settings.threads);
    const auto executor = open_backend(settings.backend, settings.device, settings.threads);
    if (settings.validation) return validate_all(settings, *executor) ? 0 : 1;
    if (settings.single)
        measure_single(settings, *executor);
    else
        measure_all(settings, *executor);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("dynamic", [&] {
        int status = 0;
        const auto settings = parse(argc, argv, status);
        return settings ? run(*settings) : status;
    });
}
