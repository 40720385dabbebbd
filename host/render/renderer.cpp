// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "adaptive/adaptive_sampling.h"
#include "base/stopwatch.h"
#include "film/film.h"
#include "pipeline/edge_samples.h"
#include "pipeline/view_media.h"
#include "pipeline/virtual_lights.h"
#include "plan/halton.h"
#include "render/camera_params.h"
#include "render/surface_features.h"

namespace weft {

namespace {

/// Number of runs of pixels in the rows of an image (kernels/film/wide_pixels.h).
std::uint32_t pixel_runs(std::uint32_t width, std::uint32_t height, std::uint32_t lanes) {
    return (width + lanes - 1) / lanes * height;
}

/// Angle that a texture lookup covers: that of a pixel, less where samples share it. Where there
/// are more than expected it goes on falling, so that what is averaged over neighbouring texels
/// vanishes as samples accumulate.
float texture_angle(const shared::RenderParams& params, const RenderSettings& settings,
                    std::uint32_t frame = 0) {
    return static_cast<float>(static_cast<double>(params.camera.pixel_angle) /
                              std::sqrt(std::max(frame + 1, settings.samples)));
}

WorkList work_list_of(const FramePlan& plan, const RenderSettings& settings) {
    if (plan.exact)
        return make_shuffled_work_list(settings.width, settings.height, plan.interleave);
    if (plan.adapts_direct())
        return make_spread_work_list(settings.width, settings.height, plan.interleave,
                                     settings.tile);
    return make_work_list(settings.width, settings.height, plan.interleave, settings.tile);
}

/// Whether two plans agree in the numbers of lights and light samples, and in whether there are
/// VPLs, so that buffers for one serve the other.
bool same_lights(const FramePlan& a, const FramePlan& b) {
    return a.samples_per_light == b.samples_per_light && a.samples_per_set == b.samples_per_set &&
           a.environment_samples == b.environment_samples &&
           a.punctual_lights == b.punctual_lights && a.directional_lights == b.directional_lights &&
           a.has_vpls() == b.has_vpls() && a.has_indirect() == b.has_indirect() &&
           a.media_light == b.media_light;
}

/// The mean reflectance that decides how many light paths survive: that of the scene at first, so
/// that the numbers are the same in all frames in which anything reflects light. For a scene that
/// was black at first a common value is used.
double planned_reflectance(const FlatScene& scene) {
    constexpr double common = 0.5;
    if (!(scene.mean_reflectance > 0.0)) return 0.0;
    return scene.first_mean_reflectance > 0.0 ? scene.first_mean_reflectance : common;
}

}  // namespace

FramePlan plan_for(const FlatScene& scene, const RenderSettings& settings) {
    SceneStatistics statistics;
    statistics.area_lights = scene.area_lights;
    statistics.punctual_lights = scene.punctual_lights;
    statistics.directional_lights = scene.directional_lights;
    statistics.environment = (scene.features & FEATURE_ENVIRONMENT) != 0;
    statistics.materials = scene.surfaces.present();
    statistics.reflection = scene.surfaces.mirrors && settings.reflection;
    statistics.refraction = scene.surfaces.lets_through && settings.refraction;
    statistics.glossy = scene.surfaces.glossy && settings.glossy;
    statistics.rough_glass = scene.surfaces.rough_glass;
    statistics.media = scene.media.present();
    statistics.scattering = scene.media.scatters();
    statistics.media_light = settings.media;
    statistics.direct = settings.direct;
    statistics.indirect = settings.indirect;
    statistics.surface_area = scene.surface_area;
    statistics.mean_reflectance = planned_reflectance(scene);
    FramePlan plan = plan_frames(settings.algorithm, settings.sampling, statistics);
    plan.requested = settings.requested;
    // So many samples, with points all over the pixel, average edges anyway.
    constexpr std::uint32_t enough_samples = 16;
    if (settings.samples > enough_samples) plan.edge_samples = 0;
    return plan;
}

std::vector<KernelId> kernels_of(const FramePlan& plan, std::span<const ComponentKind> kinds) {
    const ComponentRequirements requirements = requirements_of(plan, kinds);
    std::set<KernelId> kernels(requirements.kernels.begin(), requirements.kernels.end());
    kernels.insert(plan.materials ? KernelId::gbuffer_surfaces : KernelId::gbuffer);
    kernels.insert(plan.exact ? KernelId::compose_sums : KernelId::compose);
    if (requirements.all_receivers || requirements.tiles || requirements.own_tiles)
        kernels.insert(KernelId::receivers);
    if (requirements.tiles || requirements.own_tiles) kernels.insert(KernelId::tile_geometry);
    if (plan.media) kernels.insert(KernelId::view_media);
    if (plan.edge_samples > 0) kernels.insert({KernelId::edge_masks, KernelId::edge_samples});
    return {kernels.begin(), kernels.end()};
}

std::uint32_t features_of(const FlatScene& scene, const FramePlan& plan,
                          std::span<const ComponentKind> kinds) {
    const std::uint32_t of_media = plan.media ? FEATURE_MEDIA | scene.media.features() : 0U;
    const ComponentRequirements required = requirements_of(plan, kinds);
    // Only paths and glossy surfaces choose lights by the tree.
    const bool paths = std::ranges::any_of(required.kernels, [](KernelId kernel) {
        return kernel == KernelId::vpl_residual || kernel == KernelId::hemisphere_rays;
    });
    const bool chooses = paths || (required.features & FEATURE_GLOSSY) != 0;
    const std::uint32_t of_choice = chooses ? scene.features & FEATURE_LIGHT_TREE : 0U;
    const std::uint32_t of_materials =
        plan.materials ? scene.features & (FEATURE_MATERIALS | FEATURE_SEE_THROUGH) : 0U;
    return surface_features(scene) | of_media | of_choice | of_materials | required.features;
}

Renderer::Renderer(Executor& executor, const FlatScene& scene, const Camera& camera,
                   const RenderSettings& settings)
    : Renderer(executor, scene, std::make_shared<SceneBuffers>(upload_scene(executor, scene)),
               camera, settings) {}

Renderer::Renderer(Executor& executor, const FlatScene& scene,
                   std::shared_ptr<SceneBuffers> uploaded, const Camera& camera,
                   const RenderSettings& settings)
    : executor_(executor),
      scene_(scene),
      camera_(camera),
      settings_(settings),
      plan_(plan_for(scene, settings)),
      scene_buffers_(std::move(uploaded)),
      budget_(plan_.adaptive ? settings.frame_time_ms : 0.0) {
    set_up();
    choose_indirect();
}

double Renderer::landed_share() {
    if (!plan_.gathers_vpls()) return 1.0;
    const FrameInputs inputs{executor_, scene_, *scene_buffers_, buffers_, plan_};
    const KeepGoing to_the_end;
    FrameContext frame(inputs, params_of_frame(0), to_the_end);
    walk_light_paths(frame, "indirect");
    frame.wait();
    const std::size_t count = std::size_t{plan_.sets} * plan_.walked_per_set;
    const auto vpls = read_buffer(executor_, walked_vpls(buffers_), count);
    const auto landed = std::count_if(vpls.begin(), vpls.end(), [](const shared::Vpl& vpl) {
        return vpl.flux.x > 0.0F || vpl.flux.y > 0.0F || vpl.flux.z > 0.0F;
    });
    return static_cast<double>(landed) / static_cast<double>(count);
}

void Renderer::choose_indirect() {
    const bool undecided = settings_.sampling.bounce_rays_if_open && plan_.adaptive &&
                           plan_.gathers_vpls() && !plan_.cached && !plan_.media;
    if (!undecided) return;
    const double share = landed_share();
    settings_.sampling.bounce_rays = share < least_landed;
    if (settings_.sampling.bounce_rays) {
        // Such paths leave out no indirect light, and direct light then has its usual bound.
        settings_.sampling.compensation = false;
        settings_.sampling.bound_spacing = SamplingSettings{}.bound_spacing;
        plan_ = plan_for(scene_, settings_);
        set_up();
    }
    plan_.landed = share;
}

void Renderer::set_up() {
    components_.clear();
    if (plan_.materials) make_light_scene(executor_, scene_, *scene_buffers_);
    if (plan_.direct && plan_.has_distant())
        make_open_irradiance(executor_, scene_, *scene_buffers_);
    work_ = work_list_of(plan_, settings_);
    const std::uint32_t features = features_of_frames();
    executor_.build(kernels_of(plan_, settings_.components), features);
    const ComponentRequirements requirements = requirements_of(plan_, settings_.components);
    all_receivers_ = requirements.all_receivers;
    buffers_ = allocate_frame(executor_, plan_, work_, settings_.width, settings_.height, features,
                              requirements.tiles);
    if (plan_.media)
        buffers_.view_media = std::make_unique<ViewMedia>(
            executor_, scene_, media_of(executor_, scene_, *scene_buffers_), camera_,
            std::size_t{settings_.width} * settings_.height, features);
    components_ = make_components(settings_.components, {.executor = executor_,
                                                         .scene = scene_,
                                                         .plan = plan_,
                                                         .buffers = buffers_,
                                                         .work = work_,
                                                         .width = settings_.width,
                                                         .height = settings_.height,
                                                         .features = features,
                                                         .earlier = {}});
    for (const ActiveComponent& active : components_)
        active.component->bind_outputs(buffers_.irradiance);
    set_params(features);
}

std::uint32_t Renderer::features_of_frames() const {
    return features_of(scene_, plan_, settings_.components) | camera_features(camera_);
}

void Renderer::set_params(std::uint32_t features) {
    base_params_ = scene_params(scene_, camera_, settings_.width, settings_.height);
    shared::RenderParams& params = base_params_;
    params.features = features;
    params.camera.texture_angle = texture_angle(params, settings_);
    params.camera.hides_environment = settings_.hides_environment ? 1 : 0;
    params.scene.delta_lights = plan_.punctual_lights;
    params.scene.directional_lights = plan_.directional_lights;
    params.filter = {.radius = plan_.filter_radius,
                     .cosine = static_cast<float>(settings_.sampling.filter_cosine),
                     .planes = static_cast<float>(settings_.sampling.filter_planes),
                     .enough_support = static_cast<float>(settings_.sampling.enough_support)};
    shared::SamplingParams& sampling = params.sampling;
    sampling.lights.per_light = plan_.samples_per_light;
    sampling.lights.per_set = plan_.samples_per_set;
    sampling.seed = settings_.seed;
    sampling.sets = plan_.sets;
    sampling.gather_sets = plan_.gather_sets;
    sampling.interleave = plan_.interleave;
    sampling.gather_scale = static_cast<float>(plan_.gather_sets);
    sampling.environment_samples = plan_.environment_samples;
    sampling.paths_per_set = plan_.paths_per_set;
    sampling.walked_per_set = plan_.walked_per_set;
    sampling.bounces = plan_.bounces;
    std::copy(plan_.survivors.begin(), plan_.survivors.end(), sampling.survivors);
    std::copy(plan_.first_vpl.begin(), plan_.first_vpl.end(), sampling.first_vpl);
    sampling.edge_samples = plan_.edge_samples;
    sampling.vpl_bound = static_cast<float>(plan_.vpl_bound);
    sampling.lights.bound_scale = static_cast<float>(plan_.light_bound_scale);
    sampling.record_error = static_cast<float>(plan_.cache_error);
}

void Renderer::set_camera(const Camera& camera) {
    move_camera(camera);
    sequence_ = image_;
}

void Renderer::update_scene() {
    weft::update_scene(executor_, scene_, *scene_buffers_);
    follow_scene();
}

void Renderer::follow_scene() {
    const FramePlan plan = plan_for(scene_, settings_);
    if (!same_lights(plan, plan_) || features_of_frames() != base_params_.features) {
        plan_ = plan;
        set_up();
    }
    set_params(base_params_.features);
}

void Renderer::move_camera(const Camera& camera) {
    camera_ = camera;
    if (features_of_frames() != base_params_.features) set_up();
    weft::set_camera(camera, scene_.units, base_params_);
    if (buffers_.view_media) buffers_.view_media->set_camera(executor_, scene_, camera);
    base_params_.camera.texture_angle = texture_angle(base_params_, settings_);
    frames_in_film_ = 0;
    light_.clear();
    ++image_;
}

shared::RenderParams Renderer::params_of_frame(std::uint32_t frame) const {
    shared::RenderParams params = base_params_;
    shared::SamplingParams& sampling = params.sampling;
    sampling.sample = frame;
    // 4 and n^2 are coprime for odd n: in n^2 frames a pixel meets every set.
    sampling.set_rotation = frame * 4 % plan_.gather_sets;
    const double growth = bound_growth(frame);
    sampling.vpl_bound = static_cast<float>(plan_.vpl_bound * growth);
    sampling.lights.bound_scale = static_cast<float>(plan_.light_bound_scale * growth);
    params.camera.texture_angle = texture_angle(params, settings_, frame);
    set_jitter(frame, settings_.samples <= 1, settings_.seed, params);
    return params;
}

shared::RenderParams Renderer::params_of_sample(std::uint32_t sample) const {
    shared::RenderParams params = base_params_;
    shared::SamplingParams& sampling = params.sampling;
    // Each sample scrambles its points anew, so that samples are independent.
    sampling.seed = seed_of_sample(settings_.seed, sample);
    sampling.sample = sample;
    sampling.set_rotation = sample * 4 % plan_.gather_sets;
    set_jitter(0, true, 0, params);
    if (settings_.through_centres) return params;
    params.camera.texture_angle = 0.0F;
    // One place for all pixels would let the borders of lights err together.
    params.camera.own_jitter = 1;
    return params;
}

void Renderer::trace_primary(FrameContext& frame) {
    const GBuffer& gbuffer = buffers_.gbuffer;
    const std::uint32_t blocks = pixel_blocks(settings_.width, settings_.height, executor_.lanes());
    if (plan_.materials)
        frame.run(Stage::primary_rays, "",
                  kernels::gbuffer_surfaces{.scene = *scene_buffers_->traced,
                                            .geometry = view(scene_buffers_->geometry),
                                            .surfaces = view(scene_buffers_->surfaces),
                                            .environment = view(scene_buffers_->environment),
                                            .gb_ids = gbuffer.gb_ids,
                                            .gb_position = gbuffer.gb_position,
                                            .gb_normal = gbuffer.gb_normal,
                                            .gb_shading = gbuffer.gb_shading,
                                            .gb_albedo = gbuffer.gb_albedo,
                                            .gb_emission = gbuffer.gb_emission},
                  {blocks});
    else
        frame.run(Stage::primary_rays, "",
                  kernels::gbuffer{.scene = *scene_buffers_->traced,
                                   .geometry = view(scene_buffers_->geometry),
                                   .environment = view(scene_buffers_->environment),
                                   .gb_ids = gbuffer.gb_ids,
                                   .gb_position = gbuffer.gb_position,
                                   .gb_normal = gbuffer.gb_normal,
                                   .gb_shading = gbuffer.gb_shading,
                                   .gb_albedo = gbuffer.gb_albedo,
                                   .gb_emission = gbuffer.gb_emission},
                  {blocks});
    if (buffers_.view_media) buffers_.view_media->find(frame);
    if (all_receivers_)
        frame.run(Stage::receivers, "",
                  kernels::receivers{.surfaces = view(gbuffer),
                                     .slots = buffers_.slots,
                                     .slot_pixel = buffers_.slot_pixel,
                                     .view_enclosing_media = buffers_.view_enclosing_media(),
                                     .receiver_planes = buffers_.receivers,
                                     .pixel_slot = buffers_.pixel_slot},
                  {buffers_.slots});
    if (buffers_.tiles) buffers_.tiles->examine(frame, buffers_.gbuffer);
}

void Renderer::compose(FrameContext& frame) {
    // A film that has other frames gets all of this one or nothing. Edges have to be found in whole
    // as well: masks that nothing has written name pixels that are not there.
    frame.whole_launches = true;
    if (buffers_.edges) buffers_.edges->find(frame);
    frame.run(Stage::composition, "",
              kernels::compose{.surfaces = view(buffers_.gbuffer),
                               .composed = buffers_.composed(),
                               .slots = buffers_.slots,
                               .film_high = buffers_.film_high,
                               .film_low = buffers_.film_low,
                               .nonfinite = buffers_.nonfinite,
                               .edge_masks = buffers_.edges ? buffers_.edges->masks()
                                                            : BufferRef<kinds::EdgeMasks>()},
              {pixel_runs(settings_.width, settings_.height, executor_.lanes())});
    frame.whole_launches = frame.begins == FrameContext::Begins::nothing;
    if (buffers_.edges) buffers_.edges->sample(frame);
}

void Renderer::compose(FrameContext& frame, const ExactFilm& film) {
    // A film gets all of a sample or nothing.
    frame.whole_launches = true;
    frame.run(Stage::composition, "",
              kernels::compose_sums{.surfaces = view(buffers_.gbuffer),
                                    .composed = buffers_.composed(),
                                    .slots = buffers_.slots,
                                    .film_scale = film.scale(),
                                    .film_sums = film.buffer(),
                                    .nonfinite = buffers_.nonfinite},
              {frame.pixels()});
}

std::vector<LightShare> Renderer::sample(FrameContext& frame) {
    std::vector<LightShare> light;
    for (const ActiveComponent& active : components_) {
        if (executor_.cancelled()) break;
        frame.begin_component();
        active.component->sample(frame);
        LightShare& part = light.emplace_back(LightShare{frame.light().component(), 1.0});
        if (part.component.empty()) part.component = active.name;
        if (frame.ended_early()) part.share = active.component->light_share(frame);
    }
    return light;
}

bool Renderer::render_frame(const KeepGoing& keep_going) {
    const Stopwatch watch;
    const FrameInputs inputs{executor_, scene_, *scene_buffers_, buffers_, plan_};
    const std::uint32_t number = frames_in_film_;
    FrameContext frame(inputs, params_of_frame(number), keep_going);
    frame.budget = &budget_;
    frame.begins = number > 0            ? FrameContext::Begins::nothing
                   : image_ == sequence_ ? FrameContext::Begins::sequence
                                         : FrameContext::Begins::image;
    frame.run_whole([&] { trace_primary(frame); });
    std::vector<LightShare> light = sample(frame);
    if (frame.ended_early() && number > 0) return false;
    if (!finish(frame)) return false;
    const auto lacks = [](const LightShare& part) { return part.share < 1.0; };
    if (std::any_of(light.begin(), light.end(), lacks)) light_ = std::move(light);
    ++frames_in_film_;
    record(frame, watch);
    if (!frame.ended_early()) budget_.spend(stats_.back().ms, threshold_scopes());
    return !frame.ended_early();
}

void Renderer::reconstruct(FrameContext& frame) {
    for (const ActiveComponent& active : components_)
        if (!executor_.cancelled()) active.component->reconstruct(frame);
}

bool Renderer::finish(FrameContext& frame) {
    bool written = false;
    frame.run_whole([&] {
        reconstruct(frame);
        if (executor_.cancelled()) return;
        compose(frame);
        written = frame.whole_launches || !buffers_.edges || !executor_.cancelled();
    });
    return written;
}

bool Renderer::add_sample(ExactFilm& film, const KeepGoing& keep_going) {
    const Stopwatch watch;
    const FrameInputs inputs{executor_, scene_, *scene_buffers_, buffers_, plan_};
    FrameContext frame(inputs, params_of_sample(film.next()), keep_going);
    frame.begins = FrameContext::Begins::nothing;
    frame.run_whole([&] {
        trace_primary(frame);
        (void)sample(frame);
        reconstruct(frame);
    });
    if (executor_.cancelled()) return false;
    frame.run_whole([&] { compose(frame, film); });
    film.add(1);
    record(frame, watch);
    return true;
}

std::vector<ThresholdScope> Renderer::threshold_scopes() const {
    std::vector<ThresholdScope> scopes;
    for (const ActiveComponent& active : components_)
        if (const SamplingDecision* const decision = active.component->decision())
            scopes.push_back({active.name, decision->can_save(), decision->can_spend()});
    return scopes;
}

void Renderer::record(FrameContext& frame, const Stopwatch& watch) {
    stats_.push_back(frame_stats(frame, watch));
    stats_.back().image = image_;
    for (const ActiveComponent& active : components_) {
        if (const auto cache = active.component->cache()) stats_.back().cache = cache;
        const SamplingDecision* const decision = active.component->decision();
        if (decision == nullptr) continue;
        const LevelCounts counts = decision->counts();
        const double gain = budget_.gain(active.name);
        stats_.back().levels.push_back({active.name, counts.tiles, counts.samples, gain,
                                        decision->can_save() && gain < greatest_gain});
    }
    for (StageStats& stage : stats_.back().stages) {
        if (stage.stage != Stage::primary_rays) continue;
        stage.rays = std::uint64_t{settings_.width} * settings_.height;
        stats_.back().rays += stage.rays;
    }
}

FilmView Renderer::film() {
    return {.params = base_params_,
            .high = buffers_.film_high,
            .low = buffers_.film_low,
            .sums = {},
            .samples = frames_in_film_};
}

Image Renderer::image() {
    const std::size_t values = film_planes(base_params_.features) *
                               FILM_STRIDE(std::size_t{settings_.width} * settings_.height);
    const auto high = read_buffer(executor_, buffers_.film_high, values);
    const auto low = read_buffer(executor_, buffers_.film_low, frames_in_film_ > 1 ? values : 0);
    Image image = resolve_film(high, low, settings_.width, settings_.height, frames_in_film_,
                               base_params_.features);
    for (const ActiveComponent& active : components_) {
        active.component->add_layers(image);
        if (const SamplingDecision* const decision = active.component->decision())
            decision->add_layers(active.name, image);
    }
    return image;
}

}  // namespace weft
