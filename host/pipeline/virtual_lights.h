// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_VIRTUAL_LIGHTS_H
#define WEFT_PIPELINE_VIRTUAL_LIGHTS_H

#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/frame_context.h"

namespace weft {

/// Fills FrameBuffers::light_samples with the points on lights of a frame. The stage counts for
/// `component`, the first of the frame that uses them.
void make_light_samples(FrameContext& frame, const char* component);

/// Fills a buffer with the points on area lights that light media: FramePlan::media_samples_per_set
/// of every set.
void make_media_samples(FrameContext& frame, const char* component,
                        BufferRef<kinds::VirtualLights> samples);

/// The kernels of walk_vpls.
[[nodiscard]] std::vector<KernelId> vpl_kernels(const FramePlan& plan);

/// Where light paths leave their VPLs: FrameBuffers::vpls, or the candidates for these.
[[nodiscard]] BufferRef<kinds::VirtualLights> walked_vpls(const FrameBuffers& buffers);

/// Traces the light paths of a frame, and leaves VPLs where walked_vpls says.
void walk_light_paths(FrameContext& frame, const char* component);

/// Fills FrameBuffers::vpls with the VPLs of a frame whose primary rays have been traced. The
/// stages count for `component`, likewise.
void walk_vpls(FrameContext& frame, const char* component);

class SceneMotion;

/// Keeps light paths, and so VPLs, from frame to frame (FEATURE_TEMPORAL).
class LightPaths {
  public:
    LightPaths(Executor& executor, const FramePlan& plan);

    /// Fills FrameBuffers::vpls. Where paths are `known` from the frame before, only segments that
    /// meet what has moved are traced, and those that follow them; otherwise all are.
    void walk(FrameContext& frame, const char* component, const SceneMotion& motion, bool known);
    /// Marks all VPLs as moved.
    void invalidate_all(Executor& executor);

    /// By VPL, what the last walk has changed: VPL_MOVED, VPL_RECOLOURED (kernels/cache/cache.h).
    [[nodiscard]] BufferRef<kinds::VplChanges> changes() const { return changes_; }

  private:
    std::uint32_t paths_, vpls_;
    DeviceBuffer<kinds::PathsKnown> known_;
    DeviceBuffer<kinds::PathCache> memory_;
    DeviceBuffer<kinds::VplChanges> changes_;
};

}  // namespace weft

#endif
