// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <limits>

#include "bvh/embree.h"
#include "device/native/embree_scene.h"
#include "device/native/native_scene.h"
#include "shared/shared_types.h"

namespace weft {
namespace {

/// Embree's per-query context, extended by the list that `collect` fills.
struct CandidateList {
#if WEFT_EMBREE_MAJOR == 3
    RTCIntersectContext context;
#else
    RTCRayQueryContext context;
#endif
    const EmbreeScene* scene;
    unsigned int* triangles;
    unsigned int capacity;
    unsigned int count;
};

/// Filter that collects every triangle that is hit and rejects the hit, so that traversal goes on.
void collect(const RTCFilterFunctionNArguments* arguments) {
    auto* const list = reinterpret_cast<CandidateList*>(arguments->context);
    for (unsigned int i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        if (list->count < list->capacity)
            list->triangles[list->count++] =
                list->scene->triangle_of(RTCHitN_geomID(arguments->hit, arguments->N, i),
                                         RTCHitN_primID(arguments->hit, arguments->N, i));
        arguments->valid[i] = 0;
    }
}

#if WEFT_EMBREE_MAJOR == 3
/// Embree 3 takes its context by pointer and fills it per query.
struct QueryContext {
    RTCIntersectContext context;
    QueryContext() { rtcInitIntersectContext(&context); }
    RTCIntersectContext* get() { return &context; }
};

void occluded(RTCScene scene, RTCRay* ray) {
    QueryContext context;
    rtcOccluded1(scene, context.get(), ray);
}
void occluded(const int* valid, RTCScene scene, RTCRay4* rays) {
    QueryContext context;
    rtcOccluded4(valid, scene, context.get(), rays);
}
void occluded(const int* valid, RTCScene scene, RTCRay8* rays) {
    QueryContext context;
    rtcOccluded8(valid, scene, context.get(), rays);
}
void occluded(const int* valid, RTCScene scene, RTCRay16* rays) {
    QueryContext context;
    rtcOccluded16(valid, scene, context.get(), rays);
}
void intersect(RTCScene scene, RTCRayHit* ray) {
    QueryContext context;
    rtcIntersect1(scene, context.get(), ray);
}
void collect_candidates(RTCScene scene, RTCRayHit* ray, CandidateList* list) {
    rtcInitIntersectContext(&list->context);
    list->context.filter = collect;
    rtcIntersect1(scene, &list->context, ray);
}
#else
void occluded(RTCScene scene, RTCRay* ray) {
    rtcOccluded1(scene, ray);
}
void occluded(const int* valid, RTCScene scene, RTCRay4* rays) {
    rtcOccluded4(valid, scene, rays);
}
void occluded(const int* valid, RTCScene scene, RTCRay8* rays) {
    rtcOccluded8(valid, scene, rays);
}
void occluded(const int* valid, RTCScene scene, RTCRay16* rays) {
    rtcOccluded16(valid, scene, rays);
}
void intersect(RTCScene scene, RTCRayHit* ray) {
    rtcIntersect1(scene, ray);
}
void collect_candidates(RTCScene scene, RTCRayHit* ray, CandidateList* list) {
    rtcInitRayQueryContext(&list->context);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &list->context;
    arguments.filter = collect;
    arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
    rtcIntersect1(scene, ray, &arguments);
}
#endif

RTCRay make_ray(const float* origin, const float* direction, float t_max) {
    RTCRay ray{};
    ray.org_x = origin[0];
    ray.org_y = origin[1];
    ray.org_z = origin[2];
    ray.dir_x = direction[0];
    ray.dir_y = direction[1];
    ray.dir_z = direction[2];
    ray.tfar = t_max;
    ray.mask = ~0U;
    return ray;
}

RTCRayHit make_query(const float* origin, const float* direction, float t_max) {
    RTCRayHit query{};
    query.ray = make_ray(origin, direction, t_max);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
}

template <class Rays, int Width>
void trace_packet(RTCScene scene, const float* origin, const float* directions, int* lanes) {
    alignas(64) int valid[Width];
    Rays rays{};
    std::memcpy(valid, lanes, sizeof(valid));
    for (int i = 0; i < Width; ++i) {
        rays.org_x[i] = origin[0];
        rays.org_y[i] = origin[1];
        rays.org_z[i] = origin[2];
        rays.tfar[i] = SHADOW_END;
        rays.mask[i] = ~0U;
    }
    std::memcpy(rays.dir_x, directions, sizeof(rays.dir_x));
    std::memcpy(rays.dir_y, directions + Width, sizeof(rays.dir_y));
    std::memcpy(rays.dir_z, directions + 2 * Width, sizeof(rays.dir_z));
    occluded(valid, scene, &rays);
    // Embree marks a blocked ray by tfar = -inf.
    for (int i = 0; i < Width; ++i) lanes[i] = valid[i] != 0 && rays.tfar[i] < 0.0F ? -1 : 0;
}

/// The scene that NativeScene::embree points to.
const EmbreeScene& scene_of(const void* scene) {
    return *static_cast<const EmbreeScene*>(scene);
}

}  // namespace

EmbreeHit embree_closest(void* scene, const float* origin, const float* direction, float t_max) {
    RTCRayHit query = make_query(origin, direction, t_max);
    intersect(scene_of(scene).handle(), &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {std::numeric_limits<unsigned int>::max(), t_max, 0.0F, 0.0F};
    return {scene_of(scene).triangle_of(query.hit.geomID, query.hit.primID), query.ray.tfar,
            query.hit.u, query.hit.v};
}

unsigned int embree_candidates(void* scene, const float* origin, const float* direction,
                               float t_from, float t_to, unsigned int* triangles,
                               unsigned int capacity) {
    RTCRayHit query = make_query(origin, direction, t_to);
    query.ray.tnear = t_from;
    CandidateList list{};
    list.scene = &scene_of(scene);
    list.triangles = triangles;
    list.capacity = capacity;
    collect_candidates(list.scene->handle(), &query, &list);
    return list.count;
}

bool embree_any(void* scene, const float* origin, const float* direction, float t_max) {
    RTCRay ray = make_ray(origin, direction, t_max);
    occluded(scene_of(scene).handle(), &ray);
    return ray.tfar < 0.0F;
}

void embree_any_packet(void* scene, const float* origin, const float* directions, int* lanes,
                       int width) {
    RTCScene handle = scene_of(scene).handle();
    if (width == 16) {
        trace_packet<RTCRay16, 16>(handle, origin, directions, lanes);
    } else if (width == 8) {
        trace_packet<RTCRay8, 8>(handle, origin, directions, lanes);
    } else if (width == 4) {
        trace_packet<RTCRay4, 4>(handle, origin, directions, lanes);
    } else {
        lanes[0] = lanes[0] != 0 && embree_any(scene, origin, directions, SHADOW_END) ? -1 : 0;
    }
}

}  // namespace weft
