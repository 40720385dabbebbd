// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_FRAME_CONTEXT_H
#define WEFT_PIPELINE_FRAME_CONTEXT_H

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "device/executor.h"
#include "device/launch.h"
#include "pipeline/light_work.h"
#include "pipeline/stage.h"
#include "plan/frame_budget.h"
#include "plan/frame_plan.h"
#include "plan/work_list.h"
#include "scene/flat_scene.h"

namespace weft {

/// The scene on the device.
struct SceneBuffers {
    owned::Geometry geometry;
    owned::LightTable light_table;
    owned::SurfaceTables surfaces;                ///< of FEATURE_MATERIALS
    DeviceBuffer<kinds::LightNodes> light_nodes;  ///< none where there is one light or none
    owned::EnvironmentImage environment;          ///< none without FEATURE_IMAGE_ENVIRONMENT
    /// Of surfaces that see all of the environment's image; none until make_open_irradiance.
    DeviceBuffer<kinds::EnvironmentIrradiance> environment_irradiance;
    std::unique_ptr<TracedScene> traced;
    /// What blocks light in previews, where that is less than all; null until make_light_scene.
    std::unique_ptr<TracedScene> blocking;
    std::vector<shared::Triangle> blocking_triangles;  ///< that it is of
    bool soon = false;                                 ///< of upload_scene

    /// What light meets on its way.
    [[nodiscard]] TracedScene& seen_by_light() const { return blocking ? *blocking : *traced; }

    /// The buffers of area lights, whose points lie on triangles of the geometry.
    [[nodiscard]] groups::AreaLights area_lights() const {
        return {.lights = light_table.lights,
                .emissive = light_table.emissive,
                .positions = geometry.positions,
                .triangle_list = geometry.triangle_list};
    }
    /// Participating media; null until media_of uploads them.
    std::shared_ptr<owned::MediaTables> media;
};

/// Uploads a scene, and builds its BVH; `soon`: see TracedGeometry::soon.
[[nodiscard]] SceneBuffers upload_scene(Executor& executor, const FlatScene& flat,
                                        bool soon = false);

/// Makes SceneBuffers::blocking, once, where light passes through some surfaces.
void make_light_scene(Executor& executor, const FlatScene& flat, SceneBuffers& scene);

/// Makes SceneBuffers::environment_irradiance, once, where the environment has an image.
void make_open_irradiance(Executor& executor, const FlatScene& flat, SceneBuffers& scene);

/// The scene's media on the device, which the first call uploads. All users of the buffers share
/// one camera.
[[nodiscard]] std::shared_ptr<owned::MediaTables> media_of(Executor& executor,
                                                           const FlatScene& flat,
                                                           SceneBuffers& scene);

/// Brings the buffers up to date with the scene that they were made of, after update_flat.
void update_scene(Executor& executor, const FlatScene& flat, SceneBuffers& scene);

class CameraVpls;
class EdgeSamples;
class TileGeometry;
class ViewMedia;

/// The surfaces that primary rays have hit, or the ends of view rays through media
/// (kernels/film/gbuffer.h).
using GBuffer = owned::SeenSurfaces;

/// The irradiance that composition adds up: buffers of the components, null where there is none.
struct ComposedIrradiance {
    BufferRef<kinds::ReconstructedLight> direct;
    BufferRef<kinds::SlotLight> exact_direct;  ///< of the slots of all pixels
    BufferRef<kinds::ReconstructedLight> indirect;
    BufferRef<kinds::ReconstructedLight> media;       ///< radiance that media scatter to each pixel
    BufferRef<kinds::ReconstructedLight> reflection;  ///< radiance that pixels show in mirrors
    BufferRef<kinds::ReconstructedLight> refraction;  ///< through glass and gaps
    BufferRef<kinds::ReconstructedLight> glossy;      ///< and on glossy surfaces
};

/// The buffers that all stages and components of a frame share. Those that the plan does not need
/// are null.
struct FrameBuffers {
    GBuffer gbuffer;
    DeviceBuffer<kinds::SlotPixels> slot_pixel;
    DeviceBuffer<kinds::PixelSlots> pixel_slot;
    DeviceBuffer<kinds::BlockSets> block_set;
    DeviceBuffer<kinds::ReceiverPlanes> receivers;
    DeviceBuffer<kinds::FilmHigh> film_high;
    DeviceBuffer<kinds::FilmLow> film_low;
    std::unique_ptr<TileGeometry> tiles;               ///< where a component adapts
    std::unique_ptr<EdgeSamples> edges;                ///< where the plan has edge samples
    std::unique_ptr<ViewMedia> view_media;             ///< where light goes through media
    DeviceBuffer<kinds::VirtualLights> light_samples;  ///< points on lights, of all sets
    DeviceBuffer<kinds::VirtualLights> vpls;           ///< of indirect light, of all sets
    std::unique_ptr<CameraVpls> camera_vpls;           ///< where the plan selects VPLs
    ComposedIrradiance irradiance;
    DeviceBuffer<kinds::RayCounters> counters;
    DeviceBuffer<kinds::NonfiniteCounters> nonfinite;
    std::uint32_t slots = 0;

    FrameBuffers();
    FrameBuffers(FrameBuffers&&) noexcept;
    FrameBuffers& operator=(FrameBuffers&&) noexcept;
    ~FrameBuffers();

    /// The media of the scene; none of the buffers where it has none.
    [[nodiscard]] groups::MediaTables media() const;
    /// Boundaries of media around what each pixel shows; null where there are none.
    [[nodiscard]] BufferRef<kinds::EnclosingMedia> view_enclosing_media() const;
    /// The light that composition adds up.
    [[nodiscard]] groups::ComposedLight composed() const;
};

/// Allocates a G-buffer of that many pixels; `of` names it in errors.
[[nodiscard]] GBuffer allocate_gbuffer(Executor& executor, std::size_t pixels, const char* of);

/// Allocates the buffers that all components of a frame share, except those of view rays through
/// media. `tiles`: whether a component adapts.
[[nodiscard]] FrameBuffers allocate_frame(Executor& executor, const FramePlan& plan,
                                          const WorkList& work, std::uint32_t width,
                                          std::uint32_t height, std::uint32_t features, bool tiles);

/// Number of planes that receivers have in kernels with these features.
[[nodiscard]] std::size_t receiver_planes(std::uint32_t features);

/// Allocates the counters alone, for algorithms that keep no other state between kernels.
[[nodiscard]] FrameBuffers allocate_counters(Executor& executor);

/// Resets the counters of values that were not finite.
void clear_nonfinite(Executor& executor, const DeviceBuffer<kinds::NonfiniteCounters>& counter);

/// Time and rays of one stage of a frame.
struct StageStats {
    Stage stage{};
    std::string component;
    double ms = 0.0;
    std::uint64_t rays = 0;
    std::uint64_t misses = 0;  ///< edge samples whose irradiance is that of another surface
};

/// Called between launches with the share of the stage that is done, in [0, 1]; returning false
/// ends the frame early.
using KeepGoing = std::function<bool(Stage stage, double done)>;

/// The inputs that all frames of a rendering share.
struct FrameInputs {
    Executor& executor;
    const FlatScene& scene;
    const SceneBuffers& scene_buffers;
    FrameBuffers& buffers;
    const FramePlan& plan;
};

/// One frame under way: gives components what they share and launches their stages.
class FrameContext : public FrameInputs {
  public:
    /// `keep_going` must outlive the frame.
    FrameContext(const FrameInputs& inputs, const shared::RenderParams& frame_params,
                 const KeepGoing& keep_going)
        : FrameInputs(inputs), params(frame_params), keep_going_(keep_going) {}
    FrameContext(const FrameInputs&, const shared::RenderParams&, KeepGoing&&) = delete;
    FrameContext(const FrameContext&) = delete;
    FrameContext& operator=(const FrameContext&) = delete;
    /// Waits for launches that still run.
    ~FrameContext();

    /// How a stage's work-items are divided.
    struct Items {
        std::uint32_t count;
        std::uint32_t per_launch = 0;  ///< at most; 0: the kernel's own chunk
        std::uint32_t first = 0;
    };

    /// Runs one kernel as a stage of a component and records its time and rays. After an early end
    /// it does nothing outside of run_whole. `arguments` is a struct of weft::kernels.
    template <class Kernel>
    void run(Stage stage, const char* component, const Kernel& arguments, const Items& items) {
        if (items.count == 0) return;
        light_.plan(stage, component, items.count);
        if (ended_early() && !finishing_) return;
        ArgumentBinder binder(Kernel::id);
        arguments.bind_to(binder);
        run_bound(Kernel::id, stage, component, binder, items);
    }

    /// Runs `stages` to their end whatever keep_going says, since later stages need their results.
    template <class Stages>
    void run_whole(const Stages& stages) {
        const bool before = std::exchange(finishing_, true);
        stages();
        finishing_ = before;
    }

    [[nodiscard]] bool ended_early() const { return ended_early_ || executor.cancelled(); }
    /// Statistics of the stages so far.
    [[nodiscard]] const std::deque<StageStats>& stages();
    /// Waits for launches that still run, so that they do not count as host work that follows.
    void wait() { (void)executor.take_milliseconds(); }
    /// Records work of the host between stages; `ms` must not count what ran on the device.
    void add_host_stage(Stage stage, const char* component, double ms);

    /// Begins the samples of another component, for `light`.
    void begin_component() { light_ = {}; }
    /// How much of the component's light there is so far.
    [[nodiscard]] const LightWork& light() const { return light_; }

    /// Pixels of the image.
    [[nodiscard]] std::uint32_t pixels() const noexcept {
        return params.camera.width * params.camera.height;
    }

    const shared::RenderParams params;

    /// Whether a frame is the first of an image, or even of a sequence.
    enum class Begins : std::uint8_t { nothing, image, sequence };
    /// State that components keep between images is cleared by the first frame of a sequence, and
    /// continued by the first frame of each further image.
    Begins begins = Begins::sequence;
    /// Whether stages run to their end even if all else is cancelled: see LaunchOptions::whole.
    bool whole_launches = false;
    /// Its gains scale the thresholds of adaptive components; may be null.
    const FrameBudget* budget = nullptr;

  private:
    void run_bound(KernelId kernel, Stage stage, const char* component,
                   const ArgumentBinder& arguments, const Items& items);
    /// Reads the counters of stages whose counters have not been read.
    void count();

    const KeepGoing& keep_going_;
    std::deque<StageStats> stages_;       ///< addresses stay: launches add their times there
    std::vector<std::size_t> uncounted_;  ///< stages by counter
    LightWork light_;
    bool ended_early_ = false;
    bool finishing_ = false;
};

/// Work-items per launch of a gather kernel that keep a launch short whatever the list's length:
/// about a million rays. 0, which leaves it to the kernel, for devices that are no CPU.
[[nodiscard]] std::uint32_t gather_items_per_launch(const Executor& executor,
                                                    std::uint32_t list_length);

}  // namespace weft

#endif
