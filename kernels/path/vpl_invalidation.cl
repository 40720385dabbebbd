// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Finds, for each light path stored from the frame before, the first segment that moved geometry
// invalidates, by meeting it at its old or new place and not beyond the segment's own hit. The
// scene of this launch is the moved geometry alone, at both places. One work-item per light path
// stores in `known_segments` how many segments before that one stay valid.
#include "kernels/bvh/trace.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/path/light_path.h"
#include "kernels/path/light_path_cache.h"

WEFT_KERNEL(vpl_invalidation)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint item = range.first + WORK_ITEM(range);
    uint set = item / params.sampling.paths_per_set;
    uint path_in_set = item % params.sampling.paths_per_set;
    uint index = path_index(&params, item);
    SCENE_MAKE(moved);
    GEOMETRY_MAKE(geometry);
    MEDIA_MAKE(through);
    ENVIRONMENT_MAKE(environment);
    LightPath path = emit_path(&params, &geometry, lights, emissive, &environment, index);
    Random random = make_random(params.sampling.seed, index, 0x1F83D9ABu);
    uint rays = 0u;
    uint known = 0u;
    // In media all segments are traced anew: a path takes as many random numbers as these need.
    int alike = HAS(&params, FEATURE_MEDIA) ? 0 : starts_alike(&path, item, light_path_cache);
    while (alike != 0 && known < params.sampling.bounces &&
           path_in_set < params.sampling.survivors[known]) {
        Hit hit = load_hit(&params, set, params.sampling.first_vpl[known] + path_in_set,
                           light_path_cache);
        if (hit.triangle == NOT_TRACED) break;
        // What was hit may itself have moved, and be found a rounding error further away.
        float reach = hit.triangle == INVALID_INDEX ? RAY_INFINITY : hit.t * 1.0000305f;
        ++rays;
        if (trace_closest(moved, path.origin, path.direction, reach).triangle != INVALID_INDEX)
            break;
        ++known;
        Vertex vertex;
        if (scatter(&params, hit, &geometry, &through, &random, &path, &vertex) == 0) break;
        if (known < params.sampling.bounces)
            scatter_light_path(&params, &vertex, known - 1u, index, &path);
    }
    known_segments[item] = known;
    count_rays(counters + range.counter, rays);
}
