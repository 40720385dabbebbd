// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/path_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

#include "base/error.h"
#include "base/stopwatch.h"
#include "frame/camera_params.h"

namespace weft {
namespace {

constexpr double frame_ms = 500.0;
constexpr std::uint32_t most_frame_samples = 256;
// Powers of two beyond which light cannot be scaled: the scale and its square stay ordinary floats.
constexpr double largest_exponent = 60.0;

// Surfaces may be this much nearer to a point light than the scene is large, squared.
constexpr double nearness = 0x1p20;

/// Radiance of the brightest light or medium; for lights without an area, of a surface close to
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

}  // namespace

std::uint32_t path_features(const FlatScene& scene, const PathSettings& settings) {
    constexpr std::uint32_t of_surfaces = FEATURE_TEXTURES | FEATURE_VERTEX_COLOURS |
                                          FEATURE_SMOOTH_NORMALS | FEATURE_ONE_SIDED |
                                          FEATURE_ENVIRONMENT;
    return (scene.features & of_surfaces) | scene.media.features() |
           (settings.direct ? FEATURE_SAMPLED_DIRECT : 0U) |
           (settings.indirect ? FEATURE_INDIRECT : 0U);
}

std::string picture_identity(const FlatScene& scene, const shared::RenderParams& params,
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
    : executor_(executor), scene_(scene), settings_(settings), next_(settings.samples.first) {
    const std::uint32_t features = path_features(scene, settings);
    params_ = scene_params(scene, camera, settings.width, settings.height);
    params_.features = features;
    params_.sampling.seed = settings.seed;
    path_params_.through_centres = settings.through_centres ? 1 : 0;
    film_.width = settings.width;
    film_.height = settings.height;
    film_.depth_unit = scene.units.scale;
    scale_light();
    identify();

    const std::size_t words = std::size_t{FILM_PIXEL_WORDS} * settings.width * settings.height;
    if (sums.words.empty()) {
        sums = film_;
        sums.words.assign(words, 0);
    }
    std::vector<SampleRange> all = sums.ranges;
    all.push_back(settings.samples);
    if (sums.picture != film_.picture || sums.words.size() != words)
        throw Error(ExitCode::bad_input,
                    "the samples so far are of another picture, expected the same scene, size, "
                    "camera, seed and options");
    (void)joined(std::move(all));
    film_.ranges = sums.ranges;

    executor_.build(std::array{kernel()}, features);
    scene_buffers_ = upload_scene(executor_, scene);
    media_ = upload_media(executor_, scene.media);
    set_media_camera(executor_, scene, camera, media_);
    sums_ = upload<kinds::FilmSums>(executor_, sums.words, "film");
    buffers_ = allocate_counters(executor_);
}

KernelId PathRenderer::kernel() const noexcept {
    return scene_.media.present() ? KernelId::path_media : KernelId::path;
}

void PathRenderer::identify() {
    // Previews average textures over a pixel; here the samples do, unless all are at the centre.
    params_.camera.texture_angle = settings_.through_centres ? params_.camera.pixel_angle : 0.0F;
    film_.picture = picture_identity(scene_, params_, path_params_);
}

void PathRenderer::scale_light() {
    film_.light_exponent = light_exponent(scene_);
    path_params_.film_scale = std::ldexp(1.0F, -film_.light_exponent);
}

void PathRenderer::update_scene() {
    weft::update_scene(executor_, scene_, scene_buffers_);
    set_scene(scene_, params_);
    scale_light();
}

void PathRenderer::set_camera(const Camera& camera) {
    weft::set_camera(camera, scene_.units, params_);
    set_media_camera(executor_, scene_, camera, media_);
    identify();
    film_.ranges.clear();
    next_ = settings_.samples.first;
    ++picture_;
    const std::vector<std::uint32_t> zeros(
        std::size_t{FILM_PIXEL_WORDS} * film_.width * film_.height, 0);
    write_buffer(executor_, sums_, zeros);
}

std::uint32_t PathRenderer::frame_samples() const noexcept {
    if (samples_left() == 0) return 0;
    const double wanted = ms_per_sample_ > 0.0 ? frame_ms / ms_per_sample_ : 1.0;
    return std::min(samples_left(), static_cast<std::uint32_t>(std::clamp(
                                        wanted, 1.0, static_cast<double>(most_frame_samples))));
}

bool PathRenderer::render_frame(const KeepGoing& keep_going) {
    const std::uint32_t count = frame_samples();
    if (count == 0) return false;
    const Stopwatch watch;
    const FrameInputs inputs{executor_, scene_, scene_buffers_, buffers_, plan_};
    params_.sampling.sample = next_;
    path_params_.samples = count;
    bool wanted = true;
    // Asked all the same, so that progress is seen.
    const KeepGoing listen = [&](Stage stage, double done) {
        if (keep_going) wanted = keep_going(stage, done) && wanted;
        return true;
    };
    FrameContext frame(inputs, params_, listen);
    // Launches of few samples at a time: a work-item of many would hold up everything else.
    constexpr std::uint32_t items = 1U << 14;
    const FrameContext::Items all{.count = frame.pixels(),
                                  .per_launch = std::max(64U, items / count)};
    if (scene_.media.present())
        frame.run(Stage::paths, "",
                  kernels::path_media{.scene = *scene_buffers_.traced,
                                      .geometry = view(scene_buffers_.geometry),
                                      .light_table = view(scene_buffers_.light_table),
                                      .media_tables = view(media_),
                                      .path_params = path_params_,
                                      .film_sums = sums_,
                                      .counters = buffers_.counters,
                                      .nonfinite = buffers_.nonfinite},
                  all);
    else
        frame.run(Stage::paths, "",
                  kernels::path{.scene = *scene_buffers_.traced,
                                .geometry = view(scene_buffers_.geometry),
                                .light_table = view(scene_buffers_.light_table),
                                .path_params = path_params_,
                                .film_sums = sums_,
                                .counters = buffers_.counters,
                                .nonfinite = buffers_.nonfinite},
                  all);
    stats_.push_back(frame_stats(frame, watch));
    stats_.back().picture = picture_;
    std::vector<SampleRange> ranges = film_.ranges;
    ranges.push_back({next_, next_ + count});
    film_.ranges = joined(std::move(ranges));
    next_ += count;
    ms_per_sample_ = stats_.back().ms / count;
    return wanted && samples_left() > 0;
}

FilmSums PathRenderer::sums() {
    FilmSums sums = film_;
    sums.words =
        read_buffer(executor_, sums_, std::size_t{FILM_PIXEL_WORDS} * film_.width * film_.height);
    return sums;
}

}  // namespace weft
