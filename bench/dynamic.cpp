// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Sequences of frames in which things happen: indirect light by virtual lights, by records made for
// each frame, and by records that outlast their frame; times, rays, records, errors and flicker in
// one run. docs/benchmarks.md says how to read it.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "base/stopwatch.h"
#include "bench/common/bench_scenes.h"
#include "bench/common/dynamic_sequences.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/common/picture_errors.h"
#include "device/native/native_executor.h"
#include "frame/camera_params.h"
#include "frame/renderer.h"
#include "metrics/flicker.h"
#include "scene/load_scene.h"
#include "scene/pose_scene.h"

namespace {

using namespace weft;
using namespace weft::bench;
namespace fs = std::filesystem;

struct Settings {
    bool quick = false;
    std::string scenes = WEFT_SOURCE_DIR "/../shared/data/scenes";
    std::string json;
    std::string backend = "opencl";
    int threads = 0;
    std::uint32_t size = 0;    ///< 0: by `quick`
    std::uint32_t frames = 0;  ///< 0: by `quick`
    std::vector<std::string> only;

    [[nodiscard]] std::uint32_t edge() const { return size > 0 ? size : quick ? 128U : 512U; }
    [[nodiscard]] std::uint32_t count() const { return frames > 0 ? frames : quick ? 5U : 12U; }
    [[nodiscard]] bool wants(const std::string& name) const {
        return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
    }
};

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app{"Frames in which things happen: instant and temporal instant caching"};
    app.add_flag("--quick", settings.quick, "a smaller picture, fewer frames");
    app.add_option("--scenes", settings.scenes, "folder of scenes, each DIR/NAME/NAME.xml");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--threads", settings.threads, "threads; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--backend", settings.backend, "what renders")
        ->check(CLI::IsMember({"opencl", "embree", "native"}));
    app.add_option("--only", settings.only, "measure only the scenes of these names");
    app.add_option("--size", settings.size, "width and height of the picture")
        ->check(CLI::Range(16, 4096));
    app.add_option("--frames", settings.frames, "frames of every sequence")
        ->check(CLI::Range(3, 1000));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        status = app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
        return std::nullopt;
    }
    return settings;
}

/// What is compared.
struct Method {
    const char* name;
    Algorithm algorithm;
    bool masks = true;
    bool fresh = false;  ///< other random numbers in every frame
};

constexpr Method methods[] = {{"igi", Algorithm::igi, true, true},
                              {"ic", Algorithm::ic},
                              {"tic", Algorithm::tic},
                              {"tic, no masks", Algorithm::tic, false}};

/// Indirect light alone: all else is the same.
RenderSettings settings_of(const Method& method, std::uint32_t edge) {
    RenderSettings settings;
    settings.algorithm = method.algorithm;
    settings.width = settings.height = edge;
    settings.sampling.cache_masks = method.masks;
    settings.direct = false;
    return settings;
}

/// A method over the frames of a sequence.
struct Run {
    Method method;
    std::unique_ptr<Renderer> renderer;
    std::vector<double> ms{};
    std::vector<std::uint64_t> rays{};  ///< for indirect light, without primary rays
    std::vector<CacheStats> records{};
    std::vector<Image> images{};

    [[nodiscard]] double median_ms() const {
        std::vector<double> later(ms.begin() + 1, ms.end());
        std::nth_element(later.begin(),
                         later.begin() + static_cast<std::ptrdiff_t>(later.size() / 2),
                         later.end());
        return later[later.size() / 2];
    }
    [[nodiscard]] double mean_rays() const {
        return static_cast<double>(
                   std::accumulate(rays.begin() + 1, rays.end(), std::uint64_t{0})) /
               static_cast<double>(rays.size() - 1);
    }
};

void render(Run& run, Executor& executor, const FlatScene& flat, const Camera& camera,
            std::uint32_t edge, std::uint32_t frame) {
    RenderSettings settings = settings_of(run.method, edge);
    if (run.method.fresh) {
        settings.seed = frame;
        run.renderer = std::make_unique<Renderer>(executor, flat, camera, settings);
    } else if (!run.renderer) {
        run.renderer = std::make_unique<Renderer>(executor, flat, camera, settings);
    } else {
        // The tree of what moves is the same work for all methods, and not timed.
        run.renderer->update_scene();
        run.renderer->move_camera(camera);
    }
    const weft::Stopwatch watch;
    (void)run.renderer->render_frame({});
    const FrameStats& stats = run.renderer->stats().back();
    run.ms.push_back(watch.total());
    run.rays.push_back(stats.rays - std::uint64_t{edge} * edge);
    if (stats.cache) run.records.push_back(*stats.cache);
    run.images.push_back(run.renderer->image());
}

/// Excess change of the last frames in units of PU21: mean over pixels that both show.
double flicker(const Run& run, const Run& reference, const DynamicSequence& sequence) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t f = 1; f < run.images.size(); ++f) {
        const auto frame = static_cast<std::uint32_t>(f);
        const Camera before = sequence.camera_at(frame - 1);
        const Camera now = sequence.camera_at(frame);
        const std::vector<std::uint32_t> matches =
            matching_pixels({reference.images[f - 1], before}, {reference.images[f], now});
        constexpr double display = 100.0;
        for (const float excess :
             excess_change(run.images[f - 1], run.images[f], reference.images[f - 1],
                           reference.images[f], matches, display)) {
            if (!std::isfinite(excess)) continue;
            sum += static_cast<double>(excess);
            ++count;
        }
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// What the middle of the picture shows, scene units: asked of a picture of one pixel.
glm::dvec3 middle_of_view(const FlatScene& flat, const Camera& camera) {
    const auto executor = make_native_executor(NativeTraversal::own_bvh, 1);
    RenderSettings settings = settings_of({"ir", Algorithm::ir}, 1);
    settings.indirect = false;
    Renderer renderer(*executor, flat, camera, settings);
    (void)renderer.render_frame({});
    const Image image = renderer.image();
    const double depth = static_cast<double>(image.find("depth")->values.at(0));
    const glm::dvec3 eye(camera.to_world[3]);
    const double far = depth > 0.0 && std::isfinite(depth) ? depth : 1.0 / flat.units.scale;
    return eye - glm::normalize(glm::dvec3(camera.to_world[2])) * far;
}

nlohmann::json run_sequence(const Settings& settings, const std::string& name, const Scene& scene,
                            Happening happening, Executor& executor, Diagnostics& diagnostics) {
    const FlatScene still = flatten(scene);
    const Camera camera = choose_camera(scene, still, "", diagnostics);
    DynamicSequence sequence(scene, camera, middle_of_view(still, camera), happening);
    FlatScene flat = flatten(sequence.at(0));
    std::vector<Run> runs;
    for (const Method& method : methods) runs.push_back({method, nullptr});
    Run reference{{"ir", Algorithm::ir}, nullptr};
    for (std::uint32_t frame = 0; frame < settings.count(); ++frame) {
        update_flat(sequence.at(frame), flat);
        for (Run& run : runs)
            render(run, executor, flat, sequence.camera_at(frame), settings.edge(), frame);
        render(reference, executor, flat, sequence.camera_at(frame), settings.edge(), frame);
    }
    nlohmann::json json{{"scene", name}, {"happening", to_string(happening)}};
    for (const Run& run : runs) {
        const PictureErrors errors =
            picture_errors(reference.images.back(), run.images.back(), "indirect", {true, false});
        const double excess = flicker(run, reference, sequence);
        nlohmann::json row{{"method", run.method.name}, {"ms", run.median_ms()},
                           {"frame_ms", run.ms},        {"rays", run.mean_rays()},
                           {"frame_rays", run.rays},    {"flicker", excess},
                           {"errors", errors.json()}};
        for (const CacheStats& cache : run.records)
            row["records"].push_back({{"kept", cache.kept},
                                      {"updated", cache.updated},
                                      {"dropped", cache.dropped},
                                      {"made", cache.made},
                                      {"bytes", cache.bytes}});
        fmt::print("{:>12} {:>7} {:>14} {:>9.1f} {:>12.0f} {:>9.2f} {:>9.2f} {:>9.5f} {:>9.4f}\n",
                   name, to_string(happening), run.method.name, run.median_ms(), run.mean_rays(),
                   errors.published ? errors.published->p75 : 0.0,
                   errors.display ? errors.display->p75 : 0.0, errors.relmse.value_or(0.0), excess);
        std::fflush(stdout);
        json["methods"].push_back(row);
    }
    return json;
}

/// Mean over sequences of one method's figure over another's.
double ratio(const nlohmann::json& sequences, std::size_t above, std::size_t below, const char* key,
             const std::string& happening) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const nlohmann::json& sequence : sequences) {
        if (!happening.empty() && sequence["happening"] != happening) continue;
        const double a = sequence["methods"][above][key];
        const double b = sequence["methods"][below][key];
        if (!(b > 0.0)) continue;
        sum += a / b;
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

void run(const Settings& settings) {
    std::optional<tbb::global_control> limit;
    if (settings.threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism,
                      static_cast<std::size_t>(settings.threads));
    const auto executor = open_backend(settings.backend, "", settings.threads);
    nlohmann::json json{{"benchmark", "dynamic"},
                        {"quick", settings.quick},
                        {"size", settings.edge()},
                        {"frames", settings.count()},
                        {"machine", machine_json(settings.threads)},
                        {"versions", versions_json()},
                        {"device", device_json(*executor)}};
    fmt::print("{:>12} {:>7} {:>14} {:>9} {:>12} {:>9} {:>9} {:>9} {:>9}\n", "scene", "what",
               "method", "ms", "rays", "VDP 75 %", "display", "relMSE", "flicker");
    Diagnostics diagnostics;
    for (const BenchScene& source : bench_scenes(
             settings.scenes, {"cornell-box", "office", "desk", "conference", "sibenik"}, true)) {
        if (source.file.empty() || !settings.wants(source.name)) continue;
        Scene scene = source.load(diagnostics);
        hold_still(scene);
        for (const Happening happening : all_happenings())
            json["sequences"].push_back(
                run_sequence(settings, source.name, scene, happening, *executor, diagnostics));
    }
    if (!json.contains("sequences"))
        throw Error(ExitCode::usage, "no scene is there, expected --scenes to name a folder");
    const nlohmann::json& all = json["sequences"];
    json["summary"] = {{"ic_vs_igi", ratio(all, 0, 1, "ms", "still")},
                       {"tic_vs_ic_rays", ratio(all, 1, 2, "rays", "box")},
                       {"tic_vs_ic_ms", ratio(all, 1, 2, "ms", "box")},
                       {"tic_vs_igi_ms", ratio(all, 0, 2, "ms", "")},
                       {"flicker_tic_vs_igi", ratio(all, 2, 0, "flicker", "")}};
    fmt::print("\n{}\n", json["summary"].dump(2));
    if (!settings.json.empty()) write_json(settings.json, json);
}

}  // namespace

int main(int argc, char** argv) {
    int status = 0;
    try {
        const auto settings = parse(argc, argv, status);
        if (settings) run(*settings);
        return status;
    } catch (const Error& error) {
        fmt::print(stderr, "bench dynamic: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "bench dynamic: out of memory\n");
        return static_cast<int>(ExitCode::out_of_memory);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench dynamic: {}\n", error.what());
        return static_cast<int>(ExitCode::device);
    }
}
