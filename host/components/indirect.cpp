// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/component.h"

namespace weft {
namespace {

bool called_for(const FramePlan& plan) {
    return plan.has_indirect();
}

std::vector<KernelId> kernels(const FramePlan&) {
    return {KernelId::vpl_walk, KernelId::vpl_gather, KernelId::reconstruct};
}

void sample(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    const FrameBuffers& buffers = frame.buffers;
    frame.run(KernelId::vpl_walk, "VPL walk", "indirect", true,
              with_geometry(frame.scene_buffers,
                            {frame.scene_buffers.lights.get(), frame.scene_buffers.emissive.get(),
                             buffers.vpls.get(), buffers.counters.get()}),
              plan.sets * plan.paths_per_set);
    const bool all = plan.gather_sets == 1;
    frame.params.list_first = 0;
    frame.params.list_stride = plan.vpls_per_set;
    frame.params.list_length = plan.vpls_per_set * (all ? plan.sets : 1);
    frame.run(KernelId::vpl_gather, "VPL gather", "indirect", true,
              {buffers.receivers.get(), buffers.block_set.get(), buffers.vpls.get(),
               buffers.indirect.get(), buffers.counters.get()},
              buffers.slots / frame.executor.lanes(),
              gather_items_per_launch(frame.executor, frame.params.list_length));
}

void reconstruct(FrameContext& frame) {
    const FrameBuffers& buffers = frame.buffers;
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
