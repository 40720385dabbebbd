// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/component.h"
#include "components/soft_shadows.h"

namespace weft {
namespace {

bool called_for(const FramePlan& plan) {
    return plan.has_sampled_direct() || plan.has_exact_direct();
}

std::vector<KernelId> kernels(const FramePlan& plan) {
    std::vector<KernelId> list;
    if (plan.light_sample_count() > 0) list.push_back(KernelId::light_samples);
    const bool adapts = plan.adapts_direct();
    if ((plan.samples_per_set > 0 && !adapts) || plan.punctual_lights > 0)
        list.push_back(KernelId::vpl_gather);
    if (adapts)
        list.insert(list.end(), {KernelId::soft_shadows, KernelId::tile_shadows,
                                 KernelId::lattice_signal, KernelId::reconstruct_tiles});
    if (plan.has_distant()) list.push_back(KernelId::distant_light);
    if (plan.has_sampled_direct() && !adapts) list.push_back(KernelId::reconstruct);
    return list;
}

void gather(FrameContext& frame, const char* stage, Buffer* irradiance, std::uint32_t first,
            std::uint32_t stride, std::uint32_t length) {
    const FrameBuffers& buffers = frame.buffers;
    frame.params.list_first = first;
    frame.params.list_stride = stride;
    frame.params.list_length = length;
    frame.run(KernelId::vpl_gather, stage, "direct", true,
              {buffers.receivers.get(), buffers.block_set.get(), buffers.light_samples.get(),
               irradiance, buffers.counters.get()},
              buffers.slots / frame.executor.lanes(),
              gather_items_per_launch(frame.executor, length));
}

void sample_distant(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    const FrameBuffers& buffers = frame.buffers;
    frame.params.list_first = plan.area_samples() + plan.punctual_lights;
    frame.params.list_stride = plan.environment_samples;
    frame.run(KernelId::distant_light, "distant light", "direct", true,
              {buffers.receivers.get(), buffers.block_set.get(), frame.scene_buffers.lights.get(),
               buffers.or_nothing(buffers.light_samples), buffers.or_nothing(buffers.direct),
               buffers.or_nothing(buffers.exact_direct), buffers.counters.get()},
              buffers.slots);
}

void clear(FrameContext& frame, const std::unique_ptr<Buffer>& irradiance) {
    const std::vector<float> zero(std::size_t{3} * frame.buffers.slots, 0.0F);
    write_buffer<float>(frame.executor, *irradiance, zero);
}

void sample(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    const FrameBuffers& buffers = frame.buffers;
    frame.run(KernelId::light_samples, "light samples", "direct", false,
              with_geometry(frame.scene_buffers,
                            {frame.scene_buffers.lights.get(), frame.scene_buffers.emissive.get(),
                             buffers.or_nothing(buffers.light_samples)}),
              plan.light_sample_count());
    // What no gather writes, the distant lights add to.
    if (buffers.direct && plan.samples_per_set == 0) clear(frame, buffers.direct);
    if (buffers.exact_direct && plan.punctual_lights == 0) clear(frame, buffers.exact_direct);
    if (buffers.soft_shadows) {
        buffers.soft_shadows->sample(frame);
    } else if (plan.samples_per_set > 0) {
        const bool all = plan.gather_sets == 1;
        gather(frame, "area lights", buffers.direct.get(), 0, plan.samples_per_set,
               all ? plan.area_samples() : plan.samples_per_set);
    }
    if (plan.punctual_lights > 0)
        gather(frame, "punctual lights", buffers.exact_direct.get(), plan.area_samples(), 0,
               plan.punctual_lights);
    if (plan.has_distant()) sample_distant(frame);
}

void reconstruct(FrameContext& frame) {
    const FrameBuffers& buffers = frame.buffers;
    if (!frame.plan.has_sampled_direct()) return;
    if (buffers.soft_shadows) {
        buffers.soft_shadows->reconstruct(frame);
        return;
    }
    frame.run(KernelId::reconstruct, "reconstruction", "direct", false,
              with_gbuffer(buffers, {buffers.pixel_slot.get(), buffers.direct.get(),
                                     buffers.filtered_direct.get()}),
              frame.params.width * frame.params.height);
}

}  // namespace

Component direct_component() {
    return {"direct", called_for, kernels, sample, reconstruct};
}

}  // namespace weft
