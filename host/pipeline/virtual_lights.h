// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_VIRTUAL_LIGHTS_H
#define WEFT_PIPELINE_VIRTUAL_LIGHTS_H

#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/frame_context.h"

namespace weft {

/// Fills FrameBuffers::light_samples with the points on lights of a frame: a stage of `component`,
/// the first of the frame that uses them.
void make_light_samples(FrameContext& frame, const char* component);

/// Fills a buffer with the points on area lights from which light in media comes: those of
/// FramePlan::media_samples_per_set of every set.
void make_media_samples(FrameContext& frame, const char* component,
                        BufferRef<kinds::VirtualLights> samples);

/// Fills FrameBuffers::vpls with the indirect VPLs of a frame, likewise.
void walk_vpls(FrameContext& frame, const char* component);

class SceneMotion;

/// Light paths, and so VPLs, that outlast their frame (FEATURE_TEMPORAL).
class LightPaths {
  public:
    LightPaths(Executor& executor, const FramePlan& plan);

    /// Fills FrameBuffers::vpls. Only segments that meet what has moved are traced, and those that
    /// follow them, unless `known` is false: then all are.
    void walk(FrameContext& frame, const char* component, const SceneMotion& motion, bool known);
    /// As if all VPLs had moved.
    void doubt_all(Executor& executor);

    /// By VPL: VPL_MOVED, VPL_RECOLOURED (kernels/cache/cache.h), by the last walk.
    [[nodiscard]] BufferRef<kinds::VplChanges> changes() const { return changes_; }

  private:
    std::uint32_t paths_, vpls_;
    DeviceBuffer<kinds::PathsKnown> known_;
    DeviceBuffer<kinds::PathCache> memory_;
    DeviceBuffer<kinds::VplChanges> changes_;
};

}  // namespace weft

#endif
