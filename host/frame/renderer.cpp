// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/renderer.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/stopwatch.h"
#include "components/component.h"
#include "components/soft_shadows.h"
#include "frame/camera_params.h"
#include "frame/edge_samples.h"
#include "frame/film.h"
#include "frame/level_layers.h"

namespace weft {

namespace {

/// Angle that a texture lookup covers: that of a pixel, less where samples share it.
float texture_angle(const shared::Params& params, const RenderSettings& settings) {
    return static_cast<float>(static_cast<double>(params.pixel_angle) /
                              std::sqrt(std::max(1U, settings.samples)));
}

}  // namespace

FramePlan plan_for(const FlatScene& scene, const RenderSettings& settings) {
    SceneStatistics statistics;
    statistics.area_lights = scene.area_lights;
    statistics.punctual_lights = scene.punctual_lights;
    statistics.directional_lights = scene.directional_lights;
    statistics.environment = (scene.features & FEATURE_ENVIRONMENT) != 0;
    statistics.direct = settings.direct;
    statistics.indirect = settings.indirect;
    statistics.surface_area = scene.surface_area;
    statistics.mean_reflectance = scene.mean_reflectance;
    FramePlan plan = plan_frames(settings.algorithm, settings.sampling, statistics);
    // Frames with points all over the pixel average edges anyway.
    if (settings.samples > 1) plan.edge_samples = 0;
    return plan;
}

std::vector<KernelId> kernels_of(const FramePlan& plan) {
    std::set<KernelId> kernels{KernelId::gbuffer, KernelId::compose, KernelId::receivers};
    if (plan.adaptive) kernels.insert(KernelId::tile_geometry);
    if (plan.edge_samples > 0) {
        kernels.insert(KernelId::edge_masks);
        kernels.insert(KernelId::edge_samples);
    }
    for (const Component& component : components()) {
        if (!component.called_for(plan)) continue;
        for (const KernelId kernel : component.kernels(plan)) kernels.insert(kernel);
    }
    return {kernels.begin(), kernels.end()};
}

std::uint32_t features_of(const FlatScene& scene, const FramePlan& plan) {
    constexpr std::uint32_t of_surfaces = FEATURE_TEXTURES | FEATURE_VERTEX_COLOURS |
                                          FEATURE_SMOOTH_NORMALS | FEATURE_ONE_SIDED |
                                          FEATURE_ENVIRONMENT;
    std::uint32_t features = scene.features & of_surfaces;
    if (plan.has_sampled_direct()) features |= FEATURE_SAMPLED_DIRECT;
    if (plan.has_exact_direct()) features |= FEATURE_EXACT_DIRECT;
    if (plan.directional_lights > 0) features |= FEATURE_DIRECTIONAL_LIGHTS;
    if (plan.has_indirect()) features |= FEATURE_INDIRECT;
    return features;
}

Renderer::Renderer(Executor& executor, const FlatScene& scene, const Camera& camera,
                   const RenderSettings& settings)
    : executor_(executor),
      scene_(scene),
      settings_(settings),
      plan_(plan_for(scene, settings)),
      work_(make_work_list(settings.width, settings.height, plan_.interleave, settings.tile)) {
    const std::uint32_t features = features_of(scene, plan_);
    executor_.build(kernels_of(plan_), features);
    scene_buffers_ = upload_scene(executor_, scene);
    buffers_ =
        allocate_frame(executor_, scene, plan_, work_, settings.width, settings.height, features);

    base_params_ = scene_params(scene, camera, settings.width, settings.height);
    shared::Params& params = base_params_;
    params.texture_angle = texture_angle(params, settings);
    params.gather_scale = static_cast<float>(plan_.gather_sets);
    params.filter_cosine = static_cast<float>(settings.sampling.filter_cosine);
    params.filter_planes = static_cast<float>(settings.sampling.filter_planes);
    params.enough_support = static_cast<float>(settings.sampling.enough_support);
    params.features = features;
    params.seed = settings.seed;
    params.slots = buffers_.slots;
    params.sets = plan_.sets;
    params.gather_sets = plan_.gather_sets;
    params.samples_per_light = plan_.samples_per_light;
    params.samples_per_set = plan_.samples_per_set;
    params.environment_samples = plan_.environment_samples;
    params.paths_per_set = plan_.paths_per_set;
    params.vpls_per_set = plan_.vpls_per_set;
    params.bounces = plan_.bounces;
    std::copy(plan_.survivors.begin(), plan_.survivors.end(), params.survivors);
    std::copy(plan_.first_vpl.begin(), plan_.first_vpl.end(), params.first_vpl);
    params.filter_radius = plan_.filter_radius;
    params.edge_samples = plan_.edge_samples;
    params.delta_lights = plan_.punctual_lights;
    params.directional_lights = plan_.directional_lights;
}

void Renderer::set_camera(const Camera& camera) {
    weft::set_camera(camera, scene_.units, base_params_);
    base_params_.texture_angle = texture_angle(base_params_, settings_);
    frames_in_film_ = 0;
    ++picture_;
}

shared::Params Renderer::params_of_frame(std::uint32_t frame) const {
    shared::Params params = base_params_;
    params.frame = frame;
    params.film_starts = frame == 0 ? 1 : 0;
    // 4 and n^2 are coprime for odd n: in n^2 frames a pixel meets every set.
    params.set_rotation = frame * 4 % plan_.gather_sets;
    const double growth = bound_growth(frame);
    params.vpl_bound = static_cast<float>(plan_.vpl_bound * growth);
    params.light_bound_scale = static_cast<float>(plan_.light_bound_scale * growth);
    set_jitter(frame, settings_.samples <= 1, settings_.seed, params);
    return params;
}

void Renderer::trace_primary(FrameContext& frame) {
    const std::uint32_t pixels = settings_.width * settings_.height;
    frame.run(KernelId::gbuffer, "primary rays", "", true,
              with_geometry(scene_buffers_, with_gbuffer(buffers_, {})), pixels);
    if (plan_.uses_all_receivers())
        frame.run(KernelId::receivers, "receivers", "", false,
                  with_gbuffer(buffers_, {buffers_.slot_pixel.get(), buffers_.receivers.get(),
                                          buffers_.pixel_slot.get()}),
                  buffers_.slots);
    if (buffers_.tiles) buffers_.tiles->examine(frame);
}

void Renderer::compose(FrameContext& frame) {
    if (buffers_.edges) buffers_.edges->find(frame);
    Buffer* const masks = buffers_.edges ? &buffers_.edges->masks() : buffers_.nothing.get();
    frame.run(KernelId::compose, "composition", "", false,
              with_gbuffer(buffers_, with_irradiance(buffers_, {buffers_.film_high.get(),
                                                                buffers_.film_low.get(),
                                                                buffers_.nonfinite.get(), masks})),
              settings_.width * settings_.height);
    if (buffers_.edges) buffers_.edges->sample(frame);
}

bool Renderer::render_frame(const KeepGoing& keep_going) {
    const Stopwatch watch;
    const FrameInputs inputs{executor_, scene_, scene_buffers_, buffers_, plan_};
    const std::uint32_t number = frames_in_film_;
    FrameContext frame(inputs, params_of_frame(number), keep_going);
    frame.run_whole([&] { trace_primary(frame); });
    for (const Component& component : components())
        if (component.called_for(plan_)) component.sample(frame);
    if (frame.ended_early() && number > 0) return false;
    frame.run_whole([&] {
        for (const Component& component : components())
            if (component.called_for(plan_)) component.reconstruct(frame);
        compose(frame);
    });
    ++frames_in_film_;
    record(frame, watch.total());
    return !frame.ended_early();
}

template <class Use>
void Renderer::for_adaptive(const Use& use) const {
    if (buffers_.soft_shadows) use("direct", buffers_.soft_shadows->sampling());
    if (buffers_.adaptive_indirect) use("indirect", *buffers_.adaptive_indirect);
}

void Renderer::record(FrameContext& frame, double ms) {
    stats_.push_back(frame_stats(frame, ms));
    stats_.back().picture = picture_;
    for_adaptive([&](const char* component, const AdaptiveSampling& sampling) {
        const LevelScheduler& scheduler = sampling.scheduler();
        stats_.back().levels.push_back(
            {component, scheduler.tiles_by_level(), scheduler.samples()});
    });
    for (StageStats& stage : stats_.back().stages) {
        if (stage.name != "primary rays") continue;
        stage.rays = std::uint64_t{settings_.width} * settings_.height;
        stats_.back().rays += stage.rays;
    }
}

Image Renderer::image() {
    const std::size_t values =
        FILM_PLANES * FILM_STRIDE(std::size_t{settings_.width} * settings_.height);
    const auto high = read_buffer<float>(executor_, *buffers_.film_high, values);
    const auto low = read_buffer<float>(executor_, *buffers_.film_low, values);
    Image image = resolve_film(high, low, settings_.width, settings_.height, frames_in_film_);
    for_adaptive([&](const char* component, const AdaptiveSampling& sampling) {
        add_level_layers(component, sampling.scheduler(), image);
    });
    return image;
}

}  // namespace weft
