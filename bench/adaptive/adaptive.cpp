// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Adaptive interleaved sampling against the same with every level at its maximum and against
// instant global illumination: speed and errors in one run. docs/benchmarks.md says how to read it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "bench/adaptive/adaptive_frames.h"
#include "bench/adaptive/adaptive_report.h"
#include "bench/adaptive/adaptive_run.h"
#include "bench/adaptive/published_tables.h"
#include "bench/common/bench_main.h"
#include "bench/common/bench_scenes.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/common/references_folder.h"
#include "device/native/native_executor.h"
#include "plan/quality.h"
#include "scene/load/load_scene.h"

namespace {

using namespace weft;
using namespace weft::bench;
namespace fs = std::filesystem;

struct Settings {
    bool quick = false;
    bool without_errors = false;
    std::string scenes = WEFT_SOURCE_DIR "/../shared/data/scenes";
    std::string json;
    std::string backend = "opencl";
    std::string device;
    std::string references = references_folder(WEFT_SOURCE_DIR).string();
    std::string published = WEFT_SOURCE_DIR "/../shared/reference/tables.json";
    std::string images;
    int threads = 0;
    std::uint32_t size = 0;           ///< 0: by `quick`
    std::uint32_t repetitions = 0;    ///< 0: by `quick`
    std::uint32_t reference_spp = 0;  ///< 0: by `quick`
    std::vector<double> thresholds;
    std::optional<Quality> quality;
    std::optional<double> support, roulette;
    std::vector<std::string> filters{"box", "centre"};
    std::vector<std::string> only;

    [[nodiscard]] bool wants(const std::string& name) const {
        return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
    }
    [[nodiscard]] FrameRun frames() const {
        return {size > 0 ? size
                : quick  ? 128U
                         : 512U,
                repetitions > 0 ? repetitions
                : quick         ? 5U
                                : 9U};
    }
    [[nodiscard]] std::uint32_t spp() const {
        return reference_spp > 0 ? reference_spp : quick ? 64 : 2500;
    }
    /// `igi`, `amax` and an `ais` for every threshold.
    [[nodiscard]] std::vector<FrameMethod> methods() const {
        SamplingSettings sampling = sampling_of(quality.value_or(Quality::preview));
        if (support) sampling.enough_support = *support;
        if (roulette) sampling.roulette = *roulette;
        std::vector<FrameMethod> methods{{method_igi, Algorithm::igi, sampling},
                                         {method_amax, Algorithm::amax, sampling}};
        if (thresholds.empty()) methods.push_back({"ais", Algorithm::ais, sampling});
        for (const double threshold : thresholds) {
            methods.push_back({fmt::format("ais-{:g}", threshold), Algorithm::ais, sampling});
            methods.back().sampling.threshold = threshold;
        }
        return methods;
    }
    [[nodiscard]] AdaptiveRun run() const {
        AdaptiveRun run;
        run.methods = methods();
        run.frames = frames();
        run.filters = without_errors ? std::vector<std::string>{} : filters;
        run.references = references;
        if (reference_spp == 0) run.enough = good_floor;
        run.reference_spp = spp();
        run.images = images;
        run.say = [](const std::string& text) { print(text + "\n"); };
        return run;
    }
};

void add_options(CLI::App& app, Settings& settings) {
    app.add_flag("--quick", settings.quick,
                 "fewer scenes, a smaller image, fewer runs, coarse references");
    app.add_option("--scenes", settings.scenes,
                   "folder of scenes, each DIR/NAME/NAME.xml, with fog NAME-fog.xml beside it");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--threads", settings.threads, "threads of every method; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--backend", settings.backend, "what renders")
        ->check(CLI::IsMember({"opencl", "embree", "native"}));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--only", settings.only, "measure only the scenes of these names");
    app.add_option("--size", settings.size, "width and height of the image")
        ->check(CLI::Range(16, 4096));
    app.add_option("--repetitions", settings.repetitions, "timed frames of every method")
        ->check(CLI::Range(1, 1000));
    app.add_option("--threshold", settings.thresholds,
                   "of ais; a row for each, the first is the summary's; default: the program's")
        ->check(CLI::Range(0.0, 1e6));
    app.add_option("--quality", settings.quality, "settings of all methods")
        ->transform(CLI::CheckedTransformer(std::map<std::string, Quality>{
            {"draft", Quality::draft}, {"preview", Quality::preview}, {"high", Quality::high}}));
    app.add_option("--support", settings.support, "of ais; default: that of the quality")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--roulette", settings.roulette, "of ais; default: that of the quality")
        ->check(CLI::Range(0.0, 1e3));
    app.add_option("--references", settings.references,
                   "folder of references, each with its halves");
    app.add_option("--reference-spp", settings.reference_spp, "samples of references to make")
        ->check(CLI::Range(2U, limits::max_samples_per_pixel));
    app.add_option("--filters", settings.filters, "compare with references of these filters only")
        ->check(CLI::IsMember({"box", "centre"}));
    app.add_flag("--no-errors", settings.without_errors, "times alone, without references");
    app.add_option("--pictures", settings.images, "folder to write all images to");
    app.add_option("--published", settings.published,
                   "JSON file of published figures to print beside these");
}

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app{"Adaptive sampling against full density and instant global illumination"};
    add_options(app, settings);
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return std::nullopt;
    }
    return settings;
}

/// The scene files that are there, then those that come with Weft; not both where it is to be
/// quick.
std::vector<AdaptiveSource> wanted_scenes(const Settings& settings) {
    std::vector<AdaptiveSource> sources;
    for (BenchScene& scene : bench_scenes(settings.scenes,
                                          {"cornell-box", "office", "desk", "conference", "sibenik",
                                           "cornell-box-fog", "office-fog", "sibenik-fog"},
                                          true))
        if (!scene.file.empty()) sources.push_back({std::move(scene), false});
    const bool enough = settings.quick && settings.only.empty() && !sources.empty();
    for (const char* const name : {"cornell-box.gltf", "gallery.gltf", "cornell-box-fog.gltf",
                                   "shafts.gltf", "smoke.gltf"}) {
        if (enough) break;
        const fs::path file = fs::path(WEFT_SOURCE_DIR) / "scenes" / name;
        if (!fs::is_regular_file(file)) continue;
        const auto load = [file](Diagnostics& diagnostics) {
            return load_scene(file, diagnostics);
        };
        sources.push_back({{name, load, file}, true});
    }
    std::erase_if(sources, [&](const AdaptiveSource& s) { return !settings.wants(s.scene.name); });
    if (sources.empty()) throw Error(ExitCode::usage, "--only names no scene that is there");
    return sources;
}

void run(const Settings& settings) {
    const auto limit = limit_threads(settings.threads);
    const nlohmann::json published = read_published(settings.published);
    const auto executor = open_backend(settings.backend, settings.device, settings.threads);
    const auto path_executor = make_native_executor(NativeTraversal::own_bvh, settings.threads);
    const FrameRun frames = settings.frames();
    nlohmann::json json{{"benchmark", "adaptive"},
                        {"quick", settings.quick},
                        {"repetitions", frames.repetitions},
                        {"warm_up", frames.warm_up},
                        {"size", frames.size},
                        {"reference_spp", settings.spp()},
                        {"thresholds", settings.thresholds},
                        {"machine", machine_json(settings.threads)},
                        {"versions", versions_json()},
                        {"device", device_json(*executor)}};
    print(adaptive_legend());
    Diagnostics diagnostics;
    std::vector<AdaptiveScene> scenes;
    const AdaptiveRun how = settings.run();
    for (const AdaptiveSource& source : wanted_scenes(settings)) {
        scenes.push_back(measure_scene(source, how, *executor, *path_executor, diagnostics));
        print(adaptive_tables(scenes.back()));
        json["scenes"].push_back(adaptive_json(scenes.back()));
        for (MethodFrames& method : scenes.back().frames.methods) method.image = {};
    }
    for (const FrameMethod& method : settings.methods()) {
        if (method.algorithm != Algorithm::ais) continue;
        const nlohmann::json summary = adaptive_summary(scenes, method.name);
        print(summary_table(summary, published));
        if (!json.contains("summary")) json["summary"] = summary;
        json["summaries"].push_back(summary);
    }
    print("\n" + json["summary"].dump(2) + "\n");
    if (!settings.json.empty()) write_json(settings.json, json);
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("adaptive", [&] {
        int status = 0;
        const auto settings = parse(argc, argv, status);
        if (settings) run(*settings);
        return status;
    });
}
