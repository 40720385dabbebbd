// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/path_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

#include "base/error.h"
#include "base/stopwatch.h"
#include "render/camera_params.h"
#include "render/surface_features.h"

namespace weft {
namespace {

constexpr std::uint32_t most_frame_samples = 256;
// Largest exponent of the scale of light: the scale and its square must stay normal floats.
constexpr double largest_exponent = 60.0;

// Square of the ratio of the scene's radius to the distance at which a surface may be from a point
// light.
constexpr double nearness = 0x1p20;

/// Radiance of the brightest light or medium; for lights without area, that of a surface close to
/// them.
double brightest(const FlatScene& scene) {
    const auto radius = static_cast<double>(scene.radius);
    double most = scene.media.radiance;
    for (const shared::LightRecord& light : scene.lights) {
        double value = std::max({light.power.x, light.power.y, light.power.z});
        if (light.kind == EMITTER_POINT || light.kind == EMITTER_SPOT)
            value *= nearness / (radius * radius);
        most = std::max(most, value);
    }
    return most;
}

int light_exponent(const FlatScene& scene) {
    const double most = brightest(scene);
    if (!(most > 0.0) || !std::isfinite(most)) return 0;
    return static_cast<int>(
        std::clamp(std::ceil(std::log2(most)), -largest_exponent, largest_exponent));
}

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
    return surface_features(scene) | scene.media.features() |
           (settings.direct ? FEATURE_SAMPLED_DIRECT : 0U) |
           (settings.indirect ? FEATURE_INDIRECT : 0U);
}

std::string image_identity(const FlatScene& scene, const shared::RenderParams& params,
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
    return fmt::format("{:016x}", digest.value());
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
      next_(settings.samples.first) {
    camera_features_ = camera_features(camera);
    const std::uint32_t features = path_features(scene, settings) | camera_features_;
    params_ = scene_params(scene, camera, settings.width, settings.height);
    params_.features = features;
    params_.sampling.seed = settings.seed;
    params_.camera.hides_environment = settings.hides_environment ? 1 : 0;
    path_params_.through_centres = settings.through_centres ? 1 : 0;
    film_.width = settings.width;
    film_.height = settings.height;
    film_.depth_unit = scene.units.scale;
    scale_light();
    filter_textures();

    const std::size_t words = std::size_t{FILM_PIXEL_WORDS} * settings.width * settings.height;
    const bool continues = !sums.words.empty();
    if (!continues) {
        sums = film_;
        sums.words.assign(words, 0);
    }
    std::vector<SampleRange> all = sums.ranges;
    all.push_back(settings.samples);
    if (continues && (sums.identity != identity() || sums.words.size() != words))
        throw Error(ExitCode::bad_input,
                    "the samples so far are of another image, expected the same scene, size, "
                    "camera, seed and options");
    (void)joined(std::move(all));
    film_.ranges = sums.ranges;
    film_.backends = sums.backends;

    executor_.build(std::array{kernel()}, features);
    if (!scene_buffers_)
        scene_buffers_ = std::make_shared<SceneBuffers>(upload_scene(executor_, scene));
    media_ = media_of(executor_, scene, *scene_buffers_);
    set_media_camera(executor_, scene, camera, *media_);
    sums_ = upload<kinds::FilmSums>(executor_, sums.words, "film");
    buffers_ = allocate_counters(executor_);
}

KernelId PathRenderer::kernel() const noexcept {
    return scene_.media.present() ? KernelId::path_media : KernelId::path;
}

void PathRenderer::filter_textures() {
    // Previews average textures over a pixel; here the samples do, unless all are at the centre.
    params_.camera.texture_angle = settings_.through_centres ? params_.camera.pixel_angle : 0.0F;
}

const std::string& PathRenderer::identity() {
    if (!identity_) identity_ = image_identity(scene_, params_, path_params_);
    return *identity_;
}

void PathRenderer::scale_light() {
    film_.light_exponent = light_exponent(scene_);
    path_params_.film_scale = std::ldexp(1.0F, -film_.light_exponent);
}

void PathRenderer::update_scene() {
    weft::update_scene(executor_, scene_, *scene_buffers_);
    follow_scene();
}

void PathRenderer::follow_scene() {
    open_.reset();
    identity_.reset();
    set_scene(scene_, params_);
    scale_light();
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
    film_.ranges.clear();
    next_ = settings_.samples.first;
    ++image_;
    const std::vector<std::uint32_t> zeros(
        std::size_t{FILM_PIXEL_WORDS} * film_.width * film_.height, 0);
    write_buffer(executor_, sums_, zeros);
}

std::uint32_t PathRenderer::frame_samples() const noexcept {
    if (samples_left() == 0) return 0;
    const double ms = std::min(settings_.frame_ms, most_frame_ms_);
    const double wanted = ms_per_sample_ > 0.0 ? ms / ms_per_sample_ : 1.0;
    return std::min(samples_left(), static_cast<std::uint32_t>(std::clamp(
                                        wanted, 1.0, static_cast<double>(most_frame_samples))));
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
    params_.sampling.sample = next_;
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
    if (scene_.media.present())
        frame.run(Stage::paths, "",
                  kernels::path_media{.scene = *scene_buffers_->traced,
                                      .geometry = view(scene_buffers_->geometry),
                                      .light_table = view(scene_buffers_->light_table),
                                      .media_tables = view(*media_),
                                      .path_params = path_params_,
                                      .film_sums = sums_,
                                      .counters = buffers_.counters,
                                      .nonfinite = buffers_.nonfinite},
                  all);
    else
        frame.run(Stage::paths, "",
                  kernels::path{.scene = *scene_buffers_->traced,
                                .geometry = view(scene_buffers_->geometry),
                                .light_table = view(scene_buffers_->light_table),
                                .path_params = path_params_,
                                .film_sums = sums_,
                                .counters = buffers_.counters,
                                .nonfinite = buffers_.nonfinite},
                  all);
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
    film_.backends.insert(executor_.device().backend);
    std::vector<SampleRange> ranges = film_.ranges;
    ranges.push_back({next_, next_ + count});
    film_.ranges = joined(std::move(ranges));
    next_ += count;
    ms_per_sample_ = stats_.back().ms / count;
}

FilmSums PathRenderer::sums() {
    if (open_) (void)continue_frame([](Stage, double) { return true; }, true);
    FilmSums sums = film_;
    sums.identity = identity();
    sums.words =
        read_buffer(executor_, sums_, std::size_t{FILM_PIXEL_WORDS} * film_.width * film_.height);
    return sums;
}

FilmView PathRenderer::film() {
    if (open_) (void)continue_frame([](Stage, double) { return true; }, true);
    return {.params = params_,
            .high = {},
            .low = {},
            .sums = sums_,
            .samples = film_.samples(),
            .unit = std::ldexp(1.0, film_.light_exponent)};
}

}  // namespace weft
