// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/virtual_lights.h"

#include <vector>

#include "kernels/cache/cache.h"
#include "pipeline/camera_vpls.h"
#include "pipeline/scene_motion.h"
#include "pipeline/view_media.h"

namespace weft {

namespace {

/// Points on lights for as many sets as the plan has.
void sample_lights(FrameContext& frame, const char* component,
                   const shared::LightSampling& sampling, BufferRef<kinds::VirtualLights> samples,
                   std::uint32_t count) {
    frame.run(Stage::light_samples, component,
              kernels::light_samples{.geometry = view(frame.scene_buffers.geometry),
                                     .light_table = view(frame.scene_buffers.light_table),
                                     .environment = view(frame.scene_buffers.environment),
                                     .light_sampling = sampling,
                                     .samples = samples},
              {count});
}

void run_walk(FrameContext& frame, const char* component, BufferRef<kinds::PathsKnown> known,
              BufferRef<kinds::PathCache> memory, BufferRef<kinds::VplChanges> changes) {
    frame.run(Stage::vpl_walk, component,
              kernels::vpl_walk{.scene = frame.scene_buffers.seen_by_light(),
                                .geometry = view(frame.scene_buffers.geometry),
                                .light_table = view(frame.scene_buffers.light_table),
                                .environment = view(frame.scene_buffers.environment),
                                .media_tables = frame.buffers.media(),
                                .known_segments = known,
                                .light_path_cache = memory,
                                .vpl_changes = changes,
                                .vpls = walked_vpls(frame.buffers),
                                .counters = frame.buffers.counters},
              {frame.plan.sets * frame.plan.paths_per_set});
}

}  // namespace

void make_light_samples(FrameContext& frame, const char* component) {
    if (frame.plan.light_sample_count() == 0) return;
    sample_lights(frame, component, frame.params.sampling.lights, frame.buffers.light_samples,
                  frame.plan.light_sample_count());
}

void make_media_samples(FrameContext& frame, const char* component,
                        BufferRef<kinds::VirtualLights> samples) {
    const FramePlan& plan = frame.plan;
    if (plan.media_samples_per_set == 0) return;
    shared::LightSampling sampling = frame.params.sampling.lights;
    sampling.per_light = plan.media_samples_per_light;
    sampling.per_set = plan.media_samples_per_set;
    sampling.bound_scale *=
        static_cast<float>(plan.media_samples_per_set) / static_cast<float>(plan.samples_per_set);
    sample_lights(frame, component, sampling, samples, plan.sets * plan.media_samples_per_set);
}

std::vector<KernelId> vpl_kernels(const FramePlan& plan) {
    std::vector<KernelId> kernels{KernelId::vpl_walk};
    if (plan.vpl_tail) kernels.push_back(KernelId::vpl_tail);
    if (plan.selects_vpls()) kernels.push_back(KernelId::vpl_contribution);
    if (plan.local_bound_scale > 0.0) kernels.push_back(KernelId::vpl_bounds);
    return kernels;
}

BufferRef<kinds::VirtualLights> walked_vpls(const FrameBuffers& buffers) {
    if (buffers.camera_vpls) return buffers.camera_vpls->candidates();
    return buffers.vpls;
}

void walk_light_paths(FrameContext& frame, const char* component) {
    run_walk(frame, component, {}, {}, {});
}

void walk_vpls(FrameContext& frame, const char* component) {
    const FramePlan& plan = frame.plan;
    walk_light_paths(frame, component);
    if (plan.vpl_tail)
        frame.run(Stage::vpl_tail, component, kernels::vpl_tail{.vpls = walked_vpls(frame.buffers)},
                  {1});
    if (frame.buffers.camera_vpls) frame.buffers.camera_vpls->select(frame, component);
    if (plan.local_bound_scale > 0.0) {
        const std::uint32_t count = plan.sets * plan.vpls_per_set;
        const double growth = static_cast<double>(frame.params.sampling.vpl_bound) / plan.vpl_bound;
        frame.run(Stage::vpl_bounds, component,
                  kernels::vpl_bounds{.vpl_count = count,
                                      .scale = static_cast<float>(plan.local_bound_scale * growth),
                                      .vpls = frame.buffers.vpls},
                  {count});
    }
}

LightPaths::LightPaths(Executor& executor, const FramePlan& plan)
    : paths_(plan.sets * plan.paths_per_set),
      vpls_(plan.sets * plan.vpls_per_set),
      known_(allocate<kinds::PathsKnown>(executor, paths_, "known segments of light paths")),
      memory_(allocate<kinds::PathCache>(executor, 2 * std::size_t{paths_} + vpls_,
                                         "memory of light paths")),
      changes_(allocate<kinds::VplChanges>(executor, vpls_, "changes of VPLs")) {}

void LightPaths::walk(FrameContext& frame, const char* component, const SceneMotion& motion,
                      bool known) {
    if (known) {
        frame.run(Stage::vpl_invalidation, component,
                  kernels::vpl_invalidation{.scene = motion.traced(),
                                            .geometry = view(frame.scene_buffers.geometry),
                                            .light_table = view(frame.scene_buffers.light_table),
                                            .environment = view(frame.scene_buffers.environment),
                                            .media_tables = frame.buffers.media(),
                                            .light_path_cache = memory_,
                                            .known_segments = known_,
                                            .counters = frame.buffers.counters},
                  {paths_});
    } else {
        const std::vector<std::uint32_t> none(paths_, 0);
        write_buffer(frame.executor, known_, none);
        const std::vector<shared::Vpl> dark(vpls_);
        write_buffer(frame.executor, frame.buffers.vpls, dark);
    }
    run_walk(frame, component, known_, memory_, changes_);
}

void LightPaths::invalidate_all(Executor& executor) {
    const std::vector<std::uint32_t> all(vpls_, VPL_MOVED);
    write_buffer(executor, changes_, all);
}

}  // namespace weft
