// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_PATH_RENDERER_H
#define WEFT_RENDER_PATH_RENDERER_H

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "film/film_sums.h"
#include "pipeline/media_buffers.h"
#include "render/exact_film.h"
#include "render/exact_renderer.h"
#include "scene/scene.h"

namespace weft {

/// Settings of a reference.
struct PathSettings {
    /// path or reference; see make_exact_renderer.
    Algorithm algorithm = Algorithm::path;
    std::uint32_t width = 512;
    std::uint32_t height = 512;
    std::uint32_t seed = 0;
    SampleRange samples{0, 64};
    bool through_centres = false;    ///< all samples go through the pixel's centre, as previews do
    bool hides_environment = false;  ///< from rays of the camera, not from light
    bool direct = true;
    bool indirect = true;
    std::uint32_t most_bounces = 0xFFFFFFFF;  ///< scatterings after which a path ends
    double frame_ms = 500.0;                  ///< milliseconds that a frame takes, about
};

/// Renders references by path tracing. A frame adds some samples to every pixel's exact sums;
/// however many frames they are spread over, the same samples give the same bits.
class PathRenderer : public ExactRenderer {
  public:
    /// `scene` must outlive the renderer. Where `sums` holds words, they are continued: its ranges
    /// must lie outside `settings.samples`. Throws Error (exit code 2) where it is of another
    /// image.
    PathRenderer(Executor& executor, const FlatScene& scene, const Camera& camera,
                 const PathSettings& settings, FilmSums sums);
    /// The same on a scene that has been uploaded, by others perhaps.
    PathRenderer(Executor& executor, const FlatScene& scene, std::shared_ptr<SceneBuffers> uploaded,
                 const Camera& camera, const PathSettings& settings, FilmSums sums);

    /// Adds the samples of one frame that takes about PathSettings::frame_ms, or all remaining ones
    /// if they take less. The frame is finished whatever `keep_going` returns, since a sample that
    /// only some pixels have would be lost. A cancelled frame is not lost either: the next call, or
    /// reading the sums, continues it. Returns whether the frame was finished, more samples remain
    /// and `keep_going` never returned false.
    bool render_frame(const KeepGoing& keep_going) override;

    /// Clears the sums, even those of other renderers that were continued.
    void set_camera(const Camera& camera) override;
    void update_scene() override;
    void follow_scene() override;

    [[nodiscard]] std::uint32_t samples_left() const noexcept override { return film_.left(); }
    void limit_frames(double ms, std::uint32_t samples) noexcept override {
        most_frame_ms_ = ms;
        most_samples_ = samples;
    }
    [[nodiscard]] bool has_open_frame() const noexcept override { return open_.has_value(); }
    [[nodiscard]] double next_frame_ms() const noexcept override {
        return ms_per_sample_ * frame_samples();
    }

    [[nodiscard]] std::uint64_t samples() const override { return film_.samples(); }
    /// Beauty, alpha, direct, indirect, emission, albedo, normal, depth and variance.
    [[nodiscard]] Image image() override { return resolve_sums(sums()); }
    /// The sums as they are now, after the rest of a cancelled frame.
    [[nodiscard]] FilmSums sums() override;

    [[nodiscard]] const FramePlan& plan() const override { return plan_; }
    [[nodiscard]] const std::vector<FrameStats>& stats() const override { return stats_; }
    [[nodiscard]] std::vector<FrameStats> take_stats() override {
        return std::exchange(stats_, {});
    }
    [[nodiscard]] FilmView film() override;

  private:
    /// A frame under way: the next `count` samples, which the pixels before `pixel` have.
    struct OpenFrame {
        std::uint32_t count;
        std::uint32_t pixel;
        FrameStats stats;  ///< of its parts so far
    };

    /// Renders the rest of the open frame and returns whether it is finished. With `whole`, no
    /// cancel stops it.
    bool continue_frame(const KeepGoing& keep_going, bool whole);
    void finish_frame();
    void filter_textures();
    [[nodiscard]] const std::string& identity();
    void fit_film();
    /// Builds the kernel again where the scene or the camera needs other features.
    void set_features();
    /// The kernel `path`, or `path_surfaces` where the scene has materials; where it has media
    /// `path_media`, or `path_grid` with grids, or `path_media_surfaces` with materials.
    [[nodiscard]] KernelId kernel() const noexcept;
    [[nodiscard]] std::uint32_t frame_samples() const noexcept;

    Executor& executor_;
    const FlatScene& scene_;
    PathSettings settings_;
    FramePlan plan_;
    std::shared_ptr<SceneBuffers> scene_buffers_;
    std::shared_ptr<MediaBuffers> media_;
    FrameBuffers buffers_;
    shared::RenderParams params_{};
    shared::PathParams path_params_{};
    ExactFilm film_;
    std::optional<std::string> identity_;  ///< of the image, once it was computed
    std::optional<OpenFrame> open_;
    std::vector<FrameStats> stats_;
    std::uint32_t image_ = 0;
    std::uint32_t camera_features_ = 0;
    double ms_per_sample_ = 0.0;
    double most_frame_ms_ = std::numeric_limits<double>::infinity();
    std::uint32_t most_samples_ = any_samples;
};

/// Identifies the image that samples belong to: `estimator` and a digest of everything else that
/// changes them. The name of an estimator has to change whenever its samples do, so that sums of an
/// earlier version are not continued.
[[nodiscard]] std::string image_identity(std::string_view estimator, const FlatScene& scene,
                                         const shared::RenderParams& params,
                                         const shared::PathParams& path_params);

/// FEATURE_* of path tracing.
[[nodiscard]] std::uint32_t path_features(const FlatScene& scene, const PathSettings& settings);

}  // namespace weft

#endif
