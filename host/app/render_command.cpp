// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <thread>

#include "app/choose_executor.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/overlay_output.h"
#include "app/print.h"
#include "app/render_path.h"
#include "app/stats_json.h"
#include "app/thread_limit.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/quote.h"
#include "base/stopwatch.h"
#include "frame/camera_params.h"
#include "frame/film_sums_file.h"
#include "image/exr.h"
#include "image/png.h"
#include "scene/load_scene.h"
#include "scene/moving_scene.h"
#include "scene/pose_scene.h"

namespace weft {
namespace {

RenderSettings settings_of(const RenderOptions& options, const Scene& scene) {
    RenderSettings settings;
    settings.algorithm = options.algorithm;
    const FilmSize size =
        options.size.value_or(scene.film.value_or(FilmSize{settings.width, settings.height}));
    settings.width = size.width;
    settings.height = size.height;
    settings.tile = options.tile;
    settings.seed = options.seed;
    settings.sampling = options.preset ? options.preset->sampling : sampling_of(options.quality);
    settings.sampling.compensation = options.compensation;
    settings.sampling.cached = options.caches_indirect();
    settings.sampling.temporal = options.keeps_records();
    settings.sampling.cache_masks = options.cache_masks;
    if (options.cache_records) settings.sampling.cache_records = *options.cache_records;
    if (options.cache_rays) settings.sampling.cache_rays = *options.cache_rays;
    if (options.cache_error) settings.sampling.cache_error = *options.cache_error;
    settings.frame_time_ms = options.frame_seconds.value_or(0.0) * 1000.0;
    // How many samples a time limit allows is not known before; textures stay sharp for many.
    constexpr std::uint32_t timed_samples = 16;
    settings.samples = options.spp.value_or(options.time_seconds ? timed_samples : 1);
    if (options.components) {
        settings.direct = options.names_component("direct");
        settings.indirect = options.names_component("indirect");
        settings.media = options.names_component("media");
        for (const std::string_view name : choosable_components(Choice::on_request))
            if (options.names_component(name)) settings.requested.emplace_back(name);
    }
    return settings;
}

PathSettings path_settings(const RenderOptions& options, const RenderSettings& common) {
    // A first impression; with a time or an error to reach, as many as that takes.
    constexpr std::uint32_t default_samples = 64;
    const bool open = options.time_seconds.has_value() || options.target_error.has_value();
    PathSettings settings;
    settings.width = common.width;
    settings.height = common.height;
    settings.seed = common.seed;
    settings.samples = options.samples.value_or(SampleRange{
        0, options.spp.value_or(open ? limits::max_samples_per_pixel : default_samples)});
    settings.through_centres = options.through_centres;
    settings.direct = common.direct;
    settings.indirect = common.indirect;
    return settings;
}

/// How far a frame is, from what its stages cost as a rule.
double share_of_frame(Stage stage, double done) {
    constexpr double before_gather = 0.1;
    constexpr double direct = 0.15;
    if (stage == Stage::vpl_gather || stage == Stage::hemisphere_rays)
        return before_gather + direct + 0.7 * done;
    if (stage == Stage::area_lights || stage == Stage::distant_light)
        return before_gather + direct * done;
    if (stage == Stage::vpl_residual) return 0.95;
    if (stage == Stage::reconstruction || stage == Stage::composition) return 0.97;
    return before_gather * done * 0.5;
}

/// Stages that read no light, but that every later one builds on: the first frame has them whole.
bool is_needed_by_all(Stage stage) {
    return stage == Stage::primary_rays || stage == Stage::receivers;
}

/// Renders frames until the options' count, their time or the user ends it.
bool render_frames(Renderer& renderer, const RenderOptions& options, Progress& progress,
                   const Stopwatch& watch) {
    const bool timed = options.time_seconds.has_value();
    const std::uint32_t frames =
        options.spp.value_or(timed ? std::numeric_limits<std::uint32_t>::max() : 1);
    const double budget_ms = timed ? *options.time_seconds * 1000.0 : 0.0;
    double shown = 0.0;
    std::uint32_t frame = 0;
    const KeepGoing keep_going = [&](Stage stage, double done) {
        double fraction = (frame + share_of_frame(stage, done)) / frames;
        if (timed) fraction = std::max(fraction, std::min(1.0, watch.total() / budget_ms));
        shown = std::max(shown, fraction);
        progress.update(shown, stage_name(stage));
        // A first frame is finished even when the time is up: less than a picture helps nobody.
        if (frame == 0 && is_needed_by_all(stage)) return true;
        const bool out_of_time = timed && frame > 0 && watch.total() > budget_ms;
        return !interrupt_flag() && !out_of_time;
    };
    // A first frame is begun in any case: without it there is no picture to keep.
    for (; frame < frames && (frame == 0 || !interrupt_flag()); ++frame) {
        if (timed && frame > 0 && watch.total() >= budget_ms) break;
        if (!renderer.render_frame(keep_going)) break;
    }
    return !interrupt_flag();
}

void warn_about_nonfinite(const FrameRenderer& renderer, const RenderOptions& options,
                          std::uint32_t width, Diagnostics& diagnostics) {
    for (const NonfiniteSummary& found : nonfinite_of(renderer)) {
        const std::string frame =
            options.frames
                ? fmt::format(" of frame {}", options.frames->first + found.first_picture)
                : "";
        diagnostics.warn(
            "", fmt::format("{} values of {} light were negative or not finite and count as black, "
                            "the first in sample {}{} at pixel ({}, {})",
                            found.count, found.component, found.first_sample, frame,
                            found.first_pixel % width, found.first_pixel / width));
    }
}

/// Refuses an output that could never be written, before an hour is spent on what to write.
void check_folder(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        throw Error(ExitCode::output, file.string(),
                    "cannot be written, expected " + quote(folder.string()) + " to be a folder");
}

/// Refuses what knows nothing of media in a scene with any.
void check_media(const RenderOptions& options, const FlatScene& flat) {
    if (!flat.media.present()) return;
    if (options.compensation)
        throw usage_error(
            "--vpl-compensation: knows nothing of participating media, which the scene has");
    if (options.algorithm == Algorithm::irradiance_cache)
        throw usage_error(
            "--algorithm: irradiance-cache knows nothing of participating media, which the scene "
            "has, expected another");
}

/// The options with what was chosen where the user chose nothing.
RenderOptions effective(const RenderOptions& options, const RenderSettings& settings,
                        const Camera& camera, const Executor& executor,
                        const FrameRenderer& renderer) {
    RenderOptions used = options;
    const DeviceInfo& device = executor.device();
    used.backend = device.backend == "opencl"   ? Backend::opencl
                   : device.backend == "embree" ? Backend::embree
                                                : Backend::native;
    used.device = device.name;
    if (!used.threads)
        used.threads = device.is_cpu ? device.compute_units : std::thread::hardware_concurrency();
    used.size = FilmSize{settings.width, settings.height};
    used.camera = camera.name;
    used.components.emplace();
    if (settings.direct) used.components->emplace_back("direct");
    if (settings.indirect) used.components->emplace_back("indirect");
    if (renderer.plan().media_light) used.components->emplace_back("media");
    used.components->insert(used.components->end(), settings.requested.begin(),
                            settings.requested.end());
    if (!used.spp) used.spp = static_cast<std::uint32_t>(renderer.samples());
    return used;
}

void write_picture(const RenderOptions& options, Image& image, const FrameRenderer& renderer) {
    image.metadata["software"] = "weft " WEFT_VERSION;
    image.metadata["scene"] = options.scene.filename().string();
    image.metadata["algorithm"] = to_string(options.algorithm);
    image.metadata["samples"] = std::to_string(renderer.samples());
    image.metadata["seed"] = std::to_string(options.seed);
    std::string extension = options.output.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".png") {
        write_png(options.output, image,
                  options.exposure_ev ? *options.exposure_ev : auto_exposure(image));
    } else {
        write_exr(options.output, image);
    }
}

void write_stats(const RenderOptions& options, const nlohmann::json& stats) {
    if (!options.stats) return;
    const std::string text = json_document(stats);
    write_file_atomically(*options.stats, std::as_bytes(std::span(text)));
}

/// A renderer, and what makes one picture with it and returns whether the user let that end.
struct PictureMaker {
    std::unique_ptr<FrameRenderer> renderer;
    std::function<bool(const RenderOptions&, Image&)> make;
};

PictureMaker picture_maker(Executor& executor, const FlatScene& flat, const Camera& camera,
                           const RenderOptions& options, const RenderSettings& settings,
                           Progress& progress, const Stopwatch& watch) {
    if (options.algorithm != Algorithm::path) {
        auto renderer = std::make_unique<Renderer>(executor, flat, camera, settings);
        const auto make = [&progress, &watch, used = renderer.get()](const RenderOptions& wanted,
                                                                     Image& image) {
            const bool complete = render_frames(*used, wanted, progress, watch);
            image = used->image();
            return complete;
        };
        return {std::move(renderer), make};
    }
    auto renderer =
        make_path_renderer(executor, flat, camera, options, path_settings(options, settings));
    const auto make = [&progress, &watch, used = renderer.get()](const RenderOptions& wanted,
                                                                 Image& image) {
        const bool complete = render_path(*used, wanted, progress, watch);
        const FilmSums sums = used->sums();
        image = resolve_sums(sums);
        write_checkpoint(sums, image, wanted);
        if (wanted.samples) attach_sums(sums, image);
        return complete;
    };
    return {std::move(renderer), make};
}

/// Where the camera stands in one frame of an animation.
Camera camera_of_frame(const Scene& scene, const Camera& camera, const RenderOptions& options,
                       std::uint32_t frame) {
    return options.frames ? camera_at(scene, camera, frame / options.frame_rate) : camera;
}

/// The scene with what moves in it: only over frames.
MovingScene read_moving_scene(const RenderOptions& options, Diagnostics& diagnostics) {
    Scene scene = load_scene(options.scene, diagnostics);
    EditTimeline edits;
    if (!options.frames) hold_still(scene);
    if (options.edits) edits = read_scene_edits(*options.edits, scene);
    return {std::move(scene), std::move(edits), options.frame_rate};
}

/// Finds what is wrong with the last frame before the first is rendered.
void check_frames(MovingScene& moving, const Camera& camera, const RenderOptions& options,
                  Diagnostics& diagnostics) {
    if (!options.frames) return;
    const Scene& scene = moving.at_rest();
    if (!camera.motion.moves() && !moving.moves()) {
        diagnostics.warn(scene.source, "neither the scene nor camera " + quote(camera.name) +
                                           " is animated, all frames are the same");
        return;
    }
    for (std::uint32_t frame = options.frames->first; frame < options.frames->end; ++frame) {
        moving.check_frame(frame);
        (void)camera_of_frame(scene, camera, options, frame);
    }
}

/// The options of one picture: its file, and until when it may take, an equal share of what is
/// left.
RenderOptions options_of_frame(const RenderOptions& options, std::uint32_t frame,
                               const Stopwatch& watch) {
    RenderOptions used = options;
    if (!options.frames) return used;
    used.output = numbered_output(options.output, frame);
    if (options.time_seconds) {
        const double now = watch.total() / 1000.0;
        used.time_seconds =
            now + std::max(0.0, *options.time_seconds - now) / (options.frames->end - frame);
    }
    return used;
}

/// Makes and writes all pictures, or until the user ends it: then a single one is written as it is,
/// one of several is not. Returns how many are finished.
std::uint32_t render_pictures(const PictureMaker& maker, MovingScene& moving, const Camera& camera,
                              const RenderOptions& options, Progress& progress, Stopwatch& watch,
                              RunTimes& times, Diagnostics& diagnostics) {
    const FrameRange frames = options.frames.value_or(FrameRange{});
    const std::uint32_t count = frames.end - frames.first;
    for (std::uint32_t done = 0; done < count; ++done) {
        const std::uint32_t frame = frames.first + done;
        if (done > 0 && interrupt_flag()) return done;
        if (done > 0) {
            moving.set_frame(frame);
            if (moving.moves()) maker.renderer->update_scene();
            maker.renderer->move_camera(camera_of_frame(moving.at_rest(), camera, options, frame));
        }
        progress.begin_part(static_cast<double>(done) / count, 1.0 / count);
        const RenderOptions wanted = options_of_frame(options, frame, watch);
        Image image;
        const bool complete = maker.make(wanted, image);
        times.render_ms += watch.lap();
        if (!complete && options.frames) return done;
        if (complete) progress.update(1.0, "writing");
        write_picture(wanted, image, *maker.renderer);
        if (options.overlays) write_overlays(wanted, image, diagnostics);
        times.write_ms += watch.lap();
        if (!complete) return done;
    }
    return count;
}

double kernel_build_ms(const Executor& executor) {
    double sum = 0.0;
    for (const KernelBuild& build : executor.builds()) sum += build.build_ms;
    return sum;
}

}  // namespace

ExitCode render_command(const RenderOptions& options, Diagnostics& diagnostics) {
    Stopwatch watch;
    check_folder(options.output);
    if (options.stats) check_folder(*options.stats);
    const InterruptGuard guard;
    const ThreadLimit limit(options.threads);
    Progress progress(options.progress, stderr);
    RunTimes times;
    progress.update(0.0, "reading");
    MovingScene moving = read_moving_scene(options, diagnostics);
    const Scene& scene = moving.at_rest();
    const FlatScene& flat = moving.flat();
    const RenderSettings settings = settings_of(options, scene);
    const Camera camera = choose_camera(scene, flat, options.camera.value_or(""), diagnostics);
    const bool media_shine = flat.media.radiance > 0.0;
    if (flat.lights.empty() && !media_shine)
        diagnostics.warn(scene.source, "no light shines in the scene, the picture will be dark");
    check_media(options, flat);
    check_frames(moving, camera, options, diagnostics);
    times.read_scene_ms = watch.lap();
    progress.update(0.0, "opening device");
    const std::unique_ptr<Executor> executor = choose_executor(options, diagnostics);
    times.open_device_ms = watch.lap();
    progress.update(0.0, "building");
    const FrameRange frames = options.frames.value_or(FrameRange{});
    if (options.frames) moving.set_frame(frames.first);
    const PictureMaker maker =
        picture_maker(*executor, flat, camera_of_frame(scene, camera, options, frames.first),
                      options, settings, progress, watch);
    const std::uint32_t finished =
        render_pictures(maker, moving, camera, options, progress, watch, times, diagnostics);
    const FrameRenderer& renderer = *maker.renderer;
    const std::uint32_t pictures = frames.end - frames.first;
    const bool complete = finished == pictures;
    times.build_kernels_ms = kernel_build_ms(*executor);
    times.build_bvh_ms = executor->scene_ms();
    times.total_ms = watch.total();
    if (complete) progress.finish();
    if (!complete && options.frames)
        diagnostics.warn(
            "", fmt::format("interrupted, {} of {} pictures are finished", finished, pictures));
    else if (!complete)
        diagnostics.warn("", fmt::format("interrupted, the picture holds what was done by then "
                                         "(samples: {})",
                                         renderer.samples()));
    warn_about_nonfinite(renderer, options, settings.width, diagnostics);
    const RenderOptions used = effective(options, settings, camera, *executor, renderer);
    write_stats(options, stats_json(used, *executor, renderer, flat, settings, times));
    return complete ? ExitCode::success : ExitCode::interrupted;
}

}  // namespace weft
