// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/virtual_lights.h"

#include <vector>

#include "frame/scene_motion.h"
#include "frame/view_media.h"
#include "kernels/cache.h"

namespace weft {

void make_light_samples(FrameContext& frame, const char* component) {
    frame.run(KernelId::light_samples, Stage::light_samples, component, false,
              with_geometry(frame.scene_buffers,
                            {frame.scene_buffers.lights.get(), frame.scene_buffers.emissive.get(),
                             frame.buffers.or_nothing(frame.buffers.light_samples)}),
              frame.plan.light_sample_count());
}

std::vector<Buffer*> with_lamps(const FrameContext& frame, const std::vector<Buffer*>& others) {
    const SceneBuffers& scene = frame.scene_buffers;
    constexpr std::size_t positions = 0;  // in GEOMETRY_ARGS
    constexpr std::size_t triangles = 1;
    std::vector<Buffer*> all = with_media(
        frame.buffers, {scene.lights.get(), scene.emissive.get(), scene.geometry[positions].get(),
                        scene.geometry[triangles].get()});
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

void make_media_samples(FrameContext& frame, const char* component, Buffer& samples) {
    const FramePlan& plan = frame.plan;
    if (plan.media_samples_per_set == 0) return;
    const shared::Params before = frame.params;
    frame.params.samples_per_light = plan.media_samples_per_light;
    frame.params.samples_per_set = plan.media_samples_per_set;
    frame.params.light_bound_scale *=
        static_cast<float>(plan.media_samples_per_set) / static_cast<float>(plan.samples_per_set);
    frame.run(KernelId::light_samples, Stage::light_samples, component, false,
              with_geometry(frame.scene_buffers, {frame.scene_buffers.lights.get(),
                                                  frame.scene_buffers.emissive.get(), &samples}),
              plan.sets * plan.media_samples_per_set);
    frame.params = before;
}

namespace {

/// The buffers of GEOMETRY_ARGS, LIGHT_ARGS and MEDIA_ARGS, followed by others.
std::vector<Buffer*> with_light_paths(FrameContext& frame, const std::vector<Buffer*>& others) {
    std::vector<Buffer*> arguments =
        with_geometry(frame.scene_buffers,
                      {frame.scene_buffers.lights.get(), frame.scene_buffers.emissive.get()});
    for (Buffer* const buffer : with_media(frame.buffers, others)) arguments.push_back(buffer);
    return arguments;
}

void run_walk(FrameContext& frame, const char* component, Buffer* doubts, Buffer* memory,
              Buffer* changes) {
    frame.run(KernelId::vpl_walk, Stage::vpl_walk, component, true,
              with_light_paths(frame, {doubts, memory, changes, frame.buffers.vpls.get(),
                                       frame.buffers.counters.get()}),
              frame.plan.sets * frame.plan.paths_per_set);
}

}  // namespace

void walk_vpls(FrameContext& frame, const char* component) {
    Buffer* const nothing = frame.buffers.nothing.get();
    run_walk(frame, component, nothing, nothing, nothing);
}

LightPaths::LightPaths(Executor& executor, const FramePlan& plan)
    : paths_(plan.sets * plan.paths_per_set),
      vpls_(plan.sets * plan.vpls_per_set),
      doubts_(executor.allocate(paths_ * sizeof(std::uint32_t), "doubts about light paths")),
      memory_(executor.allocate((2 * std::size_t{paths_} + vpls_) * sizeof(shared::float4),
                                "memory of light paths")),
      changes_(executor.allocate(vpls_ * sizeof(std::uint32_t), "changes of VPLs")) {}

void LightPaths::walk(FrameContext& frame, const char* component, const SceneMotion& motion,
                      bool known) {
    if (known) {
        frame.other_scene = &motion.traced();
        frame.run(
            KernelId::vpl_doubts, Stage::vpl_invalidation, component, true,
            with_light_paths(frame, {memory_.get(), doubts_.get(), frame.buffers.counters.get()}),
            paths_);
        frame.other_scene = nullptr;
    } else {
        const std::vector<std::uint32_t> none(paths_, 0);
        write_buffer<std::uint32_t>(frame.executor, *doubts_, none);
        const std::vector<shared::Vpl> dark(vpls_);
        write_buffer<shared::Vpl>(frame.executor, *frame.buffers.vpls, dark);
    }
    run_walk(frame, component, doubts_.get(), memory_.get(), changes_.get());
}

void LightPaths::doubt_all(Executor& executor) {
    const std::vector<std::uint32_t> all(vpls_, VPL_MOVED);
    write_buffer<std::uint32_t>(executor, *changes_, all);
}

}  // namespace weft
