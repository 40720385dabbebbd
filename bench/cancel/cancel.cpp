// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// This measures how long a session takes to end once it is cancelled: from RenderSession::cancel at
// random moments to the return of RenderSession::render, by algorithm and backend.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "base/diagnostics.h"
#include "base/error.h"
#include "base/limits.h"
#include "base/stopwatch.h"
#include "bench/common/bench_main.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "plan/algorithm.h"
#include "plan/quality.h"
#include "render/camera_params.h"
#include "scene/load/load_scene.h"
#include "session/render_session.h"

namespace {

using namespace weft;
using namespace weft::bench;

struct Settings {
    bool quick = false;
    std::string scene = WEFT_SOURCE_DIR "/scenes/conference.gltf";
    std::string json;
    std::string device;
    int threads = 0;
    std::uint32_t size = 512;
    std::uint32_t points = 0;  ///< 0: by `quick`
    std::vector<std::string> backends{"opencl", "embree"};
    std::vector<std::string> algorithms{"ais", "amax", "igi", "ir", "irradiance-cache",
                                        "ic",  "tic",  "path"};

    [[nodiscard]] std::uint32_t point_count() const { return points > 0 ? points : quick ? 8 : 60; }
};

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app("Times from a request to cancel to the end of rendering", "cancel");
    app.add_flag("--quick", settings.quick, "fewer moments");
    app.add_option("--scene", settings.scene, "scene file");
    app.add_option("--json", settings.json, "write machine, versions and all figures");
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--threads", settings.threads, "threads; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--size", settings.size, "width and height of the image")
        ->check(CLI::Range(16, 4096));
    app.add_option("--points", settings.points, "moments at which each algorithm is cancelled");
    app.add_option("--backends", settings.backends, "what renders")
        ->check(CLI::IsMember({"opencl", "embree", "native"}));
    app.add_option("--algorithms", settings.algorithms, "only these")
        ->check(CLI::IsMember(Settings{}.algorithms));
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return {};
    }
    return settings;
}

ImageSettings image_settings(const std::string& algorithm, std::uint32_t size) {
    if (algorithm == "path") {
        PathSettings path;
        path.width = path.height = size;
        path.samples = {0, limits::max_samples_per_pixel};
        return path;
    }
    RenderSettings preview;
    preview.width = preview.height = size;
    preview.samples = 16;
    for (const Algorithm known : {Algorithm::ais, Algorithm::amax, Algorithm::igi, Algorithm::ir,
                                  Algorithm::irradiance_cache, Algorithm::ic, Algorithm::tic})
        if (to_string(known) == algorithm) preview.algorithm = known;
    preview.sampling = preview.algorithm == Algorithm::ais
                           ? sampling_of_image(Quality::preview, false)
                           : sampling_of(Quality::preview);
    preview.sampling.cached = caches_indirect(preview.algorithm, IndirectSource::vpl);
    preview.sampling.temporal = preview.algorithm == Algorithm::tic;
    return preview;
}

/// The value below which that share of all lie.
double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const auto last = static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(std::ceil(share * last))];
}

struct Latencies {
    double frame_ms = 0.0;   ///< of a frame that nobody cancels
    std::vector<double> ms;  ///< from each request to the end
};

/// Cancels rendering at random moments within the time of two first frames, or 50 ms if that is
/// longer.
Latencies measure(RenderSession& session, std::uint32_t points) {
    Latencies found;
    RenderBudget whole;
    whole.samples = 2;
    whole.time_ms = 1.0;
    // What is compiled at the first launch is not cancelled.
    (void)session.render(whole);
    session.set_camera(session.camera());
    const weft::Stopwatch frame;
    (void)session.render(whole);
    found.frame_ms = frame.total();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> moments(0.0, 2.0 * std::max(found.frame_ms, 25.0));
    RenderBudget endless;
    endless.samples = limits::max_samples_per_pixel;
    for (std::uint32_t point = 0; point < points; ++point) {
        session.set_camera(session.camera());
        std::promise<void> begun;
        std::promise<std::chrono::steady_clock::time_point> ended;
        std::thread renders([&] {
            begun.set_value();
            try {
                (void)session.render(endless);
                ended.set_value(std::chrono::steady_clock::now());
            } catch (...) {
                ended.set_exception(std::current_exception());
            }
        });
        begun.get_future().wait();
        std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(moments(random)));
        const auto requested = std::chrono::steady_clock::now();
        session.cancel();
        renders.join();
        const auto end = ended.get_future().get();
        found.ms.push_back(std::chrono::duration<double, std::milli>(end - requested).count());
    }
    return found;
}

nlohmann::json row_json(const std::string& backend, const std::string& algorithm,
                        const Latencies& found) {
    return {{"backend", backend},
            {"algorithm", algorithm},
            {"frame_ms", found.frame_ms},
            {"median_ms", quantile(found.ms, 0.5)},
            {"p95_ms", quantile(found.ms, 0.95)},
            {"most_ms", quantile(found.ms, 1.0)},
            {"latencies_ms", found.ms}};
}

void run(const Settings& settings) {
    const auto limit = limit_threads(settings.threads);
    nlohmann::json rows = nlohmann::json::array();
    const std::string scene_name = std::filesystem::path(settings.scene).filename().string();
    print(fmt::format("{} at {}x{}, cancelled {} times each, milliseconds\n", scene_name,
                      settings.size, settings.size, settings.point_count()));
    print(fmt::format("{:<9}{:<18}{:>9}{:>9}{:>9}{:>9}\n", "backend", "algorithm", "frame",
                      "median", "95 %", "most"));
    for (const std::string& backend : settings.backends) {
        Diagnostics diagnostics;
        MovingScene scene(load_scene(settings.scene, diagnostics), {}, 30.0);
        const Camera camera = choose_camera(scene.at_rest(), scene.flat(), "", diagnostics);
        RenderSession session(open_backend(backend, settings.device, settings.threads),
                              std::move(scene), camera,
                              image_settings(settings.algorithms.front(), settings.size));
        for (const std::string& algorithm : settings.algorithms) {
            session.set_settings(image_settings(algorithm, settings.size));
            const Latencies found = measure(session, settings.point_count());
            rows.push_back(row_json(backend, algorithm, found));
            const nlohmann::json& row = rows.back();
            print(fmt::format("{:<9}{:<18}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}\n", backend, algorithm,
                              found.frame_ms, row["median_ms"].get<double>(),
                              row["p95_ms"].get<double>(), row["most_ms"].get<double>()));
        }
    }
    if (settings.json.empty()) return;
    write_json(settings.json, {{"benchmark", "cancel"},
                               {"machine", machine_json(settings.threads)},
                               {"versions", versions_json()},
                               {"scene", scene_name},
                               {"size", settings.size},
                               {"points", settings.point_count()},
                               {"rows", rows}});
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("cancel", [&] {
        int status = 0;
        const auto settings = parse(argc, argv, status);
        if (settings) run(*settings);
        return status;
    });
}
