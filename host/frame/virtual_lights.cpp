// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/virtual_lights.h"

#include "frame/view_media.h"

namespace weft {

void make_light_samples(FrameContext& frame, const char* component) {
    frame.run(KernelId::light_samples, "light samples", component, false,
              with_geometry(frame.scene_buffers,
                            {frame.scene_buffers.lights.get(), frame.scene_buffers.emissive.get(),
                             frame.buffers.or_nothing(frame.buffers.light_samples)}),
              frame.plan.light_sample_count());
}

void make_media_samples(FrameContext& frame, const char* component, Buffer& samples) {
    const FramePlan& plan = frame.plan;
    if (plan.media_samples_per_set == 0) return;
    const shared::Params before = frame.params;
    frame.params.samples_per_light = plan.media_samples_per_light;
    frame.params.samples_per_set = plan.media_samples_per_set;
    frame.params.light_bound_scale *=
        static_cast<float>(plan.media_samples_per_set) / static_cast<float>(plan.samples_per_set);
    frame.run(KernelId::light_samples, "light samples", component, false,
              with_geometry(frame.scene_buffers, {frame.scene_buffers.lights.get(),
                                                  frame.scene_buffers.emissive.get(), &samples}),
              plan.sets * plan.media_samples_per_set);
    frame.params = before;
}

void walk_vpls(FrameContext& frame, const char* component) {
    std::vector<Buffer*> arguments =
        with_geometry(frame.scene_buffers,
                      {frame.scene_buffers.lights.get(), frame.scene_buffers.emissive.get()});
    for (Buffer* const buffer :
         with_media(frame.buffers, {frame.buffers.vpls.get(), frame.buffers.counters.get()}))
        arguments.push_back(buffer);
    frame.run(KernelId::vpl_walk, "VPL walk", component, true, arguments,
              frame.plan.sets * frame.plan.paths_per_set);
}

}  // namespace weft
