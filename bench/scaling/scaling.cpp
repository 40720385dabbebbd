// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// How the time of a frame and its error grow with triangles, pixels, VPLs, lights, threads and
// optical depth, next to the laws that they should follow. docs/benchmarks.md says how to read it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "bench/common/bench_main.h"
#include "bench/common/growing_report.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/common/references_folder.h"
#include "bench/scaling/scaling_report.h"
#include "device/native/native_executor.h"

namespace {

using namespace weft;
using namespace weft::bench;

const std::map<std::string, Algorithm> algorithms{{"ais", Algorithm::ais},
                                                  {"amax", Algorithm::amax},
                                                  {"igi", Algorithm::igi},
                                                  {"ir", Algorithm::ir},
                                                  {"ic", Algorithm::ic}};

struct Settings {
    bool quick = false;
    bool resume = false;
    bool without_errors = false;
    std::string json;
    std::string backend = "native";
    std::string device;
    std::string references = references_folder(WEFT_SOURCE_DIR).string();
    int threads = 0;
    std::uint32_t size = 0;           ///< 0: by `quick`
    std::uint32_t repetitions = 0;    ///< 0: by `quick`
    std::uint32_t reference_spp = 0;  ///< 0: by `quick`
    std::vector<std::string> only;
    std::vector<std::string> methods{"igi", "ais"};

    [[nodiscard]] bool wants(const std::string& axis) const {
        return only.empty() || std::find(only.begin(), only.end(), axis) != only.end();
    }
    [[nodiscard]] std::uint32_t image_size() const { return size > 0 ? size : quick ? 64 : 256; }
    [[nodiscard]] std::uint32_t most_threads() const {
        return threads > 0 ? static_cast<std::uint32_t>(threads)
                           : std::max(1U, std::thread::hardware_concurrency());
    }
    [[nodiscard]] ScalingRun run() const {
        ScalingRun run;
        for (const std::string& method : methods)
            run.methods.push_back({method, algorithms.at(method), {}});
        run.repetitions = repetitions > 0 ? repetitions : quick ? 3 : 9;
        run.references = references;
        const std::uint32_t usual = quick ? 32 : 1024;
        run.reference_spp = without_errors ? 0 : reference_spp > 0 ? reference_spp : usual;
        run.memory_bytes = available_memory();
        run.say = [](const std::string& text) { print(text + "\n"); };
        return run;
    }
};

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    std::vector<std::string> names;
    for (const auto& [name, algorithm] : algorithms) names.push_back(name);
    CLI::App app{"Time and error against triangles, pixels, VPLs, lights, threads, optical depth"};
    app.add_flag("--quick", settings.quick,
                 "small images, fewer points and runs, coarse references");
    app.add_option("--json", settings.json, "write machine, versions, all figures and laws");
    app.add_flag("--resume", settings.resume, "go on with the axes that the file lacks")
        ->needs("--json");
    app.add_option("--threads", settings.threads, "threads, and the most of that axis; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--backend", settings.backend, "what renders, but for the axis threads")
        ->check(CLI::IsMember({"opencl", "embree", "native"}));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--only", settings.only, "measure only these axes")
        ->check(CLI::IsMember(scaling_axis_names()));
    app.add_option("--methods", settings.methods, "algorithms to measure")
        ->check(CLI::IsMember(names));
    app.add_option("--size", settings.size, "width and height of the image")
        ->check(CLI::Range(16, 1024));
    app.add_option("--repetitions", settings.repetitions, "timed frames at every point")
        ->check(CLI::Range(1, 1000));
    app.add_option("--references", settings.references,
                   "folder of references, each with its halves");
    app.add_option("--reference-spp", settings.reference_spp, "samples of references to make")
        ->check(CLI::Range(2U, limits::max_samples_per_pixel));
    app.add_flag("--no-errors", settings.without_errors, "times alone, without references");
    if (const auto code = parse_arguments(app, argc, argv)) {
        status = *code;
        return std::nullopt;
    }
    return settings;
}

GrowingReport open_report(const Settings& settings, const ScalingRun& run,
                          const Executor& executor) {
    GrowingReport report(settings.json,
                         {{"benchmark", "scaling"},
                          {"quick", settings.quick},
                          {"size", settings.image_size()},
                          {"repetitions", run.repetitions},
                          {"warm_up", run.warm_up},
                          {"reference_spp", run.reference_spp},
                          {"methods", settings.methods},
                          {"machine", machine_json(settings.threads)},
                          {"versions", versions_json()},
                          {"device", device_json(executor)}},
                         "axes", scaling_summary);
    if (settings.resume)
        report.resume({"benchmark", "quick", "size", "repetitions", "reference_spp", "methods",
                       "versions", "device"});
    return report;
}

void run(const Settings& settings) {
    const auto limit = limit_threads(settings.threads);
    const auto executor = open_backend(settings.backend, settings.device, settings.threads);
    const auto path_executor = make_native_executor(NativeTraversal::own_bvh, settings.threads);
    const ScalingRun how = settings.run();
    GrowingReport report = open_report(settings, how, *executor);
    for (const ScalingAxis& axis :
         scaling_axes(settings.image_size(), settings.most_threads(), settings.quick)) {
        if (!settings.wants(axis.name) || report.has({{"axis", axis.name}})) continue;
        report.add(
            axis_json(axis, how.methods, measure_axis(axis, how, *executor, *path_executor)));
        print(axis_table(report.parts().back()));
    }
    print("\n" + report.summary().dump(2) + "\n");
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("scaling", [&] {
        int status = 0;
        const auto settings = parse(argc, argv, status);
        if (settings) run(*settings);
        return status;
    });
}
