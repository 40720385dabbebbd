// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/component.h"
#include "frame/adaptive_sampling.h"

namespace weft {
namespace {

bool called_for(const FramePlan& plan) {
    return plan.has_indirect();
}

std::vector<KernelId> kernels(const FramePlan& plan) {
    if (plan.adaptive)
        return {KernelId::vpl_walk, KernelId::vpl_gather, KernelId::lattice_signal,
                KernelId::reconstruct_tiles};
    return {KernelId::vpl_walk, KernelId::vpl_gather, KernelId::reconstruct};
}

void gather(FrameContext& frame, Buffer& receivers, Buffer& block_set, std::uint32_t first,
            std::uint32_t count) {
    const FramePlan& plan = frame.plan;
    const std::uint32_t lanes = frame.executor.lanes();
    frame.params.list_first = 0;
    frame.params.list_stride = plan.vpls_per_set;
    frame.params.list_length = plan.vpls_per_set * (plan.gather_sets == 1 ? plan.sets : 1);
    frame.run(KernelId::vpl_gather, "VPL gather", "indirect", true,
              {&receivers, &block_set, frame.buffers.vpls.get(), frame.buffers.indirect.get(),
               frame.buffers.counters.get()},
              count / lanes, gather_items_per_launch(frame.executor, frame.params.list_length),
              first / lanes);
}

void sample(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    const FrameBuffers& buffers = frame.buffers;
    frame.run(KernelId::vpl_walk, "VPL walk", "indirect", true,
              with_geometry(frame.scene_buffers,
                            {frame.scene_buffers.lights.get(), frame.scene_buffers.emissive.get(),
                             buffers.vpls.get(), buffers.counters.get()}),
              plan.sets * plan.paths_per_set);
    if (AdaptiveSampling* const adaptive = buffers.adaptive_indirect.get()) {
        adaptive->sample(frame, "indirect", *buffers.tiles, *buffers.indirect,
                         {[&](std::uint32_t first, std::uint32_t count) {
                              gather(frame, adaptive->receivers(), adaptive->block_set(), first,
                                     count);
                          },
                          nullptr});
    } else {
        gather(frame, *buffers.receivers, *buffers.block_set, 0, buffers.slots);
    }
}

void reconstruct(FrameContext& frame) {
    const FrameBuffers& buffers = frame.buffers;
    if (buffers.adaptive_indirect) {
        buffers.adaptive_indirect->reconstruct(frame, "indirect", *buffers.tiles, *buffers.indirect,
                                               *buffers.filtered_indirect);
        return;
    }
    frame.run(KernelId::reconstruct, "reconstruction", "indirect", false,
              with_gbuffer(buffers, {buffers.pixel_slot.get(), buffers.indirect.get(),
                                     buffers.filtered_indirect.get()}),
              frame.params.width * frame.params.height);
}

}  // namespace

Component indirect_component() {
    return {"indirect", called_for, kernels, sample, reconstruct};
}

}  // namespace weft
