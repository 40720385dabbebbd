// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// References that are good enough to judge by: each grows until its two halves differ no more than
// is wished, and is kept where other benchmarks and `weft tradeoff` find it. docs/benchmarks.md
// says how to read it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/interrupt.h"
#include "base/error.h"
#include "base/limits.h"
#include "bench/common/bench_main.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/common/references_folder.h"
#include "bench/references/references_run.h"
#include "bench/tables/shipped_scenes.h"
#include "scene/load/load_scene.h"

namespace {

using namespace weft;
using namespace weft::bench;
namespace fs = std::filesystem;

struct Settings {
    bool quick = false;
    std::vector<std::string> files;
    std::string scenes = WEFT_SOURCE_DIR "/../shared/data/scenes";
    std::string shipped = WEFT_SOURCE_DIR "/scenes";
    std::string folder = references_folder(WEFT_SOURCE_DIR).string();
    std::string json;
    std::string backend = "native";
    std::string device;
    std::string algorithm = "reference";
    ReferenceFloor floor = good_floor;
    int threads = 0;
    std::uint32_t size = 0;      ///< 0: by `quick`
    std::uint32_t spp = 64;      ///< of the first step
    std::uint32_t most_spp = 0;  ///< 0: by `quick`
    double limit_minutes = 0.0;  ///< 0: none
    std::vector<std::string> sets, only;
    std::vector<std::string> filters{"box"};

    [[nodiscard]] bool wants_set(const std::string& set) const {
        if (sets.empty()) return files.empty() && set == "shipped";
        return std::find(sets.begin(), sets.end(), set) != sets.end();
    }
    [[nodiscard]] bool wants_scene(const std::string& name) const {
        if (only.empty()) return !quick || !files.empty() || name == "cornell-box.gltf";
        const auto is_named = [&](const std::string& wanted) {
            return wanted == name || wanted == fs::path(name).stem().string();
        };
        return std::any_of(only.begin(), only.end(), is_named);
    }
    [[nodiscard]] std::vector<BenchScene> wanted_scenes() const {
        std::vector<BenchScene> found;
        const auto add = [&](std::vector<BenchScene> list) {
            for (BenchScene& scene : list)
                if (wants_scene(scene.name)) found.push_back(std::move(scene));
        };
        if (wants_set("shipped")) add(all_shipped_scenes(shipped));
        if (wants_set("real")) add(load_real_scenes(scenes));
        for (const fs::path file : files)
            found.push_back(
                {file.filename().string(),
                 [file](Diagnostics& diagnostics) { return load_scene(file, diagnostics); }, file});
        if (found.empty())
            throw Error(ExitCode::usage, "no scene that is wanted is there: see --only and --sets");
        return found;
    }
    [[nodiscard]] ReferencesRun run() const {
        ReferencesRun run;
        run.scenes = wanted_scenes();
        run.filters = filters;
        run.size = size > 0 ? size : quick ? 64 : 512;
        run.spp = spp;
        run.algorithm = algorithm == "path" ? Algorithm::path : Algorithm::reference;
        run.goal.floor = floor;
        run.goal.most_spp = most_spp > 0 ? most_spp : quick ? 1024 : limits::max_samples_per_pixel;
        run.limit_minutes =
            limit_minutes > 0.0 ? limit_minutes : std::numeric_limits<double>::infinity();
        run.folder = folder;
        run.say = [](const std::string& text) { print(text + "\n"); };
        run.keep_going = [] { return !interrupt_flag(); };
        return run;
    }
};

void add_options(CLI::App& app, Settings& settings) {
    app.add_flag("--quick", settings.quick, "one scene, a small image, no more than 1024 samples");
    app.add_option("SCENE", settings.files, "scene files; without any, those that come with Weft");
    app.add_option("--sets", settings.sets, "sets of scenes, beside files")
        ->check(CLI::IsMember({"shipped", "real"}));
    app.add_option("--only", settings.only, "only the scenes of these names, of the sets");
    app.add_option("--scenes", settings.scenes,
                   "folder of the set real, each DIR/NAME/NAME.xml, with fog NAME-fog.xml");
    app.add_option("--shipped", settings.shipped, "folder of the scenes that come with Weft");
    app.add_option("--folder,--references", settings.folder, "folder to keep references in");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--threads", settings.threads, "threads; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--backend", settings.backend, "what renders")
        ->check(CLI::IsMember({"opencl", "embree", "native"}));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--algorithm", settings.algorithm, "what references are made by")
        ->check(CLI::IsMember({"path", "reference"}));
    app.add_option("--size", settings.size, "width and height of the image")
        ->check(CLI::Range(16, 4096));
    app.add_option("--filters", settings.filters, "pixel filters, a reference of each")
        ->check(CLI::IsMember({"box", "centre"}));
    app.add_option("--floor-published", settings.floor.published,
                   "percent of the pixels at which the halves may be seen to differ, in the "
                   "published protocol")
        ->check(CLI::Range(0.0, 100.0));
    app.add_option("--floor-display", settings.floor.display, "the same on a display")
        ->check(CLI::Range(0.0, 100.0));
    app.add_option("--spp", settings.spp, "samples of the first step, which then double")
        ->check(CLI::Range(2U, limits::max_samples_per_pixel));
    app.add_option("--limit-spp", settings.most_spp, "most samples of a reference")
        ->check(CLI::Range(2U, limits::max_samples_per_pixel));
    app.add_option("--limit-minutes", settings.limit_minutes,
                   "most minutes of each reference in this run; 0: none")
        ->check(CLI::Range(0.0, 1e6));
}

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app{"References whose two halves differ no more than is wished"};
    add_options(app, settings);
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return std::nullopt;
    }
    return settings;
}

nlohmann::json header_of(const Settings& settings, const ReferencesRun& run,
                         const Executor& executor) {
    return {{"benchmark", "references"},
            {"quick", settings.quick},
            {"size", run.size},
            {"floor_published", run.goal.floor.published},
            {"floor_display", run.goal.floor.display},
            {"limit_spp", run.goal.most_spp},
            {"limit_minutes", settings.limit_minutes > 0.0 ? nlohmann::json(settings.limit_minutes)
                                                           : nlohmann::json()},
            {"machine", machine_json(settings.threads)},
            {"versions", versions_json()},
            {"device", device_json(executor)}};
}

/// The exit code: 0 where all references have reached the goal.
int run(const Settings& settings) {
    InterruptGuard guard("bench references: interrupted");
    const auto limit = limit_threads(settings.threads);
    const auto executor = open_backend(settings.backend, settings.device, settings.threads);
    ReferencesRun how = settings.run();
    nlohmann::json json = header_of(settings, how, *executor);
    std::vector<ReferenceRow> latest;
    how.report = [&](const std::vector<ReferenceRow>& rows) {
        latest = rows;
        json["references"] = nlohmann::json::array();
        for (const ReferenceRow& row : rows) json["references"].push_back(row_json(row));
        json["summary"] = references_summary(rows);
        if (!settings.json.empty()) write_json(settings.json, json);
    };
    print(fmt::format("references are kept in {}\n", settings.folder));
    guard.keep_work();
    int status = 0;
    try {
        latest = make_references(how, *executor, status);
    } catch (const Error&) {
        print(references_table(latest, how.goal.floor));
        throw;
    }
    print(references_table(latest, how.goal.floor));
    const bool all = references_summary(latest)["all_reached"];
    return status != 0 || all ? status : 1;
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("references", [&] {
        int status = 0;
        const auto settings = parse(argc, argv, status);
        return settings ? run(*settings) : status;
    });
}
