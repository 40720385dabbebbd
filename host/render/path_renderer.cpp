// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/path_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>

#include "base/error.h"
#include "base/stopwatch.h"
#include "render/camera_params.h"
#include "render/surface_features.h"

namespace weft {
namespace {

constexpr std::uint32_t most_frame_samples = 256;

/// FNV-1a, 64 bits, over the bytes of anything that samples depend on.
class Digest {
  public:
    template <class T>
    void add(std::span<const T> values) {
        for (const std::byte byte : std::as_bytes(values)) {
            state_ ^= static_cast<std::uint64_t>(byte);
            state_ *= 0x100000001b3ULL;
        }
    }
    [[nodiscard]] std::uint64_t value() const noexcept { return state_; }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

/// Adds the statistics of a part of a frame to those of the parts before it.
void add_part(FrameStats& whole, FrameStats part) {
    if (whole.stages.empty()) {
        whole = std::move(part);
        return;
    }
    whole.ms += part.ms;
    whole.rays += part.rays;
    for (std::size_t i = 0; i < whole.stages.size() && i < part.stages.size(); ++i) {
        whole.stages[i].ms += part.stages[i].ms;
        whole.stages[i].rays += part.stages[i].rays;
    }
    for (std::size_t c = 0; c < whole.nonfinite.size(); ++c) {
        if (whole.nonfinite[c].count == 0)
            whole.nonfinite[c] = part.nonfinite[c];
        else
            whole.nonfinite[c].count += part.nonfinite[c].count;
    }
}

}  // namespace

std::uint32_t path_features(const FlatScene& scene, const PathSettings& settings) {
    return surface_features(scene) |
           (scene.features & (FEATURE_LIGHT_TREE | FEATURE_MATERIALS | FEATURE_SEE_THROUGH)) |
           scene.media.features() | (settings.direct ? FEATURE_SAMPLED_DIRECT : 0U) |
           (settings.indirect ? FEATURE_INDIRECT : 0U);
}

std::string image_identity(std::string_view estimator, const FlatScene& scene,
                           const shared::RenderParams& params,
                           const shared::PathParams& path_params) {
    Digest digest;
    const auto add = [&]<class T>(const std::vector<T>& values) {
        digest.add(std::span<const T>(values));
    };
    add(scene.positions);
    add(scene.triangles);
    add(scene.instances);
    add(scene.materials);
    add(scene.normals);
    add(scene.texture_coordinates);
    add(scene.vertex_colours);
    add(scene.textures);
    add(scene.texels);
    add(scene.lights);
    add(scene.emissive);
    add(scene.light_nodes);
    add(scene.environment_image.records);
    add(scene.environment_image.texels);
    add(scene.environment_image.sums);
    add(scene.surfaces.records);
    add(scene.surfaces.maps);
    add(scene.surfaces.coordinates);
    add(scene.surfaces.of_instances);
    add(scene.surfaces.tangents);
    add(scene.surfaces.interfaces);
    add(scene.surfaces.values);
    if (scene.media.present()) {
        add(scene.media.records);
        add(scene.media.positions);
        add(scene.media.triangles);
        add(scene.media.grids.records);
        add(scene.media.grids.densities);
        digest.add(std::span<const shared::MediaRecord>(&scene.media.space, 1));
    }
    shared::RenderParams constant = params;
    constant.sampling.sample = 0;
    digest.add(std::span<const shared::RenderParams>(&constant, 1));
    shared::PathParams of_all_launches = path_params;
    of_all_launches.samples = 0;
    digest.add(std::span<const shared::PathParams>(&of_all_launches, 1));
    return fmt::format("{}-{:016x}", estimator, digest.value());
}

PathRenderer::PathRenderer(Executor& executor, const FlatScene& scene, const Camera& camera,
                           const PathSettings& settings, FilmSums sums)
    : PathRenderer(executor, scene, nullptr, camera, settings, std::move(sums)) {}

PathRenderer::PathRenderer(Executor& executor, const FlatScene& scene,
                           std::shared_ptr<SceneBuffers> uploaded, const Camera& camera,
                           const PathSettings& settings, FilmSums sums)
    : executor_(executor),
      scene_(scene),
      settings_(settings),
      scene_buffers_(std::move(uploaded)),
      film_(executor, settings.width, settings.height, settings.samples) {
    camera_features_ = camera_features(camera);
    const std::uint32_t features = path_features(scene, settings) | camera_features_;
    params_ = scene_params(scene, camera, settings.width, settings.height);
    params_.features = features;
    params_.sampling.seed = settings.seed;
    params_.camera.hides_environment = settings.hides_environment ? 1 : 0;
    params_.sampling.most_bounces = settings.most_bounces;
    path_params_.through_centres = settings.through_centres ? 1 : 0;
    fit_film();
    filter_textures();
    film_.begin(std::move(sums), identity());

    executor_.build(std::array{kernel()}, features);
    if (!scene_buffers_)
        scene_buffers_ = std::make_shared<SceneBuffers>(upload_scene(executor_, scene));
    media_ = media_of(executor_, scene, *scene_buffers_);
    set_media_camera(executor_, scene, camera, *media_);
    buffers_ = allocate_counters(executor_);
}

KernelId PathRenderer::kernel() const noexcept {
    if (!scene_.media.present())
        return scene_.surfaces.present() ? KernelId::path_surfaces : KernelId::path;
    if (scene_.surfaces.present()) return KernelId::path_media_surfaces;
    return scene_.media.grids.records.empty() ? KernelId::path_media : KernelId::path_grid;
}

void PathRenderer::filter_textures() {
    // Previews average textures over a pixel; here the samples do, unless all are at the centre.
    params_.camera.texture_angle = settings_.through_centres ? params_.camera.pixel_angle : 0.0F;
}

const std::string& PathRenderer::identity() {
    if (!identity_) identity_ = image_identity("path2", scene_, params_, path_params_);
    return *identity_;
}

void PathRenderer::fit_film() {
    film_.fit(scene_);
    path_params_.film_scale = film_.scale();
}

void PathRenderer::update_scene() {
    weft::update_scene(executor_, scene_, *scene_buffers_);
    follow_scene();
}

void PathRenderer::follow_scene() {
    open_.reset();
    identity_.reset();
    set_scene(scene_, params_);
    fit_film();
    set_features();
}

void PathRenderer::set_features() {
    const std::uint32_t features = path_features(scene_, settings_) | camera_features_;
    if (features == params_.features) return;
    params_.features = features;
    executor_.build(std::array{kernel()}, features);
}

void PathRenderer::set_camera(const Camera& camera) {
    camera_features_ = camera_features(camera);
    set_features();
    weft::set_camera(camera, scene_.units, params_);
    set_media_camera(executor_, scene_, camera, *media_);
    filter_textures();
    open_.reset();
    identity_.reset();
    film_.clear();
    ++image_;
}

std::uint32_t PathRenderer::frame_samples() const noexcept {
    if (samples_left() == 0) return 0;
    const double ms = std::min(settings_.frame_ms, most_frame_ms_);
    const double wanted = ms_per_sample_ > 0.0 ? ms / ms_per_sample_ : 1.0;
    const double all = std::min<double>(most_frame_samples, most_samples_);
    return std::min(samples_left(), static_cast<std::uint32_t>(std::clamp(wanted, 1.0, all)));
}

bool PathRenderer::render_frame(const KeepGoing& keep_going) {
    if (!open_) {
        const std::uint32_t count = frame_samples();
        if (count == 0) return false;
        open_ = OpenFrame{count, 0, {}};
    }
    bool wanted = true;
    // keep_going is called although the frame does not end, because it reports progress.
    const KeepGoing listen = [&](Stage stage, double done) {
        if (keep_going) wanted = keep_going(stage, done) && wanted;
        return true;
    };
    return continue_frame(listen, false) && wanted && samples_left() > 0;
}

bool PathRenderer::continue_frame(const KeepGoing& keep_going, bool whole) {
    const Stopwatch watch;
    const FrameInputs inputs{executor_, scene_, *scene_buffers_, buffers_, plan_};
    params_.sampling.sample = film_.next();
    path_params_.samples = open_->count;
    const std::uint32_t pixels = settings_.width * settings_.height;
    const std::uint32_t first = open_->pixel;
    const KeepGoing follow = [&](Stage stage, double done) {
        open_->pixel = first + static_cast<std::uint32_t>(std::lround(done * (pixels - first)));
        return keep_going(stage, static_cast<double>(open_->pixel) / pixels);
    };
    FrameContext frame(inputs, params_, follow);
    frame.whole_launches = whole;
    // A launch has fewer work-items where each makes many samples, so that it stays short.
    constexpr std::uint32_t items = 1U << 14;
    const FrameContext::Items all{
        .count = pixels - first, .per_launch = std::max(64U, items / open_->count), .first = first};
    const auto run_media = [&]<class Kernel>(std::type_identity<Kernel>) {
        frame.run(Stage::paths, "",
                  Kernel{.scene = *scene_buffers_->traced,
                         .geometry = view(scene_buffers_->geometry),
                         .light_table = view(scene_buffers_->light_table),
                         .light_nodes = scene_buffers_->light_nodes,
                         .environment = view(scene_buffers_->environment),
                         .media_tables = view(*media_),
                         .path_params = path_params_,
                         .film_sums = film_.buffer(),
                         .counters = buffers_.counters,
                         .nonfinite = buffers_.nonfinite},
                  all);
    };
    switch (kernel()) {
        case KernelId::path_surfaces:
            frame.run(Stage::paths, "",
                      kernels::path_surfaces{.scene = *scene_buffers_->traced,
                                             .geometry = view(scene_buffers_->geometry),
                                             .light_table = view(scene_buffers_->light_table),
                                             .light_nodes = scene_buffers_->light_nodes,
                                             .environment = view(scene_buffers_->environment),
                                             .surface_tables = view(scene_buffers_->surfaces),
                                             .path_params = path_params_,
                                             .film_sums = film_.buffer(),
                                             .counters = buffers_.counters,
                                             .nonfinite = buffers_.nonfinite},
                      all);
            break;
        case KernelId::path_media_surfaces:
            frame.run(Stage::paths, "",
                      kernels::path_media_surfaces{.scene = *scene_buffers_->traced,
                                                   .geometry = view(scene_buffers_->geometry),
                                                   .light_table = view(scene_buffers_->light_table),
                                                   .light_nodes = scene_buffers_->light_nodes,
                                                   .environment = view(scene_buffers_->environment),
                                                   .surface_tables = view(scene_buffers_->surfaces),
                                                   .media_tables = view(*media_),
                                                   .path_params = path_params_,
                                                   .film_sums = film_.buffer(),
                                                   .counters = buffers_.counters,
                                                   .nonfinite = buffers_.nonfinite},
                      all);
            break;
        case KernelId::path_media:
            run_media(std::type_identity<kernels::path_media>{});
            break;
        case KernelId::path_grid:
            run_media(std::type_identity<kernels::path_grid>{});
            break;
        default:
            frame.run(Stage::paths, "",
                      kernels::path{.scene = *scene_buffers_->traced,
                                    .geometry = view(scene_buffers_->geometry),
                                    .light_table = view(scene_buffers_->light_table),
                                    .light_nodes = scene_buffers_->light_nodes,
                                    .environment = view(scene_buffers_->environment),
                                    .path_params = path_params_,
                                    .film_sums = film_.buffer(),
                                    .counters = buffers_.counters,
                                    .nonfinite = buffers_.nonfinite},
                      all);
    }
    add_part(open_->stats, frame_stats(frame, watch));
    if (open_->pixel < pixels) return false;
    finish_frame();
    return true;
}

void PathRenderer::finish_frame() {
    const std::uint32_t count = open_->count;
    stats_.push_back(std::move(open_->stats));
    open_.reset();
    stats_.back().image = image_;
    film_.add(count);
    ms_per_sample_ = stats_.back().ms / count;
}

FilmSums PathRenderer::sums() {
    if (open_) (void)continue_frame([](Stage, double) { return true; }, true);
    return film_.read(identity());
}

FilmView PathRenderer::film() {
    if (open_) (void)continue_frame([](Stage, double) { return true; }, true);
    return {.params = params_,
            .high = {},
            .low = {},
            .sums = film_.buffer(),
            .samples = film_.samples(),
            .unit = film_.unit()};
}

}  // namespace weft
