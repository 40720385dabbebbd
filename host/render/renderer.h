// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_RENDERER_H
#define WEFT_RENDER_RENDERER_H

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "components/component.h"
#include "image/image.h"
#include "pipeline/frame_context.h"
#include "pipeline/frame_renderer.h"
#include "plan/frame_plan.h"
#include "render/exact_film.h"
#include "scene/scene.h"

namespace weft {

/// Settings of a preview: an image by any algorithm but path tracing.
struct RenderSettings {
    Algorithm algorithm = default_algorithm;
    SamplingSettings sampling;
    std::uint32_t width = 512;
    std::uint32_t height = 512;
    std::uint32_t tile = 64;
    std::uint32_t seed = 0;
    /// Expected number of frames: with 1, rays go through pixel centres; with more, they cover the
    /// whole pixel, and textures need less filtering.
    std::uint32_t samples = 1;
    /// Of a session: after so many samples of the preview every second one is unbiased, and after
    /// four times as many all further ones, which correct it (Refinement); 0: all samples are the
    /// preview's.
    std::uint32_t refined_after = 0;
    /// Of ais: target for the milliseconds of a frame, which thresholds are adapted to; 0: none.
    double frame_time_ms = 0.0;
    bool hides_environment = false;  ///< from rays of the camera, not from light
    bool through_centres = false;    ///< of reference: samples go through the pixel's centre
    bool direct = true;
    bool indirect = true;
    bool reflection = true;  ///< what is seen in mirrors
    bool refraction = true;  ///< through glass and gaps
    bool glossy = true;      ///< and on glossy surfaces
    bool media = true;       ///< light that participating media scatter to the camera
    /// Names of further components (Choice::on_request).
    std::vector<std::string> requested;
    /// Components to choose from.
    std::span<const ComponentKind> components = weft::components();
};

/// Renders frames of one scene into one film, for one image after the other.
class Renderer : public FrameRenderer {
  public:
    /// `scene` must outlive the renderer. Uploads the scene, plans, and builds the kernels that the
    /// plan needs.
    Renderer(Executor& executor, const FlatScene& scene, const Camera& camera,
             const RenderSettings& settings);
    /// The same on a scene that has been uploaded, by others perhaps.
    Renderer(Executor& executor, const FlatScene& scene, std::shared_ptr<SceneBuffers> uploaded,
             const Camera& camera, const RenderSettings& settings);
    Renderer(const Renderer&) = delete;  // its components refer to it
    Renderer& operator=(const Renderer&) = delete;

    /// Adds a frame to the film. Where `keep_going` ends it early, a first frame is kept as far as
    /// it got and a later one is dropped; a cancelled frame is always dropped. Returns whether the
    /// frame was complete.
    bool render_frame(const KeepGoing& keep_going) override;

    /// Adds the next sample to an exact film, not to the renderer's own: a sample of Algorithm::
    /// reference, which depends on its number and on no other sample. Whatever `keep_going` returns
    /// it is finished; a cancelled one is not added. Returns whether it was.
    bool add_sample(ExactFilm& film, const KeepGoing& keep_going);

    void set_camera(const Camera& camera) override;
    void move_camera(const Camera& camera) override;
    /// Keeps the plan, unless the scene's lights or features are others than it was made for.
    void update_scene() override;
    void follow_scene() override;

    /// Share of the VPLs of the first sample that land on surfaces; 1 where the plan has none.
    [[nodiscard]] double landed_share();
    /// What kernels are told that is the same in all samples of Algorithm::reference.
    [[nodiscard]] const shared::RenderParams& constant_params() const { return base_params_; }

    [[nodiscard]] std::uint64_t samples() const override { return frames_in_film_; }
    [[nodiscard]] std::vector<LightShare> light() const override { return light_; }
    /// The mean of the film as layers: beauty, direct, indirect, emission, albedo, normal, depth;
    /// of ais also the levels of the last frame, and what components bring as layers of their own.
    [[nodiscard]] Image image() override;
    [[nodiscard]] const FramePlan& plan() const override { return plan_; }
    [[nodiscard]] const std::vector<FrameStats>& stats() const override { return stats_; }
    [[nodiscard]] std::vector<FrameStats> take_stats() override {
        return std::exchange(stats_, {});
    }
    [[nodiscard]] FilmView film() override;

  private:
    /// Builds the kernels and makes the buffers and components that depend on the plan.
    void set_up();
    /// Where the settings leave it open, makes the VPLs of a sample, and plans anew without VPLs
    /// where too few of them have landed.
    void choose_indirect();
    void set_params(std::uint32_t features);
    /// FEATURE_* of frames of the plan by the camera.
    [[nodiscard]] std::uint32_t features_of_frames() const;
    void trace_primary(FrameContext& frame);
    /// Makes the samples of all components; returns how much of its light each has.
    std::vector<LightShare> sample(FrameContext& frame);
    void compose(FrameContext& frame);
    /// The same, into exact sums.
    void compose(FrameContext& frame, const ExactFilm& film);
    void reconstruct(FrameContext& frame);
    /// Reconstructs all components and adds the frame to the film; returns whether all of it got
    /// there.
    bool finish(FrameContext& frame);
    void record(FrameContext& frame, const Stopwatch& watch);
    /// Which thresholds could have changed the cost of the last frame.
    [[nodiscard]] std::vector<ThresholdScope> threshold_scopes() const;
    [[nodiscard]] shared::RenderParams params_of_frame(std::uint32_t frame) const;
    [[nodiscard]] shared::RenderParams params_of_sample(std::uint32_t sample) const;

    Executor& executor_;
    const FlatScene& scene_;
    Camera camera_;
    RenderSettings settings_;
    FramePlan plan_;
    WorkList work_;
    std::shared_ptr<SceneBuffers> scene_buffers_;
    FrameBuffers buffers_;
    std::vector<ActiveComponent> components_;
    bool all_receivers_ = true;  ///< whether a frame runs receivers.cl over its whole work list
    shared::RenderParams base_params_{};
    std::vector<FrameStats> stats_;
    std::uint32_t frames_in_film_ = 0;
    std::vector<LightShare> light_;  ///< of a film whose only frame ended early
    std::uint32_t image_ = 0;
    std::uint32_t sequence_ = 0;  ///< first image of the sequence
    FrameBudget budget_;
};

/// The plan for a scene and settings.
[[nodiscard]] FramePlan plan_for(const FlatScene& scene, const RenderSettings& settings);

/// Kernels that frames of this plan launch, each once, in KernelId order.
[[nodiscard]] std::vector<KernelId> kernels_of(const FramePlan& plan,
                                               std::span<const ComponentKind> kinds = components());

/// FEATURE_* of frames of this plan.
[[nodiscard]] std::uint32_t features_of(const FlatScene& scene, const FramePlan& plan,
                                        std::span<const ComponentKind> kinds = components());

}  // namespace weft

#endif
