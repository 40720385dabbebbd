// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Ray queries: Weft's own traversal, on OpenCL and compiled natively, against Embree's calls, on
// the same rays in one run. docs/benchmarks.md says how to read it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "bench/common/bench_main.h"
#include "bench/common/bench_scenes.h"
#include "bench/common/frame_recorder.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/common/ray_sets.h"
#include "bench/rays/embree_queries.h"
#include "bench/rays/ray_report.h"
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
    std::uint32_t repetitions = 0;  ///< 0: by `quick`
    std::vector<std::string> only;
    std::vector<std::string> sets;

    [[nodiscard]] bool wants_scene(const std::string& name) const { return wants(only, name); }
    [[nodiscard]] bool wants_set(const std::string& name) const { return wants(sets, name); }

    [[nodiscard]] std::size_t rays() const { return std::size_t{1} << (quick ? 16 : 18); }
    [[nodiscard]] std::size_t packet_slots() const { return std::size_t{1} << (quick ? 18 : 20); }
    [[nodiscard]] std::uint32_t runs() const {
        return repetitions > 0 ? repetitions : quick ? 5 : 9;
    }

  private:
    static bool wants(const std::vector<std::string>& list, const std::string& name) {
        return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
    }
};

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app{"Ray queries of Weft against Embree's, in million rays per second"};
    app.add_flag("--quick", settings.quick, "fewer rays and runs, without the largest scene");
    app.add_option("--scenes", settings.scenes, "folder of scenes, each DIR/NAME/NAME.xml");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--threads", settings.threads, "threads of every candidate; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--only", settings.only, "measure only the scenes of these names");
    app.add_option("--sets", settings.sets, "measure only these ray sets")
        ->check(CLI::IsMember({set_primary, set_closest, set_any, set_packets}));
    app.add_option("--repetitions", settings.repetitions, "timed runs of every candidate")
        ->check(CLI::Range(1, 1000));
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return std::nullopt;
    }
    return settings;
}

/// Everything that answers queries about one scene.
class SceneBench {
  public:
    SceneBench(const Settings& settings, Executor& native, Executor* opencl, const FlatScene& flat,
               const Camera& camera)
        : settings_(settings),
          flat_(flat),
          frame_(record_frame(native, flat, camera)),
          native_(candidate_native, native, *frame_.scene),
          embree_scenes_(geometry(), settings.threads),
          embree_(embree_scenes_, settings.threads) {
        if (opencl == nullptr) return;
        opencl_scene_ = opencl->make_scene(geometry());
        opencl_.emplace(candidate_opencl, *opencl, *opencl_scene_);
    }

    /// Measures the wanted ray sets; `show` is given each as it is done.
    void run(std::vector<SetResult>& results, const std::function<void(const SetResult&)>& show) {
        const auto keep = [&](SetResult result) {
            show(result);
            results.push_back(std::move(result));
        };
        if (settings_.wants_set(set_primary))
            keep(measure_closest(set_primary, primary_rays(frame_)));
        const auto points = bounce_points(
            flat_, frame_, [&](const RaySet& rays) { return native_.trace(rays); },
            settings_.rays());
        if (settings_.wants_set(set_closest))
            keep(measure_closest(set_closest, bounce_rays(points)));
        if (settings_.wants_set(set_any)) {
            const RaySet rays = segments(points);
            keep(measure_set(set_any, AnswerKind::blocked, rays.size(),
                             [&](const auto& queries) { return queries.any(rays); }));
        }
        if (settings_.wants_set(set_packets)) {
            const PacketSet packets = shadow_packets(frame_, settings_.packet_slots());
            keep(measure_set(set_packets, AnswerKind::blocked, packets.rays,
                             [&](const auto& queries) { return queries.packets(packets); }));
        }
    }

  private:
    [[nodiscard]] TracedGeometry geometry() const {
        return {flat_.positions, flat_.triangles, frame_.box_padding};
    }

    [[nodiscard]] SetResult measure_closest(const char* name, const RaySet& rays) const {
        return measure_set(name, AnswerKind::triangle, rays.size(),
                           [&](const auto& queries) { return queries.closest(rays); });
    }

    /// Native comes first: its answers are what the others are compared with.
    template <class Make>
    [[nodiscard]] SetResult measure_set(const char* name, AnswerKind kind, std::uint64_t rays,
                                        const Make& make) const {
        std::vector<Candidate> candidates{make(native_)};
        if (opencl_) candidates.push_back(make(*opencl_));
        for (Candidate& candidate : make(embree_)) candidates.push_back(std::move(candidate));
        return {name, rays, measure(candidates, kind, rays, settings_.runs())};
    }

    const Settings& settings_;
    const FlatScene& flat_;
    RecordedFrame frame_;
    OwnQueries native_;
    EmbreeScenes embree_scenes_;
    EmbreeQueries embree_;
    std::unique_ptr<TracedScene> opencl_scene_;
    std::optional<OwnQueries> opencl_;
};

SceneResult run_scene(const Settings& settings, const BenchScene& source, Executor& native,
                      Executor* opencl, Diagnostics& diagnostics) {
    const Scene scene = source.load(diagnostics);
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, "", diagnostics);
    SceneBench bench(settings, native, opencl, flat, camera);
    SceneResult result;
    result.name = source.name;
    result.triangles = flat.triangles.size();
    result.bvh_nodes = native.bvh()->nodes;
    result.bvh_ms = native.bvh()->build_ms;
    result.sah_cost = native.bvh()->sah_cost;
    print(table_heading(result));
    bench.run(result.sets, [](const SetResult& set) { print(table_row(set)); });
    return result;
}

void run(const Settings& settings) {
    const auto limit = limit_threads(settings.threads);
    const auto opencl = open_opencl(settings.device, settings.threads);
    const auto native = make_native_executor(NativeTraversal::own_bvh, settings.threads);
    nlohmann::json json{{"benchmark", "rays"},
                        {"quick", settings.quick},
                        {"repetitions", settings.runs()},
                        {"machine", machine_json(settings.threads)},
                        {"versions", versions_json()},
                        {"native", device_json(*native)},
                        {"opencl", opencl ? device_json(*opencl) : nlohmann::json()}};
    if (!opencl) print("No OpenCL device was found: its column stays empty.\n");
    print(table_legend());
    Diagnostics diagnostics;
    std::vector<SceneResult> results;
    for (const BenchScene& scene :
         bench_scenes(settings.scenes, {"cornell-box", "sibenik", "conference"}, settings.quick)) {
        if (!settings.wants_scene(scene.name)) continue;
        results.push_back(run_scene(settings, scene, *native, opencl.get(), diagnostics));
        json["scenes"].push_back(scene_json(results.back()));
    }
    if (results.empty()) throw Error(ExitCode::usage, "--only names no scene that is there");
    json["summary"] = summary_json(results);
    print("\n" + json["summary"].dump(2) + "\n");
    if (!settings.json.empty()) write_json(settings.json, json);
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("rays", [&] {
        int status = 0;
        const auto settings = parse(argc, argv, status);
        if (settings) run(*settings);
        return status;
    });
}
