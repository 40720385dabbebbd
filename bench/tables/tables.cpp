// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The published tables once more: frames per second, speed-ups and visible errors of adaptive
// interleaved sampling and what it is compared with, for the scenes that come with Weft and others.
// docs/benchmarks.md says how to read it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "bench/adaptive/adaptive_run.h"
#include "bench/adaptive/published_tables.h"
#include "bench/common/bench_main.h"
#include "bench/common/child_process.h"
#include "bench/common/growing_report.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/common/references_folder.h"
#include "bench/tables/moving_times.h"
#include "bench/tables/shipped_scenes.h"
#include "bench/tables/tables_report.h"
#include "device/native/native_executor.h"
#include "plan/quality.h"

namespace {

using namespace weft;
using namespace weft::bench;
namespace fs = std::filesystem;

const std::map<std::string, Quality> quality_names{
    {"draft", Quality::draft}, {"preview", Quality::preview}, {"high", Quality::high}};
const std::vector<std::string> method_names{method_igi, method_amax, method_ais, method_ic,
                                            method_tic};
constexpr const char* report_program = WEFT_SOURCE_DIR "/bench/report/tables_report.py";

struct Settings {
    bool quick = false;
    bool resume = false;
    bool without_errors = false;
    std::string scenes = WEFT_SOURCE_DIR "/../shared/data/scenes";
    std::string shipped = WEFT_SOURCE_DIR "/scenes";
    std::string json;
    std::string pages;
    std::string images;
    std::string backend = "opencl";
    std::string device;
    std::string references = references_folder(WEFT_SOURCE_DIR).string();
    std::string published = WEFT_SOURCE_DIR "/../shared/reference/tables.json";
    Quality quality = Quality::preview;
    int threads = 0;
    std::uint32_t size = 0;           ///< 0: by `quick`
    std::uint32_t repetitions = 0;    ///< 0: by `quick`
    std::uint32_t reference_spp = 0;  ///< 0: by `quick`
    std::vector<std::string> sets, only, algorithms;

    [[nodiscard]] bool wants_set(const std::string& set) const {
        return sets.empty() ? !quick || set == "shipped" : named(sets, set);
    }
    [[nodiscard]] bool wants_scene(const std::string& name) const {
        return only.empty() || named(only, name) || named(only, published_scene(name));
    }
    [[nodiscard]] bool wants_method(const char* name) const {
        return algorithms.empty() || named(algorithms, name);
    }
    /// Of the sequence with `ic` and `tic`.
    [[nodiscard]] std::uint32_t moving_frames() const { return quick ? 4 : 12; }
    [[nodiscard]] std::string quality_name() const {
        for (const auto& [name, value] : quality_names)
            if (value == quality) return name;
        return {};
    }
    [[nodiscard]] fs::path json_file() const {
        return json.empty() && !pages.empty() ? fs::path(pages) / "tables.json" : fs::path(json);
    }
    [[nodiscard]] AdaptiveRun run() const {
        AdaptiveRun run;
        const SamplingSettings sampling = sampling_of(quality);
        for (const auto& [name, algorithm] :
             {std::pair{method_igi, Algorithm::igi}, std::pair{method_amax, Algorithm::amax},
              std::pair{method_ais, Algorithm::ais}, std::pair{method_ic, Algorithm::ic}})
            if (wants_method(name)) run.methods.push_back({name, algorithm, sampling});
        run.frames.size = size > 0 ? size : quick ? 256 : 512;
        run.frames.repetitions = repetitions > 0 ? repetitions : quick ? 3 : 9;
        run.frames.packets = false;
        run.frames.alone = !quick;
        run.filters = without_errors ? std::vector<std::string>{} : std::vector<std::string>{"box"};
        run.layers = false;
        run.references = references;
        if (reference_spp == 0) run.enough = good_floor;
        run.reference_spp = reference_spp > 0 ? reference_spp : quick ? 64 : 2500;
        run.images = images;
        run.say = [](const std::string& text) { print(text + "\n"); };
        return run;
    }

  private:
    static bool named(const std::vector<std::string>& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    }
};

void add_options(CLI::App& app, Settings& settings) {
    app.add_flag("--quick", settings.quick,
                 "a smaller image, fewer runs, coarse references, the scenes of Weft alone");
    app.add_flag("--resume", settings.resume, "go on with the run that the JSON file holds");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--pages", settings.pages,
                   "folder for the Markdown pages and, without --json, for tables.json");
    app.add_option("--sets", settings.sets, "sets of scenes; default: both")
        ->check(CLI::IsMember({"shipped", "real"}));
    app.add_option("--only", settings.only, "measure only the scenes of these names");
    app.add_option("--methods", settings.algorithms, "measure only these")
        ->check(CLI::IsMember(method_names));
    app.add_option("--quality", settings.quality, "settings of all methods")
        ->transform(CLI::CheckedTransformer(quality_names));
    app.add_option("--scenes", settings.scenes,
                   "folder of scenes, each DIR/NAME/NAME.xml, with fog NAME-fog.xml beside it");
    app.add_option("--shipped", settings.shipped, "folder of the scenes that come with Weft");
    app.add_option("--backend", settings.backend, "what renders")
        ->check(CLI::IsMember({"opencl", "embree", "native"}));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--threads", settings.threads, "threads of every method; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--size", settings.size, "width and height of the image")
        ->check(CLI::Range(16, 4096));
    app.add_option("--repetitions", settings.repetitions, "timed frames of every method")
        ->check(CLI::Range(1, 1000));
    app.add_option("--references", settings.references,
                   "folder of references, each with its halves");
    app.add_option("--reference-spp", settings.reference_spp, "samples of references to make")
        ->check(CLI::Range(2U, limits::max_samples_per_pixel));
    app.add_flag("--no-errors", settings.without_errors, "times alone, without references");
    app.add_option("--pictures", settings.images, "folder to write all images to");
    app.add_option("--published", settings.published,
                   "JSON file of published figures to put beside these");
}

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app{"The published tables: frames per second, speed-ups and visible errors"};
    add_options(app, settings);
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return std::nullopt;
    }
    if (settings.resume && settings.json_file().empty())
        throw Error(ExitCode::usage, "--resume: expected --json or --pages with it");
    if (settings.run().methods.empty())
        throw Error(ExitCode::usage,
                    "--methods: tic alone makes no table, expected another one with it");
    if (!settings.pages.empty()) {
        std::error_code error;
        fs::create_directories(settings.pages, error);
        if (error) throw Error(ExitCode::output, settings.pages, error.message());
    }
    return settings;
}

/// The scenes that are there, of the sets that are wanted.
std::vector<AdaptiveSource> wanted_scenes(const Settings& settings) {
    std::vector<AdaptiveSource> sources;
    const auto add = [&](std::vector<BenchScene> scenes, bool shipped) {
        for (BenchScene& scene : scenes)
            if (settings.wants_scene(scene.name)) sources.push_back({std::move(scene), shipped});
    };
    if (settings.wants_set("shipped")) add(load_shipped_scenes(settings.shipped), true);
    if (settings.wants_set("real")) add(load_real_scenes(settings.scenes), false);
    if (sources.empty())
        throw Error(ExitCode::usage, "no scene that is wanted is there: see --only and --sets");
    return sources;
}

/// Names the scenes that would be measured if they were there.
void say_missing(const Settings& settings, const std::vector<AdaptiveSource>& sources) {
    const auto say = [&](std::span<const NamedScene> scenes, bool shipped) {
        for (const NamedScene& scene : scenes) {
            const auto is_it = [&](const AdaptiveSource& source) {
                return source.shipped == shipped && source.scene.name == scene.name;
            };
            if (settings.wants_scene(std::string(scene.name)) &&
                std::none_of(sources.begin(), sources.end(), is_it))
                print(fmt::format("{} is not there: left out\n", scene.name));
        }
    };
    if (settings.wants_set("shipped")) say(shipped_scenes(), true);
    if (settings.wants_set("real")) say(real_scenes(), false);
}

nlohmann::json header_of(const Settings& settings, const AdaptiveRun& run,
                         const nlohmann::json& published, const Executor& executor) {
    std::vector<std::string> names;
    for (const std::string& name : method_names)
        if (settings.wants_method(name.c_str())) names.push_back(name);
    return {{"benchmark", "tables"},
            {"quick", settings.quick},
            {"size", run.frames.size},
            {"repetitions", run.frames.repetitions},
            {"warm_up", run.frames.warm_up},
            {"moving_frames", settings.moving_frames()},
            {"quality", settings.quality_name()},
            {"methods", names},
            {"errors", !run.filters.empty()},
            {"reference_spp", run.reference_spp},
            {"published", published},
            {"machine", machine_json(settings.threads)},
            {"versions", versions_json()},
            {"device", device_json(executor)}};
}

nlohmann::json measure(const Settings& settings, const AdaptiveRun& run,
                       const AdaptiveSource& source, Executor& executor, Executor& path_executor) {
    Diagnostics diagnostics;
    TableScene scene;
    scene.measured = measure_scene(source, run, executor, path_executor, diagnostics);
    if (settings.wants_method(method_tic) && !scene.measured.media)
        scene.moving = measure_moving(source.scene, sampling_of(settings.quality), run.frames.size,
                                      settings.moving_frames(), executor, diagnostics);
    return table_scene_json(scene);
}

/// Makes the pages of a report, which Python does; where there is none, a line says what to run.
void write_pages(const Settings& settings) {
    const std::vector<std::string> command{
        "python3", "-B", report_program, settings.json_file().string(), "--output", settings.pages};
    try {
        ChildProcess python(command);
        bool any = false;
        while (const auto line = python.read_line()) {
            print(*line + "\n");
            any = true;
        }
        if (any) return;
        print("no pages: " + python.fate() + "; ");
    } catch (const Error& error) {
        print(std::string("no pages: ") + error.what() + "; ");
    }
    print(fmt::format("they are made by: python3 {} {} --output {}\n", report_program,
                      settings.json_file().string(), settings.pages));
}

/// The exit code: that of the first scene that could not be measured.
int run(const Settings& settings) {
    const auto limit = limit_threads(settings.threads);
    const nlohmann::json published = read_published(settings.published);
    const auto executor = open_backend(settings.backend, settings.device, settings.threads);
    const auto path_executor = make_native_executor(NativeTraversal::own_bvh, settings.threads);
    const AdaptiveRun how = settings.run();
    GrowingReport report(
        settings.json_file(), header_of(settings, how, published, *executor), "scenes",
        [&](const nlohmann::json& scenes) { return tables_summary(scenes, published); });
    if (settings.resume)
        report.resume({"benchmark", "size", "repetitions", "moving_frames", "quality", "methods",
                       "errors", "reference_spp", "versions", "device"});
    print(tables_legend());
    int status = 0;
    const std::vector<AdaptiveSource> sources = wanted_scenes(settings);
    say_missing(settings, sources);
    for (const AdaptiveSource& source : sources) {
        const std::string set = source.shipped ? "shipped" : "real";
        if (report.has({{"scene", source.scene.name}, {"set", set}})) continue;
        nlohmann::json part;
        try {
            part = measure(settings, how, source, *executor, *path_executor);
        } catch (const Error& error) {
            // A long run goes on without it, and --resume tries it again.
            print(fmt::format("\n{}: {}\n", source.scene.name, error.what()));
            if (status == 0) status = static_cast<int>(error.code());
            continue;
        }
        report.add(std::move(part));
        print(table_scene_text(report.parts().back(), published));
    }
    print(tables_summary_text(report.summary(), published));
    if (!settings.pages.empty() && !report.parts().empty()) write_pages(settings);
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("tables", [&] {
        int status = 0;
        const auto settings = parse(argc, argv, status);
        return settings ? run(*settings) : status;
    });
}
