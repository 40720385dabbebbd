// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FRAME_FRAME_CONTEXT_H
#define WEFT_FRAME_FRAME_CONTEXT_H

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/executor.h"
#include "frame/stage.h"
#include "scene/flat_scene.h"
#include "schedule/frame_budget.h"
#include "schedule/frame_plan.h"
#include "schedule/work_list.h"

namespace weft {

struct MediaBuffers;

/// The scene on the device; the order of `geometry` is that of GEOMETRY_ARGS.
struct SceneBuffers {
    std::vector<std::unique_ptr<Buffer>> geometry;
    std::unique_ptr<Buffer> lights;
    std::unique_ptr<Buffer> emissive;
    std::unique_ptr<TracedScene> traced;
    /// Participating media, once something has asked for them: see media_of.
    std::shared_ptr<MediaBuffers> media;
};

[[nodiscard]] SceneBuffers upload_scene(Executor& executor, const FlatScene& flat);

/// The scene's media on the device, uploaded when first asked for. All users of the buffers look
/// from one camera.
[[nodiscard]] std::shared_ptr<MediaBuffers> media_of(Executor& executor, const FlatScene& flat,
                                                     SceneBuffers& scene);

/// Brings them up to date with the scene they were made of after update_flat.
void update_scene(Executor& executor, const FlatScene& flat, SceneBuffers& scene);

class EdgeSamples;
class TileGeometry;
class ViewMedia;

/// Buffers in the order of GBUFFER_ARGS.
using GBuffer = std::vector<std::unique_ptr<Buffer>>;

/// The irradiance that composition adds up: buffers of the components, null where there is none.
struct ComposedIrradiance {
    Buffer* direct = nullptr;        ///< by pixel, float4
    Buffer* exact_direct = nullptr;  ///< by slot of all pixels, three planes
    Buffer* indirect = nullptr;      ///< by pixel, float4
    Buffer* media = nullptr;         ///< by pixel, float4: radiance that media scatter to it
};

/// What all stages and components of a frame share; the order of `gbuffer` is that of GBUFFER_ARGS.
/// Buffers that the plan does not call for are null.
struct FrameBuffers {
    GBuffer gbuffer;
    std::unique_ptr<Buffer> slot_pixel, pixel_slot, block_set, receivers;
    std::unique_ptr<Buffer> film_high, film_low;
    std::unique_ptr<TileGeometry> tiles;    ///< where a component adapts
    std::unique_ptr<EdgeSamples> edges;     ///< where the plan has edge samples
    std::unique_ptr<ViewMedia> view_media;  ///< where light goes through media
    std::unique_ptr<Buffer> light_samples;  ///< points on lights, of all sets
    std::unique_ptr<Buffer> vpls;           ///< of indirect light, of all sets
    ComposedIrradiance irradiance;
    std::unique_ptr<Buffer> counters, nonfinite;
    std::unique_ptr<Buffer> nothing;  ///< stands in for buffers that the plan does not call for
    std::uint32_t slots = 0;

    FrameBuffers();
    FrameBuffers(FrameBuffers&&) noexcept;
    FrameBuffers& operator=(FrameBuffers&&) noexcept;
    ~FrameBuffers();

    /// The buffer, or `nothing`.
    [[nodiscard]] Buffer* or_nothing(Buffer* buffer) const {
        return buffer != nullptr ? buffer : nothing.get();
    }
    [[nodiscard]] Buffer* or_nothing(const std::unique_ptr<Buffer>& buffer) const {
        return or_nothing(buffer.get());
    }
};

/// Places in a GBuffer, and how many there are.
inline constexpr std::size_t gbuffer_ids = 0;
inline constexpr std::size_t gbuffer_position = 1;
inline constexpr std::size_t gbuffer_shading = 3;
inline constexpr std::size_t gbuffer_albedo = 4;
inline constexpr std::size_t gbuffer_emission = 5;
inline constexpr std::size_t gbuffer_buffers = 6;

/// A G-buffer of that many pixels; `of` says of what.
[[nodiscard]] GBuffer allocate_gbuffer(Executor& executor, std::size_t pixels, const char* of);

/// What a frame shares, of a picture of this size, but for the media that it is seen through.
/// `tiles`: whether a component adapts.
[[nodiscard]] FrameBuffers allocate_frame(Executor& executor, const FramePlan& plan,
                                          const WorkList& work, std::uint32_t width,
                                          std::uint32_t height, std::uint32_t features, bool tiles);

/// Planes of receivers for kernels with these features.
[[nodiscard]] std::size_t receiver_planes(std::uint32_t features);

/// The counters alone, for algorithms that keep no other state between kernels.
[[nodiscard]] FrameBuffers allocate_counters(Executor& executor);

/// Sets the counters of values that were not finite to none.
void clear_nonfinite(Executor& executor, Buffer& counter);

/// What one stage of a frame took.
struct StageStats {
    Stage stage{};
    std::string component;
    double ms = 0.0;
    std::uint64_t rays = 0;
    std::uint64_t misses = 0;  ///< edge samples whose irradiance is that of another surface
};

/// Asked between launches with the stage's share done, in [0, 1]; false ends the frame early.
using KeepGoing = std::function<bool(Stage stage, double done)>;

/// What every frame of a rendering shares.
struct FrameInputs {
    Executor& executor;
    const FlatScene& scene;
    const SceneBuffers& scene_buffers;
    FrameBuffers& buffers;
    const FramePlan& plan;
};

/// One frame under way: where components find what they need and launch their stages.
class FrameContext : public FrameInputs {
  public:
    FrameContext(const FrameInputs& inputs, const shared::Params& frame_params,
                 const KeepGoing& keep_going)
        : FrameInputs(inputs), params(frame_params), keep_going_(keep_going) {}
    FrameContext(const FrameContext&) = delete;
    FrameContext& operator=(const FrameContext&) = delete;
    /// Waits for what still runs.
    ~FrameContext();

    /// Runs one kernel as a stage and records its time and rays. After an early end nothing heavy
    /// runs any more. `arguments` follow Params (and the scene where `traces`).
    void run(KernelId kernel, Stage stage, const char* component, bool traces,
             const std::vector<Buffer*>& arguments, std::uint32_t items,
             std::uint32_t items_per_launch = 0, std::uint32_t first_item = 0);

    /// Runs `stages` to their end whatever keep_going says: what later stages must find defined.
    template <class Stages>
    void run_whole(const Stages& stages) {
        const bool before = std::exchange(finishing_, true);
        stages();
        finishing_ = before;
    }

    [[nodiscard]] bool ended_early() const { return ended_early_ || executor.cancelled(); }
    /// The stages so far, with what they counted.
    [[nodiscard]] const std::deque<StageStats>& stages();
    /// Waits for what still runs, so that the time of host work that follows is its own alone.
    void wait() { (void)executor.take_milliseconds(); }
    /// Records work of the host between stages; what ran on the device meanwhile must not count.
    void add_host_stage(Stage stage, const char* component, double ms);

    shared::Params params;

    /// What a frame is the first of.
    enum class Begins : std::uint8_t { nothing, picture, sequence };
    /// A sequence's first frame remembers nothing; a picture's first takes over what the pictures
    /// before it said.
    Begins begins = Begins::sequence;
    /// Where given, stages trace in this and not in the scene.
    const TracedScene* other_scene = nullptr;
    /// Whether stages run to their end even if all else is cancelled: see Launch::whole.
    bool whole_launches = false;
    /// Where given, its gains scale the thresholds of adaptive components.
    const FrameBudget* budget = nullptr;

  private:
    /// Reads the counters of the stages that have not been read.
    void count();

    const KeepGoing& keep_going_;
    std::deque<StageStats> stages_;       ///< none moves: launches add their times there
    std::vector<std::size_t> uncounted_;  ///< stages by counter
    bool ended_early_ = false;
    bool finishing_ = false;
};

/// The buffers of GEOMETRY_ARGS, followed by others.
[[nodiscard]] std::vector<Buffer*> with_geometry(const SceneBuffers& scene,
                                                 const std::vector<Buffer*>& others);

/// The buffers of a G-buffer, by default the frame's own, followed by others.
[[nodiscard]] std::vector<Buffer*> with_gbuffer(const GBuffer& gbuffer,
                                                const std::vector<Buffer*>& others);
[[nodiscard]] std::vector<Buffer*> with_gbuffer(const FrameBuffers& frame,
                                                const std::vector<Buffer*>& others);

/// The buffers of IRRADIANCE_ARGS, followed by others.
[[nodiscard]] std::vector<Buffer*> with_irradiance(const FrameBuffers& frame,
                                                   const std::vector<Buffer*>& others);

}  // namespace weft

#endif
