// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/image_settings.h"

#include <algorithm>

#include "app/command_line.h"
#include "app/options.h"
#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "components/component.h"
#include "plan/algorithm.h"
#include "plan/quality.h"
#include "render/camera_params.h"

namespace weft {
namespace {

bool is_sequence(const RenderOptions& options) {
    return options.frames || options.frame_seconds;
}

/// Whether further samples of a preview refine it: where nothing asks for another image than that
/// of the default algorithm.
bool is_refined(const RenderOptions& options) {
    const bool by_vpls =
        !options.indirect || (options.preset && *options.indirect == IndirectSource::vpl);
    return options.algorithm == Algorithm::ais && by_vpls && !is_sequence(options) &&
           !options.compensation && !options.overlays;
}

/// The settings of VPLs, bounds and thresholds. `indirect` and `media`: whether the image has
/// indirect light, and the scene media.
SamplingSettings sampling_settings(const RenderOptions& options, bool indirect, bool media) {
    const IndirectSource source = options.indirect.value_or(IndirectSource::vpl);
    SamplingSettings sampling = sampling_of(options.quality);
    if (options.preset) {
        sampling = options.preset->sampling;
        // The command line may choose what a preset's residual knows nothing of.
        if (media || !can_compensate(options.algorithm, source)) sampling.compensation = false;
    } else if (options.algorithm == Algorithm::ais && source == IndirectSource::vpl && indirect &&
               !is_sequence(options)) {
        sampling = sampling_of_image(options.quality, media);
    }
    if (is_sequence(options)) {
        // What each image of a sequence would choose or trace anew flickers.
        sampling.candidates = 1;
        sampling.threshold_falls = false;
        if (sampling.near_residual) sampling.compensation = false;
    }
    if (options.compensation) {
        // Who asks for what is left out gets all of it.
        sampling.compensation = true;
        sampling.near_residual = false;
    }
    return sampling;
}

/// Whether some material may be more than diffuse.
bool has_described(const Scene& scene) {
    return std::ranges::any_of(
        scene.materials, [](const Material& material) { return material.description.has_value(); });
}

/// After how many samples of its own a preview is refined. With mirrors, gloss or glass what it
/// leaves out, such as caustics, is soon more than the noise of few unbiased samples.
std::uint32_t samples_before_refinement(const Scene& scene) {
    return samples_of(Quality::preview, !scene.media.empty() || has_described(scene));
}

}  // namespace

std::optional<std::uint32_t> samples_of(const RenderOptions& options, const Scene& scene) {
    if (options.spp || options.time_seconds || is_reference(options.algorithm)) return options.spp;
    if (options.algorithm != Algorithm::ais || is_sequence(options) || options.preset) return 1;
    return samples_of(options.quality, !scene.media.empty());
}

RenderSettings image_settings(const RenderOptions& options, const Scene& scene) {
    RenderSettings settings;
    settings.algorithm = options.algorithm;
    const FilmSize size =
        options.size.value_or(scene.film.value_or(FilmSize{settings.width, settings.height}));
    settings.width = size.width;
    settings.height = size.height;
    settings.tile = options.tile;
    settings.seed = options.seed;
    if (options.components) {
        settings.direct = options.names_component("direct");
        settings.indirect = options.names_component("indirect");
        settings.reflection = options.names_component("reflection");
        settings.refraction = options.names_component("refraction");
        settings.glossy = options.names_component("glossy");
        settings.media = options.names_component("media");
        for (const std::string_view name : choosable_components(Choice::on_request))
            if (options.names_component(name)) settings.requested.emplace_back(name);
    }
    settings.sampling = sampling_settings(options, settings.indirect, !scene.media.empty());
    settings.sampling.cached = options.caches_indirect();
    settings.sampling.bounce_rays = options.indirect == IndirectSource::rays;
    settings.sampling.bounce_rays_if_open =
        options.algorithm == Algorithm::ais && !options.indirect && !options.compensation;
    settings.sampling.temporal = options.keeps_records();
    settings.sampling.cache_masks = options.cache_masks;
    if (options.cache_records) settings.sampling.cache_records = *options.cache_records;
    if (options.cache_rays) settings.sampling.cache_rays = *options.cache_rays;
    if (options.cache_error) settings.sampling.cache_error = *options.cache_error;
    settings.hides_environment = options.background.has_value();
    settings.frame_time_ms = options.frame_seconds.value_or(0.0) * 1000.0;
    // The number of samples that a time limit allows is not known in advance. Textures are filtered
    // for this many, and so stay sharp with more.
    constexpr std::uint32_t timed_samples = 16;
    settings.samples = options.spp.value_or(options.time_seconds ? timed_samples : 1);
    const bool all_media = settings.media || scene.media.empty();
    const bool all_mirrors =
        (settings.reflection && settings.refraction && settings.glossy) || !has_described(scene);
    if (is_refined(options) && settings.requested.empty() && all_media && all_mirrors)
        settings.refined_after =
            options.preset ? options.preset->refined_after : samples_before_refinement(scene);
    // However many samples refine the preview, its own are the same: an image that goes on is the
    // one that would have been asked for.
    if (settings.refined_after > 0)
        settings.samples = std::min(settings.samples, settings.refined_after);
    return settings;
}

PathSettings path_settings(const RenderOptions& options, const RenderSettings& common) {
    // Enough for a first impression. With a limit on time or error, there are as many as it takes.
    constexpr std::uint32_t default_samples = 64;
    const bool open = options.time_seconds.has_value() || options.target_error.has_value();
    PathSettings settings;
    settings.algorithm = options.algorithm;
    settings.width = common.width;
    settings.height = common.height;
    settings.seed = common.seed;
    settings.samples = options.samples.value_or(SampleRange{
        0, options.spp.value_or(open ? limits::max_samples_per_pixel : default_samples)});
    settings.through_centres = options.through_centres;
    if (options.most_bounces) settings.most_bounces = *options.most_bounces;
    settings.hides_environment = common.hides_environment;
    settings.direct = common.direct;
    settings.indirect = common.indirect;
    return settings;
}

void warn_about_darkness(const FlatScene& flat, const std::string& scene,
                         Diagnostics& diagnostics) {
    if (flat.lights.empty() && !(flat.media.radiance > 0.0))
        diagnostics.warn(scene, "no light shines in the scene, the image will be dark");
}

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

void check_orthographic(const RenderOptions& options, const RenderSettings& settings,
                        const FlatScene& flat, const Camera& camera) {
    if (!starts_in_one_medium(flat, camera, settings.width, settings.height))
        throw input_error(options.scene.string(),
                          "the near plane of the orthographic camera " + quote(camera.name) +
                              " cuts a boundary of media, expected it inside or outside of each");
}

}  // namespace weft
