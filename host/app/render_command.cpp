// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "app/choose_executor.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/frame_options.h"
#include "app/frame_time_warning.h"
#include "app/image_settings.h"
#include "app/interrupt.h"
#include "app/print.h"
#include "app/progress.h"
#include "app/stats_json.h"
#include "app/thread_limit.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/process_age.h"
#include "base/quote.h"
#include "base/stopwatch.h"
#include "denoise/image_denoiser.h"
#include "film/film_sums_file.h"
#include "image/exr.h"
#include "render/camera_params.h"
#include "render/camera_placement.h"
#include "scene/load/load_scene.h"
#include "scene/moving_scene.h"
#include "scene/pose_scene.h"
#include "session/file_output.h"
#include "session/render_session.h"
#include "tev/tev_watch.h"

namespace weft {
namespace {

void warn_about_nonfinite(const RenderSession& session, const RenderOptions& options,
                          std::uint32_t width, Diagnostics& diagnostics) {
    for (const NonfiniteSummary& found : session.stats().nonfinite()) {
        const std::string frame =
            options.frames ? fmt::format(" of frame {}", options.frames->first + found.first_image)
                           : "";
        diagnostics.warn(
            "", fmt::format("{} values of {} light were negative or not finite and count as black, "
                            "the first in sample {}{} at pixel ({}, {})",
                            found.count, found.component, found.first_sample, frame,
                            found.first_pixel % width, found.first_pixel / width));
    }
}

/// Says once that frames take longer than --frame-time allows, by the median of the last of them.
void warn_about_frame_time(const RenderSession& session, const RenderOptions& options,
                           Diagnostics& diagnostics) {
    if (!options.frame_seconds) return;
    const std::vector<FrameStats> frames(session.stats().last_frames().begin(),
                                         session.stats().last_frames().end());
    if (const auto warning = frame_time_warning(*options.frame_seconds * 1000.0, frames))
        diagnostics.warn("", *warning);
}

/// The options with the values that were chosen where the user gave none.
RenderOptions effective(const RenderOptions& options, const RenderSettings& settings,
                        const Camera& camera, const RenderSession& session) {
    RenderOptions used = options;
    const DeviceInfo& device = session.executor().device();
    used.backend = device.backend == "opencl"   ? Backend::opencl
                   : device.backend == "embree" ? Backend::embree
                                                : Backend::native;
    used.device = device.name;
    used.threads = usable_threads(used.threads.value_or(
        device.is_cpu ? device.compute_units : std::thread::hardware_concurrency()));
    used.size = FilmSize{settings.width, settings.height};
    if (!used.indirect)
        used.indirect = session.plan().bounce_rays ? IndirectSource::rays : IndirectSource::vpl;
    used.camera = camera.name;
    used.components.emplace();
    if (settings.direct) used.components->emplace_back("direct");
    if (settings.indirect) used.components->emplace_back("indirect");
    if (session.plan().reflection) used.components->emplace_back("reflection");
    if (session.plan().refraction) used.components->emplace_back("refraction");
    if (session.plan().glossy) used.components->emplace_back("glossy");
    if (session.plan().media_light) used.components->emplace_back("media");
    used.components->insert(used.components->end(), settings.requested.begin(),
                            settings.requested.end());
    if (!used.spp && session.samples() > 0)
        used.spp = static_cast<std::uint32_t>(session.samples());
    return used;
}

void write_stats(const RenderOptions& options, const nlohmann::json& stats) {
    if (!options.stats) return;
    const std::string text = json_document(stats);
    write_file_atomically(*options.stats, std::as_bytes(std::span(text)));
}

/// The part of `wanted` that the sums of `file` do not have yet. Throws Error (exit code 2) where
/// that is in several pieces, as after a merge of parts with others missing between them.
SampleRange missing(SampleRange wanted, const FilmSums& sums, const std::string& file) {
    for (const SampleRange& range : sums.ranges) {
        if (range.end <= wanted.first || range.first >= wanted.end) continue;
        if (range.first > wanted.first && range.end < wanted.end)
            throw input_error(
                file, fmt::format("lacks the samples {0}:{1} before others, expected a run with "
                                  "--samples {0}:{1} first, which adds them",
                                  wanted.first, range.first));
        if (range.first <= wanted.first)
            wanted.first = std::min(range.end, wanted.end);
        else
            wanted.end = range.first;
    }
    return wanted;
}

/// Warns where `added` samples of one backend are added to those of another.
void warn_about_backends(const FilmSums& sums, const std::string& backend, SampleRange added,
                         const std::string& file, Diagnostics& diagnostics) {
    if (added.first >= added.end || sums.backends.empty() ||
        sums.backends == std::set<std::string>{backend})
        return;
    diagnostics.warn(file, fmt::format("holds samples of {}, to which {} adds: the image is as "
                                       "good, but its last bits may be those of neither",
                                       backends_text(sums.backends), backend));
}

/// Writes the files of a command line, and records the time and shows the progress of that.
class CommandOutput : public FileOutput {
  public:
    CommandOutput(const RenderOptions& options, Progress& progress, Stopwatch& watch,
                  RunTimes& times, Diagnostics& diagnostics)
        : FileOutput({.file = options.output,
                      .exposure_ev = options.exposure_ev,
                      .tone = options.tone,
                      .background = options.background,
                      .overlays = options.overlays,
                      .sums = options.resume,
                      .save_interval_ms = 1000.0 * options.checkpoint_seconds,
                      .with_sums = options.samples.has_value(),
                      .scene = options.scene.filename().string()},
                     diagnostics),
          whole_only_(options.frames.has_value()),
          progress_(progress),
          watch_(watch),
          times_(times) {}

    /// Writes a single image even where it is not complete; one of several only where it is.
    void write(SessionImage image) override {
        times_.render_ms += watch_.lap() - image.denoise_ms;
        times_.denoise_ms += image.denoise_ms;
        times_.correct_ms += image.correct_ms;
        denoiser_ = image.denoiser;
        if (!image.complete && whole_only_) return;
        if (image.complete) progress_.update(1.0, "writing");
        FileOutput::write(std::move(image));
        times_.write_ms += watch_.lap();
    }

    /// What the last image has gone through.
    [[nodiscard]] Denoiser denoiser() const { return denoiser_; }

  private:
    Denoiser denoiser_ = Denoiser::none;
    bool whole_only_;
    Progress& progress_;
    Stopwatch& watch_;
    RunTimes& times_;
};

/// Says where the reference is made by path tracing alone.
void warn_about_paths(const RenderSession& session, const RenderOptions& options,
                      Diagnostics& diagnostics) {
    if (options.algorithm != Algorithm::reference || session.plan().exact) return;
    const FlatScene& flat = session.scene().flat();
    const char* reason = "less than half of the virtual lights land on a surface";
    if (flat.surfaces.present()) reason = "there are materials that are more than diffuse";
    if (flat.media.present()) reason = "there are participating media";
    diagnostics.warn("",
                     std::string("--algorithm reference is path tracing here, because ") + reason);
}

/// Says where materials are rendered as diffuse.
void warn_about_materials(const RenderSession& session, const RenderOptions& options,
                          Diagnostics& diagnostics) {
    const FlatScene& flat = session.scene().flat();
    if (!flat.surfaces.present()) return;
    if (options.algorithm == Algorithm::irradiance_cache)
        diagnostics.warn(options.scene.string(),
                         fmt::format("some materials are more than diffuse, {} renders them as "
                                     "diffuse, expected another algorithm, or --materials diffuse "
                                     "for such images",
                                     to_string(options.algorithm)));
}

/// Says where media are rendered with the mean of what varies in them.
void warn_about_media(const RenderSession& session, const RenderOptions& options,
                      Diagnostics& diagnostics) {
    if (!session.scene().flat().media.coloured || is_reference(options.algorithm)) return;
    diagnostics.warn(options.scene.string(),
                     fmt::format("some media have an albedo or a colour that varies, {} renders "
                                 "them with its mean, expected --algorithm path",
                                 to_string(options.algorithm)));
}

/// Says where the image was left with its noise.
void warn_about_denoiser(const RenderSession& session, const RenderOptions& options,
                         Denoiser applied, Diagnostics& diagnostics) {
    if (options.denoiser != Denoiser::statistical || session.samples() != 1) return;
    if (applied == Denoiser::none)
        diagnostics.warn("",
                         "--denoise statistical: a single sample has no variance, the image keeps "
                         "its noise, expected --spp 2 or more");
}

/// Makes the session for the options. With --resume, path tracing continues the file where there is
/// one. Throws Error (exit code 2) where that file is of another image.
RenderSession make_session(std::unique_ptr<Executor> executor, MovingScene moving,
                           const Camera& camera, const RenderOptions& options,
                           const RenderSettings& settings, Diagnostics& diagnostics) {
    // --stats writes the statistics of all frames.
    const std::size_t kept_frames = options.stats ? std::numeric_limits<std::size_t>::max()
                                                  : RenderSession::default_kept_frames;
    if (!is_reference(options.algorithm))
        return {std::move(executor), std::move(moving), camera, settings, kept_frames};
    FilmSums sums;
    PathSettings left = path_settings(options, settings);
    // Where the file cannot be looked for, reading it says why.
    std::error_code unknown;
    if (options.resume && (std::filesystem::exists(*options.resume, unknown) || unknown)) {
        sums = sums_of(read_exr(*options.resume), options.resume->string());
        left.samples = missing(left.samples, sums, options.resume->string());
        warn_about_backends(sums, executor->device().backend, left.samples,
                            options.resume->string(), diagnostics);
    }
    return {std::move(executor), std::move(moving), camera, left, kept_frames, std::move(sums)};
}

/// Whether the output has just the samples that are asked for, of this image. A file that cannot be
/// read has not.
bool has_part(RenderSession& session, const RenderOptions& options) {
    std::error_code unknown;
    if (!options.keep_complete || !options.samples ||
        !std::filesystem::exists(options.output, unknown))
        return false;
    FilmSums kept;
    try {
        kept = sums_of(read_exr(options.output), options.output.string());
    } catch (const Error&) {
        return false;
    }
    const std::optional<FilmSums> now = session.image().sums;
    return now && kept.identity == now->identity && kept.width == now->width &&
           kept.height == now->height && kept.ranges == std::vector<SampleRange>{*options.samples};
}

/// The camera in one frame of an animation.
Camera camera_of_frame(const Scene& scene, const Camera& camera, const RenderOptions& options,
                       std::uint32_t frame) {
    return options.chosen_frames() ? camera_at(scene, camera, frame / options.frame_rate) : camera;
}

/// Reads the scene and its edits. Things move only where frames are chosen.
MovingScene read_moving_scene(const RenderOptions& options, Diagnostics& diagnostics) {
    Scene scene = load_scene(options.scene, diagnostics, options.reading);
    if (!is_reference(options.algorithm)) empty_surfaces(scene);
    EditTimeline edits;
    if (!options.chosen_frames()) hold_still(scene);
    if (options.edits) edits = read_edits(*options.edits, scene);
    return {std::move(scene), std::move(edits), options.frame_rate};
}

/// Checks all frames before the first is rendered.
void check_frames(MovingScene& moving, const Camera& camera, const RenderOptions& options,
                  Diagnostics& diagnostics) {
    const std::optional<FrameRange> frames = options.chosen_frames();
    if (!frames) return;
    const Scene& scene = moving.at_rest();
    if (!camera.motion.moves() && !moving.moves()) {
        diagnostics.warn(
            scene.source,
            "neither the scene nor camera " + quote(camera.name) + " is animated, " +
                (options.frame ? "the image is that of every frame" : "all frames are the same"));
        return;
    }
    for (std::uint32_t frame = frames->first; frame < frames->end; ++frame) {
        moving.check_frame(frame);
        (void)camera_of_frame(scene, camera, options, frame);
    }
}

/// The time of a command, from the start of its process.
class CommandClock {
  public:
    /// Milliseconds since the process was started.
    [[nodiscard]] double total_ms() const { return start_ms_ + watch_.total(); }
    /// Milliseconds that the process takes to end: about as many as it took to start, since what
    /// was mapped has to be unmapped.
    [[nodiscard]] double end_ms() const { return start_ms_; }

  private:
    double start_ms_ = process_age_ms();
    Stopwatch watch_;
};

/// The budget of one image; with a time limit, an equal share of the remaining time.
RenderBudget budget_of_frame(const RenderOptions& options, std::uint32_t frame,
                             const CommandClock& clock, Progress& progress) {
    RenderBudget budget;
    budget.samples = options.spp;
    budget.target_error = options.target_error;
    budget.end_early = &interrupt_flag();
    budget.progress = [&progress](const SessionProgress& now) {
        progress.update(now.fraction, stage_name(now.stage));
    };
    budget.spent_ms = clock.total_ms();
    if (!options.time_seconds) return budget;
    budget.time_ms = *options.time_seconds * 1000.0;
    if (!options.frames || frame + 1 == options.frames->end) budget.reserved_ms = clock.end_ms();
    if (options.frames) {
        const double now = budget.spent_ms / 1000.0;
        budget.time_ms =
            (now + std::max(0.0, *options.time_seconds - now) / (options.frames->end - frame)) *
            1000.0;
    }
    return budget;
}

/// Renders and writes all images, unless the user ends it early. Returns how many are finished.
std::uint32_t render_images(RenderSession& session, CommandOutput& output, TevWatch* tev,
                            const Camera& camera, const RenderOptions& options, Progress& progress,
                            const CommandClock& clock) {
    const FrameRange frames = options.chosen_frames().value_or(FrameRange{});
    const std::uint32_t count = frames.end - frames.first;
    for (std::uint32_t done = 0; done < count; ++done) {
        const std::uint32_t frame = frames.first + done;
        if (done > 0 && interrupt_flag()) return done;
        if (done > 0)
            session.set_frame(frame,
                              camera_of_frame(session.scene().at_rest(), camera, options, frame));
        progress.begin_part(static_cast<double>(done) / count, 1.0 / count);
        if (options.frames) {
            const std::filesystem::path file = numbered_output(options.output, frame);
            output.set_file(file);
            if (tev != nullptr) tev->set_image(file.filename().string());
        }
        const RenderBudget budget = budget_of_frame(options, frame, clock, progress);
        if (session.render(budget) != SessionEnd::complete) return done;
    }
    return count;
}

double kernel_build_ms(const Executor& executor) {
    double sum = 0.0;
    for (const KernelBuild& build : executor.builds()) sum += build.build_ms;
    return sum;
}

}  // namespace

ExitCode render_command(const RenderOptions& given, Diagnostics& diagnostics) {
    const CommandClock clock;
    Stopwatch watch;
    RenderOptions options = given;
    const std::filesystem::path first_output =
        options.frames ? numbered_output(options.output, options.frames->first) : options.output;
    check_output(first_output);
    if (options.stats) check_output(*options.stats);
    if (options.resume) check_output(*options.resume);
    const ImageDenoiser denoiser(options.denoiser);
    InterruptGuard guard(
        "weft: warning: interrupted before there was a sample, no image is written");
    const ThreadLimit limit(options.threads);
    Progress progress(options.progress, stderr);
    RunTimes times;
    progress.update(0.0, "reading");
    MovingScene moving = read_moving_scene(options, diagnostics);
    const Scene& scene = moving.at_rest();
    const FlatScene& flat = moving.flat();
    options.spp = samples_of(given, scene);
    const RenderSettings settings = image_settings(options, scene);
    std::optional<SceneBounds> shown;
    if (options.frames && scene.cameras.empty())
        shown = moving.bounds(options.frames->first, options.frames->end);
    // A camera that is placed stands where the user wants it, and none of the scene is missed.
    Diagnostics unheard;
    const Camera camera =
        placed_camera(choose_camera(scene, flat, options.camera.value_or(""),
                                    options.placement.view ? unheard : diagnostics, shown),
                      options.placement);
    warn_about_darkness(flat, scene.source, diagnostics);
    check_media(options, flat);
    check_orthographic(options, settings, flat, camera);
    check_frames(moving, camera, options, diagnostics);
    progress.clear_bar();
    print_warnings(diagnostics, options.verbose);
    times.read_scene_ms = watch.lap();
    progress.update(0.0, "opening device");
    std::unique_ptr<Executor> executor = choose_executor(options, diagnostics);
    progress.clear_bar();
    print_warnings(diagnostics, options.verbose);
    times.open_device_ms = watch.lap();
    executor->watch_builds([&progress](const BuildProgress& now) {
        progress.prepare("compiling kernels", now.left_ms / 1000.0);
    });
    progress.update(0.0, "building");
    const FrameRange frames = options.chosen_frames().value_or(FrameRange{});
    if (options.chosen_frames()) moving.set_frame(frames.first);
    const Camera first_camera = camera_of_frame(scene, camera, options, frames.first);
    RenderSession session = make_session(std::move(executor), std::move(moving), first_camera,
                                         options, settings, diagnostics);
    if (has_part(session, options)) {
        progress.clear_bar();
        return ExitCode::success;
    }
    warn_about_paths(session, options, diagnostics);
    warn_about_materials(session, options, diagnostics);
    warn_about_media(session, options, diagnostics);
    CommandOutput output(options, progress, watch, times, diagnostics);
    session.set_output(&output);
    std::optional<TevWatch> tev;
    if (options.tev) {
        tev.emplace(*options.tev, first_output.filename().string(), diagnostics);
        session.set_watch(&*tev);
    }
    session.set_mattes({options.object_mattes, options.material_mattes});
    session.set_denoiser(&denoiser);
    guard.keep_work();
    const std::uint32_t finished =
        render_images(session, output, tev ? &*tev : nullptr, camera, options, progress, clock);
    times.render_ms += watch.lap();  // where no image was written
    const std::uint32_t images = frames.end - frames.first;
    const bool complete = finished == images;
    times.build_kernels_ms = kernel_build_ms(session.executor());
    times.build_bvh_ms = session.executor().scene_ms();
    times.total_ms = clock.total_ms();
    if (complete) progress.finish();
    if (!complete && options.frames)
        diagnostics.warn(
            "", fmt::format("interrupted, {} of {} images are finished", finished, images));
    else if (!complete && (session.samples() == 0 || is_dark(session.light())))
        diagnostics.warn("", "interrupted before there was a sample, no image is written");
    else if (!complete && !session.light().empty())
        diagnostics.warn("",
                         fmt::format("interrupted, the image holds a part of its only sample: {}",
                                     light_text(session.light())));
    else if (!complete)
        diagnostics.warn("", fmt::format("interrupted, the image holds what was done by then "
                                         "(samples: {})",
                                         session.samples()));
    warn_about_frame_time(session, options, diagnostics);
    warn_about_nonfinite(session, options, settings.width, diagnostics);
    warn_about_denoiser(session, options, output.denoiser(), diagnostics);
    RenderOptions used = effective(options, settings, camera, session);
    used.denoiser = output.denoiser();
    write_stats(options, stats_json(used, session, settings, times));
    return complete ? ExitCode::success : ExitCode::interrupted;
}

}  // namespace weft
