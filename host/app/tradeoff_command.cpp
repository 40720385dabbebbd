// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "app/choose_executor.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/print.h"
#include "app/thread_limit.h"
#include "app/tradeoff_options.h"
#include "base/quote.h"
#include "device/native/embree_scene.h"
#include "device/native/native_executor.h"
#include "device/shared_scene.h"
#include "image/png.h"
#include "render/camera_params.h"
#include "render/renderer.h"
#include "scene/load/load_scene.h"
#include "scene/pose_scene.h"
#include "tradeoff/advice.h"
#include "tradeoff/error_values.h"
#include "tradeoff/measure_points.h"
#include "tradeoff/other_renderers.h"
#include "tradeoff/reference_files.h"
#include "tradeoff/reference_images.h"
#include "tradeoff/thumbnail.h"
#include "tradeoff/time_spread.h"
#include "tradeoff/tradeoff_files.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t check_rounds = 3;
// Approximate shares of the parts of a run in its time.
constexpr double reference_share = 0.3;
constexpr double measuring_share = 0.6;

[[noreturn]] void end_interrupted() {
    throw Error(ExitCode::interrupted,
                "interrupted, nothing was written; the reference is kept for next time");
}

Scene resting_scene(const TradeoffOptions& options, Diagnostics& diagnostics) {
    Scene scene = load_scene(options.scene, diagnostics, options.reading);
    hold_still(scene);
    return scene;
}

/// The options with the values that were chosen where the user gave none.
TradeoffOptions completed(TradeoffOptions options, const Scene& scene) {
    constexpr FilmSize standard{512, 512};
    if (!options.size) options.size = scene.film.value_or(standard);
    if (options.budgets_ms.empty()) options.budgets_ms = {100.0, 300.0, 1000.0};
    check_comparable(*options.size);
    return options;
}

/// The folder where references are kept. Where the cache folder cannot be written to, it lies in
/// the output folder.
fs::path references_folder(const TradeoffOptions& options, Diagnostics& diagnostics) {
    if (options.references) return *options.references;
    fs::path folder = default_references_folder();
    if (!folder.empty()) {
        try {
            prepare_folder(folder);
            return folder;
        } catch (const Error& error) {
            diagnostics.warn("", std::string(error.what()) + "; the reference is kept in " +
                                     quote(options.output.string()));
        }
    }
    return options.output / "references";
}

std::unique_ptr<Executor> executor_of(const TradeoffOptions& options, Diagnostics& diagnostics) {
    RenderOptions choice;
    choice.backend = options.backend;
    choice.device = options.device;
    choice.threads = options.threads;
    return choose_executor(choice, diagnostics);
}

nlohmann::json machine_of(const Executor& executor, const TradeoffOptions& options) {
    const DeviceInfo& device = executor.device();
    const std::uint32_t processors = std::max(1U, std::thread::hardware_concurrency());
    return {{"processor", native_device_info(NativeTraversal::own_bvh).name},
            {"threads", std::min(options.threads.value_or(processors), processors)},
            {"backend", device.backend},
            {"device", device.name},
            {"driver", device.driver},
            {"device_version", device.version},
            {"lanes", executor.lanes()},
            {"weft", WEFT_VERSION},
            {"embree", embree_version()},
            {"compiler", __VERSION__}};
}

/// What removes noise here: Open Image Denoise last, and only where it is installed.
std::vector<ImageDenoiser> all_denoisers() {
    std::vector<ImageDenoiser> all;
    all.emplace_back(Denoiser::statistical);
    try {
        all.emplace_back(Denoiser::oidn);
    } catch (const Error&) {
        // It is optional: the settings that need it are left out.
    }
    return all;
}

/// One run of the command: renders, and lets host/tradeoff decide what.
class TradeoffRun {
  public:
    TradeoffRun(const TradeoffOptions& options, const Scene& scene, Diagnostics& diagnostics)
        : options_(completed(options, scene)),
          flat_(flatten(scene)),
          camera_(choose_camera(scene, flat_, options.camera.value_or(""), diagnostics)),
          references_(references_folder(options, diagnostics)),
          progress_(options.progress, stderr),
          executor_(executor_of(options, diagnostics)),
          shared_(*executor_) {
        if (flat_.lights.empty() && !(flat_.media.radiance > 0.0))
            throw input_error(scene.source, "no light shines in the scene, expected one that does");
        // An automatic camera of a scene without cameras cannot be chosen by name.
        if (!scene.cameras.empty()) options_.camera = camera_.name;
    }

    TradeoffResult run() {
        // Errors should be found before the reference is rendered, which may take hours.
        const std::vector<Candidate> all = candidates();
        describe();
        read_others();
        make_reference();
        judge_others();
        measure(all);
        advise();
        finish_front();
        progress_.finish();
        return std::move(result_);
    }

  private:
    void describe() {
        result_.scene = options_.scene.filename().string();
        result_.scene_path = options_.scene.string();
        result_.folder = options_.output.string();
        result_.width = options_.size->width;
        result_.height = options_.size->height;
        result_.repetitions = options_.repetitions;
        result_.measure = options_.measure;
        result_.machine = machine_of(*executor_, options_);
        result_.command = tradeoff_command_line(options_);
        result_.image_options = tradeoff_image_options(options_);
    }

    void read_others() {
        if (!options_.others) return;
        OtherRenderers others = read_other_renderers(*options_.others, *options_.size);
        result_.others = std::move(others.images);
        result_.other_notes = std::move(others.notes);
    }

    void judge_others() {
        const Measuring how = measuring();
        for (OtherRendererPoint& other : result_.others) {
            how.report(1.0, "images of others");
            other.errors = how.judge(other.image);
            other.unbiased_relmse = how.unbiased(other.image);
            // The page shows no more than this; whole images would take memory from measurements.
            other.image = scaled_down(other.image, thumbnail_edge);
        }
    }

    void make_reference() {
        constexpr std::size_t longest_name = 64;
        progress_.begin_part(0.0, reference_share);
        ReferenceImages images(
            references_, shared_, [](const std::string&) {},
            [&](double done) {
                progress_.update(done, "reference");
                return !interrupt_flag();
            });
        ReferenceWish wish;
        wish.scene = options_.scene.stem().string().substr(0, longest_name);
        wish.size = result_.width;
        wish.height = result_.height;
        wish.spp = options_.reference_spp;
        wish.with_halves = true;
        if (!options_.reference_spp_given) wish.enough = good_floor;
        Reference found = images.find(flat_, camera_, wish);
        TradeoffReference& reference = result_.reference;
        reference.samples = found.samples;
        reference.image = layer_as_beauty(found.image, "");
        reference.noise_floor = error_values(layer_as_beauty(found.image, first_half_layer),
                                             layer_as_beauty(found.image, second_half_layer));
        halves_ = std::move(found.image);
        std::erase_if(halves_.layers, [](const Layer& layer) {
            return layer.name != first_half_layer && layer.name != second_half_layer;
        });
        reference.noise_relmse = noise_relmse_of(halves_);
        result_.exposure_ev = auto_exposure(reference.image);
    }

    [[nodiscard]] std::vector<Candidate> candidates() const {
        SweepScene requested = sweep_scene(plan_for(flat_, RenderSettings{}));
        requested.oidn = denoisers_.size() > 1;
        std::vector<Candidate> all =
            settings_sweep(requested, options_.quick ? SweepSize::quick : SweepSize::full);
        const std::vector<std::string>& wanted = options_.algorithms;
        if (!wanted.empty())
            std::erase_if(all, [&](const Candidate& candidate) {
                return std::find(wanted.begin(), wanted.end(), candidate.family) == wanted.end();
            });
        if (all.empty())
            throw usage_error(
                "--algorithms: names none that this scene needs in this sweep, expected others");
        return all;
    }

    [[nodiscard]] MeasurePlan plan() const {
        // With more samples than the reference has, its noise would dominate the error.
        return {.repetitions = options_.repetitions,
                .seed = options_.seed,
                .wish = {options_.budgets_ms, options_.reference_spp}};
    }

    Measuring measuring() {
        return {
            .make =
                [this](const Preset& preset, std::uint32_t seed, bool first_alone) {
                    const ImageSubject subject{
                        shared_,   flat_, camera_, *options_.size, [] { return !interrupt_flag(); },
                        denoisers_};
                    MeasuredImage made = measure_image(subject, preset, seed, first_alone);
                    if (interrupt_flag()) end_interrupted();
                    return made;
                },
            .judge =
                [this](const Image& image) { return error_values(result_.reference.image, image); },
            .report =
                [this](double done, const std::string& what) {
                    if (interrupt_flag()) end_interrupted();
                    progress_.update(done, what);
                },
            .unbiased = [this](const Image& image) { return unbiased_value(halves_, image); }};
    }

    void measure(const std::vector<Candidate>& all) {
        progress_.begin_part(reference_share, measuring_share);
        result_.points = measure_points(all, plan(), measuring(), result_.skipped);
        if (result_.points.empty())
            throw Error(ExitCode::device,
                        "every setting takes too long on this device, expected a smaller --size");
        result_.time_spread = time_spread(result_.points);
        mark_front(result_.points, result_.measure);
    }

    void advise() {
        if (options_.errors.empty())
            options_.errors = sensible_errors(result_.points, result_.measure);
        for (const double budget : options_.budgets_ms)
            result_.advice.push_back(advice_for_budget(result_.points, result_.measure, budget));
        for (const double error : options_.errors)
            result_.advice.push_back(advice_for_error(result_.points, result_.measure, error));
        const double floor = error_of(result_.reference.noise_floor, result_.measure);
        for (TradeoffAdvice& advice : result_.advice)
            add_noise_note(advice, result_.points, result_.measure, floor);
    }

    /// Renders the images of the front again, since images were not kept while measuring: the same
    /// seeds give the same bits.
    void finish_front() {
        const double begin = reference_share + measuring_share;
        progress_.begin_part(begin, 1.0 - begin);
        const Measuring how = measuring();
        for (TradeoffPoint& point : result_.points) {
            if (!point.on_front) continue;
            how.report(0.0, "image of " + point.name);
            point.image = how.make(point.preset, image_seed(options_.seed, 0), false).image;
            point.error_map = error_map(result_.reference.image, point.image);
        }
        if (options_.verify)
            result_.check = check_front(result_.points, result_.measure, plan(), how, check_rounds);
    }

    TradeoffOptions options_;
    FlatScene flat_;
    Camera camera_;
    fs::path references_;
    Progress progress_;
    std::unique_ptr<Executor> executor_;
    SharedScene shared_;
    std::vector<ImageDenoiser> denoisers_ = all_denoisers();
    Image halves_;  ///< of the reference, without other layers
    TradeoffResult result_;
};

}  // namespace

void tradeoff_command(const TradeoffOptions& options, Diagnostics& diagnostics) {
    InterruptGuard guard("weft: interrupted, nothing was written");
    const ThreadLimit limit(options.threads);
    prepare_folder(options.output);
    const Scene scene = resting_scene(options, diagnostics);
    guard.keep_work();
    TradeoffRun run(options, scene, diagnostics);
    print_warnings(diagnostics, options.verbose);
    const TradeoffResult result = run.run();
    write_tradeoff(options.output, result);
    print_result(tradeoff_text(result));
}

}  // namespace weft
