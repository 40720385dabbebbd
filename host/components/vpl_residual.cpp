// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/component.h"

namespace weft {
namespace {

bool called_for(const FramePlan& plan) {
    return plan.compensation;
}

std::vector<KernelId> kernels(const FramePlan&) {
    return {KernelId::vpl_residual};
}

void sample(FrameContext& frame) {
    const FrameBuffers& buffers = frame.buffers;
    frame.run(KernelId::vpl_residual, "VPL residual", "", true,
              with_geometry(frame.scene_buffers,
                            {frame.scene_buffers.lights.get(), frame.scene_buffers.emissive.get(),
                             buffers.receivers.get(), buffers.slot_pixel.get(),
                             buffers.or_nothing(buffers.direct),
                             buffers.or_nothing(buffers.indirect), buffers.counters.get()}),
              buffers.slots);
}

/// The irradiance it was added to is reconstructed by its own component.
void reconstruct(FrameContext&) {}

}  // namespace

Component vpl_residual_component() {
    return {"VPL residual", called_for, kernels, sample, reconstruct};
}

}  // namespace weft
