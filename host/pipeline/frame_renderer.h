// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_FRAME_RENDERER_H
#define WEFT_PIPELINE_FRAME_RENDERER_H

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/stopwatch.h"
#include "image/image.h"
#include "pipeline/frame_context.h"
#include "pipeline/light_work.h"
#include "plan/frame_plan.h"

namespace weft {

/// Values that were not finite or negative, set to 0 before they reached the film.
struct NonfiniteStats {
    std::uint32_t count = 0;
    std::uint32_t first_pixel = 0;  ///< row-major index, where count > 0
};

/// How an adaptive component was sampled in a frame.
struct LevelStats {
    std::string component;
    std::array<std::uint32_t, 3> tiles{};  ///< coarse, middle, full
    std::uint64_t samples = 0;             ///< pixels that have one
    double gain = 1.0;                     ///< factor on the threshold, by the frame budget
    bool can_save = true;                  ///< a higher gain would have made the frame faster
};

/// Statistics of one frame on irradiance records that outlast their frame.
struct CacheStats {
    std::uint32_t kept = 0;     ///< of the frames before
    std::uint32_t updated = 0;  ///< of those, because their light may have changed
    std::uint32_t dropped = 0;  ///< because their surface has moved
    std::uint32_t evicted = 0;  ///< beyond SamplingSettings::cache_records, or dispensable
    std::uint32_t made = 0;
    std::uint64_t bytes = 0;  ///< of device memory, for all records there is room for
    // With SamplingSettings::validate_cache and masks, after a change:
    std::uint32_t differing = 0;  ///< records and VPLs that differ in any bit if computed anew
    std::uint64_t traced = 0;     ///< connections of kept records that were traced again
    /// Connections that meet anything that has moved, or whose VPL is elsewhere, tested one by one.
    std::uint64_t affected = 0;
};

/// Time, rays and other statistics of one frame.
struct FrameStats {
    double ms = 0.0;
    std::uint64_t rays = 0;
    std::vector<StageStats> stages;
    std::vector<LevelStats> levels;  ///< of adaptive components
    std::optional<CacheStats> cache;
    std::uint32_t image = 0;  ///< number among those that a renderer has begun, from 0 on
    /// By component, in the order of COMPONENT_*.
    std::array<NonfiniteStats, COMPONENT_COUNT> nonfinite{};
};

/// Statistics of a frame, once all of it has run; `watch` started with it. Clears the counters of
/// values that were not finite.
[[nodiscard]] FrameStats frame_stats(FrameContext& frame, const Stopwatch& watch);

/// What a display needs of a film: the sums of previews, or the exact ones of path tracing.
struct FilmView {
    const shared::RenderParams& params;  ///< the film's size and features
    BufferRef<kinds::FilmHigh> high;
    BufferRef<kinds::FilmLow> low;
    BufferRef<kinds::FilmSums> sums;  ///< null for previews
    std::uint64_t samples = 0;        ///< of every pixel
    double unit = 1.0;                ///< radiance of a value of 1 in the film
};

/// Renders an image of a scene frame by frame, whatever the algorithm.
class FrameRenderer {
  public:
    virtual ~FrameRenderer() = default;

    /// Adds a frame to the film; returns whether it was complete. See the algorithms' renderers for
    /// what is kept where `keep_going` ends it early. A frame that was cancelled (see
    /// Executor::cancelled) is never in the film in part.
    virtual bool render_frame(const KeepGoing& keep_going) = 0;

    /// Begins the next image: an empty film, seen from `camera`. Its first frame is that of a new
    /// renderer with this camera, bit for bit.
    virtual void set_camera(const Camera& camera) = 0;

    /// Begins the next image of a sequence, which may use what the images since the last set_camera
    /// have found about where samples are needed.
    virtual void move_camera(const Camera& camera) { set_camera(camera); }

    /// Brings the scene's buffers and the renderer up to date with the scene, which has been
    /// changed in place (update_flat). The next image has to be begun afterwards.
    virtual void update_scene() = 0;
    /// The same where the owner of shared scene buffers has already brought these up to date.
    virtual void follow_scene() = 0;

    /// Samples of every pixel in the film.
    [[nodiscard]] virtual std::uint64_t samples() const = 0;
    /// How much of its light a film holds whose only frame ended early, by component; empty where
    /// all of it is there.
    [[nodiscard]] virtual std::vector<LightShare> light() const { return {}; }
    /// The mean of the film as layers.
    [[nodiscard]] virtual Image image() = 0;
    [[nodiscard]] virtual const FramePlan& plan() const = 0;
    /// Statistics of the frames of all images, without those that take_stats has returned.
    [[nodiscard]] virtual const std::vector<FrameStats>& stats() const = 0;
    /// Returns the same and drops them here.
    [[nodiscard]] virtual std::vector<FrameStats> take_stats() = 0;
    /// The film, which has at least one sample, for the kernel that displays it.
    [[nodiscard]] virtual FilmView film() = 0;
};

}  // namespace weft

#endif
