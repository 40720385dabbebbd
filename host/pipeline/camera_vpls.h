// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_CAMERA_VPLS_H
#define WEFT_PIPELINE_CAMERA_VPLS_H

#include <cstdint>

#include "pipeline/frame_context.h"

namespace weft {

/// Chooses the VPLs of a frame among those that many light paths leave, by what they bring to
/// points that the camera sees (FramePlan::selects_vpls).
class CameraVpls {
  public:
    CameraVpls(Executor& executor, const FramePlan& plan, std::uint32_t pixels);

    /// Where light paths leave their VPLs.
    [[nodiscard]] BufferRef<kinds::VirtualLights> candidates() const { return candidates_; }
    /// Fills FrameBuffers::vpls from the candidates. The stages count for `component`.
    void select(FrameContext& frame, const char* component);

  private:
    std::uint32_t points_;  ///< of each set
    DeviceBuffer<kinds::VirtualLights> candidates_;
    DeviceBuffer<kinds::SlotPixels> view_points_;
    DeviceBuffer<kinds::VplContributions> contributions_;
};

}  // namespace weft

#endif
