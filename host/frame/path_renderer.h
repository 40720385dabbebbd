// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FRAME_PATH_RENDERER_H
#define WEFT_FRAME_PATH_RENDERER_H

#include <cstdint>
#include <vector>

#include "frame/film_sums.h"
#include "frame/frame_renderer.h"
#include "frame/media_buffers.h"
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

    /// Samples of one frame that takes about half a second, or what is left if that is less;
    /// always ends whole, since a sample that only some pixels have would be lost. Returns whether
    /// more is left to do and `keep_going` agrees.
    bool render_frame(const KeepGoing& keep_going) override;

    /// Forgets the sums, also those of other renderers that it went on from.
    void set_camera(const Camera& camera) override;
    void update_scene() override;

    /// Samples still to be made.
    [[nodiscard]] std::uint32_t samples_left() const noexcept {
        return settings_.samples.end - next_;
    }
    /// Expected milliseconds of the next frame; 0 before the first.
    [[nodiscard]] double next_frame_ms() const noexcept { return ms_per_sample_ * frame_samples(); }

    [[nodiscard]] std::uint64_t samples() const override { return film_.samples(); }
    /// Beauty, direct, indirect, emission, albedo, normal, depth and variance.
    [[nodiscard]] Image image() override { return resolve_sums(sums()); }
    /// The sums as they are now.
    [[nodiscard]] FilmSums sums();

    [[nodiscard]] const FramePlan& plan() const override { return plan_; }
    [[nodiscard]] const std::vector<FrameStats>& stats() const override { return stats_; }

  private:
    void identify();
    void scale_light();
    /// path, or path_media where the scene has media.
    [[nodiscard]] KernelId kernel() const noexcept;
    [[nodiscard]] std::uint32_t frame_samples() const noexcept;

    Executor& executor_;
    const FlatScene& scene_;
    PathSettings settings_;
    FramePlan plan_;
    SceneBuffers scene_buffers_;
    MediaBuffers media_;
    FrameBuffers buffers_;
    DeviceBuffer<kinds::FilmSums> sums_;
    shared::RenderParams params_{};
    shared::PathParams path_params_{};
    FilmSums film_;  ///< without words: they are on the device
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
