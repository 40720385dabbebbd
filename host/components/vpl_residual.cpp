// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "components/component.h"
#include "components/soft_shadows.h"

namespace weft {
namespace {

bool called_for(const FramePlan& plan) {
    return plan.compensation;
}

std::vector<KernelId> kernels(const FramePlan&) {
    return {KernelId::vpl_residual};
}

// What a launch adds to; see vpl_residual.cl.
constexpr std::uint32_t to_direct = 1;
constexpr std::uint32_t to_indirect = 2;

void run(FrameContext& frame, std::uint32_t parts, Buffer& receivers, Buffer& slot_pixel,
         std::uint32_t slots, std::uint32_t stride) {
    const FrameBuffers& buffers = frame.buffers;
    const std::uint32_t slots_before = std::exchange(frame.params.slots, stride);
    frame.params.list_length = parts;
    frame.run(KernelId::vpl_residual, "VPL residual", "", true,
              with_geometry(frame.scene_buffers,
                            {frame.scene_buffers.lights.get(), frame.scene_buffers.emissive.get(),
                             &receivers, &slot_pixel, buffers.or_nothing(buffers.direct),
                             buffers.or_nothing(buffers.indirect), buffers.counters.get()}),
              slots);
    frame.params.slots = slots_before;
}

void run(FrameContext& frame, std::uint32_t parts, const AdaptiveSampling& sampling) {
    run(frame, parts, sampling.receivers(), sampling.slot_pixel(), sampling.slots_used(),
        sampling.slots());
}

void sample(FrameContext& frame) {
    const FrameBuffers& buffers = frame.buffers;
    std::uint32_t rest = 0;
    if (buffers.soft_shadows)
        run(frame, to_direct, buffers.soft_shadows->sampling());
    else if (frame.plan.has_sampled_direct())
        rest |= to_direct;
    if (buffers.adaptive_indirect)
        run(frame, to_indirect, *buffers.adaptive_indirect);
    else if (frame.plan.has_indirect())
        rest |= to_indirect;
    if (rest != 0)
        run(frame, rest, *buffers.receivers, *buffers.slot_pixel, buffers.slots, buffers.slots);
}

/// The irradiance it was added to is reconstructed by its own component.
void reconstruct(FrameContext&) {}

}  // namespace

Component vpl_residual_component() {
    return {"VPL residual", called_for, kernels, sample, reconstruct};
}

}  // namespace weft
