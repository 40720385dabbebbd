// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// From which segment on the light paths of the frame before have to be traced again: the first that
// meets something that has moved, where it was or where it is, not beyond what it hit.
// The scene of this launch is what has moved, at both places.
#include "kernels/bvh/trace.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/path/light_path.h"
#include "kernels/path/path_memory.h"

WEFT_KERNEL(vpl_doubts)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint item = range.first + WORK_ITEM(range);
    uint set = item / params.sampling.paths_per_set;
    uint path_in_set = item % params.sampling.paths_per_set;
    uint index = path_index(&params, item);
    SCENE_MAKE(moved);
    GEOMETRY_MAKE(geometry);
    MEDIA_MAKE(through);
    LightPath path = emit_path(&params, &geometry, lights, emissive, index);
    Random random = make_random(params.sampling.seed, index, 0x1F83D9ABu);
    uint rays = 0u;
    uint known = 0u;
    // In media a path takes as many random numbers as its segments ask for.
    int alike = HAS(&params, FEATURE_MEDIA) ? 0 : starts_alike(&path, item, path_memory);
    while (alike != 0 && known < params.sampling.bounces &&
           path_in_set < params.sampling.survivors[known]) {
        Hit hit =
            recall_hit(&params, set, params.sampling.first_vpl[known] + path_in_set, path_memory);
        if (hit.triangle == NOT_TRACED) break;
        // What was hit may itself have moved, and be found a rounding error further away.
        float reach = hit.triangle == NO_TRIANGLE ? RAY_INFINITY : hit.t * 1.0000305f;
        ++rays;
        if (trace_closest(moved, path.origin, path.direction, reach).triangle != NO_TRIANGLE) break;
        ++known;
        Vertex vertex;
        if (follow(&params, hit, &geometry, &through, &random, &path, &vertex) == 0) break;
        if (known < params.sampling.bounces)
            scatter_light_path(&params, &vertex, known - 1u, index, &path);
    }
    known_segments[item] = known;
    count_rays(counters + range.counter, rays);
}
