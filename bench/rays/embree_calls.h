// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_RAYS_EMBREE_CALLS_H
#define WEFT_BENCH_RAYS_EMBREE_CALLS_H

#include "bvh/embree.h"

namespace weft::bench {

/// Types and calls of Embree that are `Width` rays wide.
template <int Width>
struct EmbreeWidth;
template <>
struct EmbreeWidth<1> {
    using Ray = RTCRay;
    using RayHit = RTCRayHit;
};
template <>
struct EmbreeWidth<8> {
    using Ray = RTCRay8;
    using RayHit = RTCRayHit8;
};
template <>
struct EmbreeWidth<16> {
    using Ray = RTCRay16;
    using RayHit = RTCRayHit16;
};

/// How a block of queries is made: in Embree 3 the context, in Embree 4 the arguments.
class QueryOptions {
  public:
    explicit QueryOptions(bool coherent) {
#if WEFT_EMBREE_MAJOR >= 4
        rtcInitIntersectArguments(&intersect_);
        rtcInitOccludedArguments(&occluded_);
        if (coherent) intersect_.flags = occluded_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
#else
        rtcInitIntersectContext(&context_);
        if (coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
    }

#if WEFT_EMBREE_MAJOR >= 4
    void intersect(const int*, RTCScene s, RTCRayHit* r) {
        rtcIntersect1(s, r, &intersect_);
    }
    void intersect(const int* valid, RTCScene s, RTCRayHit8* r) {
        rtcIntersect8(valid, s, r, &intersect_);
    }
    void intersect(const int* valid, RTCScene s, RTCRayHit16* r) {
        rtcIntersect16(valid, s, r, &intersect_);
    }
    void occluded(const int*, RTCScene s, RTCRay* r) {
        rtcOccluded1(s, r, &occluded_);
    }
    void occluded(const int* valid, RTCScene s, RTCRay8* r) {
        rtcOccluded8(valid, s, r, &occluded_);
    }
    void occluded(const int* valid, RTCScene s, RTCRay16* r) {
        rtcOccluded16(valid, s, r, &occluded_);
    }

  private:
    RTCIntersectArguments intersect_;
    RTCOccludedArguments occluded_;
#else
    void intersect(const int*, RTCScene s, RTCRayHit* r) {
        rtcIntersect1(s, &context_, r);
    }
    void intersect(const int* valid, RTCScene s, RTCRayHit8* r) {
        rtcIntersect8(valid, s, &context_, r);
    }
    void intersect(const int* valid, RTCScene s, RTCRayHit16* r) {
        rtcIntersect16(valid, s, &context_, r);
    }
    void occluded(const int*, RTCScene s, RTCRay* r) {
        rtcOccluded1(s, &context_, r);
    }
    void occluded(const int* valid, RTCScene s, RTCRay8* r) {
        rtcOccluded8(valid, s, &context_, r);
    }
    void occluded(const int* valid, RTCScene s, RTCRay16* r) {
        rtcOccluded16(valid, s, &context_, r);
    }

  private:
    RTCIntersectContext context_;
#endif
};

}  // namespace weft::bench

#endif
