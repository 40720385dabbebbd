// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Adaptive interleaved sampling against the same with every level at its maximum and against
// instant global illumination: speed and errors in one run. docs/benchmarks.md says how to read it.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "bench/common/adaptive_frames.h"
#include "bench/common/adaptive_report.h"
#include "bench/common/bench_scenes.h"
#include "bench/common/machine.h"
#include "bench/common/own_queries.h"
#include "bench/common/reference_pictures.h"
#include "bench/common/shared_scene.h"
#include "device/native/native_executor.h"
#include "frame/camera_params.h"
#include "image/exr.h"
#include "image/png.h"
#include "scene/flat_scene.h"
#include "scene/load_scene.h"
#include "schedule/quality.h"

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
    std::string references = WEFT_SOURCE_DIR "/build/references";
    std::string published = WEFT_SOURCE_DIR "/../shared/reference/tables.json";
    std::string pictures;
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
    [[nodiscard]] bool wants_filter(const char* name) const {
        return std::find(filters.begin(), filters.end(), name) != filters.end();
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
};

void add_options(CLI::App& app, Settings& settings) {
    app.add_flag("--quick", settings.quick,
                 "fewer scenes, a smaller picture, fewer runs, coarse references");
    app.add_option("--scenes", settings.scenes,
                   "folder of scenes, each DIR/NAME/NAME.xml, with fog NAME-fog.xml beside it");
    app.add_option("--json", settings.json, "write machine, versions, all figures and a summary");
    app.add_option("--threads", settings.threads, "threads of every method; 0: all")
        ->check(CLI::Range(0, static_cast<int>(limits::max_threads)));
    app.add_option("--backend", settings.backend, "what renders")
        ->check(CLI::IsMember({"opencl", "embree", "native"}));
    app.add_option("--device", settings.device, "OpenCL device; default: the first processor");
    app.add_option("--only", settings.only, "measure only the scenes of these names");
    app.add_option("--size", settings.size, "width and height of the picture")
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
    app.add_option("--references", settings.references, "folder of path-traced references");
    app.add_option("--reference-spp", settings.reference_spp, "samples of references to make")
        ->check(CLI::Range(1U, limits::max_samples_per_pixel));
    app.add_option("--filters", settings.filters, "compare with references of these filters only")
        ->check(CLI::IsMember({"box", "centre"}));
    app.add_flag("--no-errors", settings.without_errors, "times alone, without references");
    app.add_option("--pictures", settings.pictures, "folder to write all pictures to");
    app.add_option("--published", settings.published,
                   "JSON file of published figures to print beside these");
}

std::optional<Settings> parse(int argc, char** argv, int& status) {
    Settings settings;
    CLI::App app{"Adaptive sampling against full density and instant global illumination"};
    add_options(app, settings);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        status = app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
        return std::nullopt;
    }
    return settings;
}

void print(const std::string& text) {
    fmt::print("{}", text);
    std::fflush(stdout);
}

struct Source {
    BenchScene scene;
    bool shipped = false;
};

/// The scene files that are there, then those that come with Weft; not both where it is to be
/// quick.
std::vector<Source> wanted_scenes(const Settings& settings) {
    std::vector<Source> sources;
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
    std::erase_if(sources, [&](const Source& s) { return !settings.wants(s.scene.name); });
    if (sources.empty()) throw Error(ExitCode::usage, "--only names no scene that is there");
    return sources;
}

/// Where there are media, path tracing has their light in other layers: only beauty is compared.
LayerErrors layer_errors(const Image& reference, const Image& test, bool components_visible,
                         bool media) {
    const ErrorChoice whole{true, true};
    const ErrorChoice part{components_visible, false};
    if (media) return {picture_errors(reference, test, "", whole), {}, {}};
    return {picture_errors(reference, test, "", whole),
            picture_errors(reference, test, "indirect", part),
            picture_errors(reference, test, "direct", part)};
}

/// The picture, for the screen with this exposure and as it is.
void write_picture(const Settings& settings, const AdaptiveScene& scene, const std::string& name,
                   const Image& image, double exposure) {
    const fs::path folder = settings.pictures;
    std::error_code error;
    fs::create_directories(folder, error);
    write_png(folder / (scene.name + "-" + name + ".png"), image, exposure);
    write_exr(folder / (scene.name + "-" + name + ".exr"), image);
}

void write_pictures(const Settings& settings, const AdaptiveScene& scene) {
    if (settings.pictures.empty()) return;
    const double exposure = auto_exposure(scene.frames.find(method_amax)->image);
    for (const MethodFrames& method : scene.frames.methods)
        write_picture(settings, scene, method.name, method.image, exposure);
}

void compare(const Settings& settings, const FlatScene& flat, const Camera& camera,
             Executor& path_executor, AdaptiveScene& scene) {
    SharedScene shared(path_executor);
    ReferencePictures references(settings.references, shared,
                                 [](const std::string& text) { print(text + "\n"); });
    const std::vector<MethodFrames>& methods = scene.frames.methods;
    scene.errors.resize(methods.size());
    for (const bool centre : {false, true}) {
        const ReferenceWish wish{scene.name, settings.frames().size, centre, settings.spp()};
        if (!settings.wants_filter(wish.filter())) continue;
        const Reference reference = references.find(flat, camera, wish);
        scene.references[wish.filter()] = reference.json();
        for (std::size_t m = 0; m < methods.size(); ++m) {
            MethodErrors& errors = scene.errors[m];
            (centre ? errors.centre : errors.box) =
                layer_errors(reference.image, methods[m].image, !centre, scene.media);
        }
        if (!settings.pictures.empty())
            write_picture(settings, scene, std::string("reference-") + wish.filter(),
                          reference.image, auto_exposure(scene.frames.find(method_amax)->image));
    }
}

AdaptiveScene run_scene(const Settings& settings, const Source& source, Executor& executor,
                        Executor& path_executor, Diagnostics& diagnostics) {
    const Scene scene = source.scene.load(diagnostics);
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, "", diagnostics);
    AdaptiveScene result;
    result.name = source.scene.name;
    result.shipped = source.shipped;
    result.media = flat.media.present();
    result.triangles = flat.triangles.size();
    {
        SharedScene shared(executor);
        result.frames = measure_frames(shared, flat, camera, settings.methods(), settings.frames());
    }
    write_pictures(settings, result);
    if (!settings.without_errors) compare(settings, flat, camera, path_executor, result);
    return result;
}

/// Published figures, or null where the file is not there.
nlohmann::json read_published(const std::string& file) {
    constexpr std::size_t most_bytes = std::size_t{1} << 20;
    if (!fs::is_regular_file(file)) return {};
    const std::vector<std::byte> bytes = read_file(file, most_bytes);
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    auto json = nlohmann::json::parse(text, text + bytes.size(), nullptr, false);
    if (!json.is_object()) throw input_error(file, "is no JSON object, expected published tables");
    return json;
}

void run(const Settings& settings) {
    // Before anything else: BVH builders and Embree would start a worker per core.
    std::optional<tbb::global_control> limit;
    if (settings.threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism,
                      static_cast<std::size_t>(settings.threads));
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
    for (const Source& source : wanted_scenes(settings)) {
        scenes.push_back(run_scene(settings, source, *executor, *path_executor, diagnostics));
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
    int status = 0;
    try {
        const auto settings = parse(argc, argv, status);
        if (settings) run(*settings);
        return status;
    } catch (const Error& error) {
        fmt::print(stderr, "bench adaptive: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "bench adaptive: out of memory\n");
        return static_cast<int>(ExitCode::out_of_memory);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench adaptive: {}\n", error.what());
        return static_cast<int>(ExitCode::device);
    }
}
