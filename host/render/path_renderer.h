// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_PATH_RENDERER_H
#define WEFT_RENDER_PATH_RENDERER_H

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "film/film_sums.h"
#include "pipeline/frame_renderer.h"
#include "pipeline/media_buffers.h"
#include "scene/scene.h"

namespace weft {

/// What reference to make of a scene.
struct PathSettings {
    std::uint32_t width = 512;
    std::uint32_t height = 512;
    std::uint32_t seed = 0;
    SampleRange samples{0, 64};
    bool through_centres = false;  ///< all samples go through the pixel's centre, as previews do
    bool direct = true;
    bool indirect = true;
    double frame_ms = 500.0;  ///< milliseconds that a frame takes, about
};

/// The path-traced reference. A frame adds some samples to every pixel's exact sums; however many
/// frames they are spread over, the same samples give the same bits.
class PathRenderer : public FrameRenderer {
  public:
    /// `scene` must outlive the renderer. Where `sums` holds words, they are continued: its ranges
    /// must lie outside `settings.samples`. Throws Error (exit code 2) where it is of another
    /// picture.
    PathRenderer(Executor& executor, const FlatScene& scene, const Camera& camera,
                 const PathSettings& settings, FilmSums sums);
    /// The same on a scene that has been uploaded, by others perhaps.
    PathRenderer(Executor& executor, const FlatScene& scene, std::shared_ptr<SceneBuffers> uploaded,
                 const Camera& camera, const PathSettings& settings, FilmSums sums);

    /// Samples of one frame that takes PathSettings::frame_ms, or what is left if that is less.
    /// Whatever `keep_going` says it ends whole, since a sample that only some pixels have would be
    /// lost. A cancelled frame is not lost either: it goes on where it was the next time, or as
    /// soon as the sums are asked for. Returns whether it ended, more is left to do and
    /// `keep_going` agrees.
    bool render_frame(const KeepGoing& keep_going) override;

    /// Forgets the sums, also those of other renderers that it went on from.
    void set_camera(const Camera& camera) override;
    void update_scene() override;
    void follow_scene() override;

    /// Samples still to be made.
    [[nodiscard]] std::uint32_t samples_left() const noexcept {
        return settings_.samples.end - next_;
    }
    /// Whether a cancelled frame waits to go on.
    [[nodiscard]] bool has_open_frame() const noexcept { return open_.has_value(); }
    /// Expected milliseconds of the next frame; 0 before the first.
    [[nodiscard]] double next_frame_ms() const noexcept { return ms_per_sample_ * frame_samples(); }

    [[nodiscard]] std::uint64_t samples() const override { return film_.samples(); }
    /// Beauty, direct, indirect, emission, albedo, normal, depth and variance.
    [[nodiscard]] Image image() override { return resolve_sums(sums()); }
    /// The sums as they are now, after the rest of a cancelled frame.
    [[nodiscard]] FilmSums sums();

    [[nodiscard]] const FramePlan& plan() const override { return plan_; }
    [[nodiscard]] const std::vector<FrameStats>& stats() const override { return stats_; }
    [[nodiscard]] std::vector<FrameStats> take_stats() override {
        return std::exchange(stats_, {});
    }
    [[nodiscard]] FilmView film() override;

  private:
    /// A frame under way: samples [next_, next_ + count) of the pixels before `pixel`.
    struct OpenFrame {
        std::uint32_t count;
        std::uint32_t pixel;
        FrameStats stats;  ///< of its parts so far
    };

    /// Renders the rest of the open frame and returns whether it got to its end. With `whole` no
    /// cancel stops it.
    bool continue_frame(const KeepGoing& keep_going, bool whole);
    void finish_frame();
    void filter_textures();
    [[nodiscard]] const std::string& picture();
    void scale_light();
    /// path, or path_media where the scene has media.
    [[nodiscard]] KernelId kernel() const noexcept;
    [[nodiscard]] std::uint32_t frame_samples() const noexcept;

    Executor& executor_;
    const FlatScene& scene_;
    PathSettings settings_;
    FramePlan plan_;
    std::shared_ptr<SceneBuffers> scene_buffers_;
    std::shared_ptr<MediaBuffers> media_;
    FrameBuffers buffers_;
    DeviceBuffer<kinds::FilmSums> sums_;
    shared::RenderParams params_{};
    shared::PathParams path_params_{};
    FilmSums film_;  ///< without words, which are on the device, and without picture
    std::optional<std::string> identity_;  ///< of the picture, once it was asked for
    std::optional<OpenFrame> open_;
    std::vector<FrameStats> stats_;
    std::uint32_t next_;
    std::uint32_t picture_ = 0;
    double ms_per_sample_ = 0.0;
};

/// What identifies the picture that samples belong to: a text of everything that changes them.
[[nodiscard]] std::string picture_identity(const FlatScene& scene,
                                           const shared::RenderParams& params,
                                           const shared::PathParams& path_params);

/// FEATURE_* of path tracing.
[[nodiscard]] std::uint32_t path_features(const FlatScene& scene, const PathSettings& settings);

}  // namespace weft

#endif
