// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_RAY_SETS_H
#define WEFT_BENCH_COMMON_RAY_SETS_H

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/common/frame_recorder.h"
#include "scene/flat_scene.h"
#include "shared/shared_types.h"

namespace weft::bench {

/// Single rays as query_closest and query_any read them.
struct RaySet {
    std::vector<shared::float4> origins;  ///< w: t_max
    std::vector<shared::float4> directions;

    [[nodiscard]] std::size_t size() const noexcept { return origins.size(); }
};

/// Shadow rays as query_packet reads them.
struct PacketSet {
    std::vector<shared::float4> block_origins;  ///< by PACKET_BLOCK rays
    std::vector<float> planes;                  ///< x, y, z of end minus start, and 1 where traced
    std::uint64_t rays = 0;                     ///< to be traced

    [[nodiscard]] std::size_t slots() const noexcept { return planes.size() / 4; }
    [[nodiscard]] const float* plane(std::size_t index) const {
        return planes.data() + index * slots();
    }
};

/// A closest hit as query_closest writes it.
struct QueryHit {
    std::uint32_t triangle;  ///< INVALID_INDEX for a miss
    float t, u, v;
};

/// Answers closest-hit queries; used to make further rays.
using ClosestTracer = std::function<std::vector<QueryHit>(const RaySet&)>;

/// The frame's primary rays through pixel centres, in square tiles of 8 x 8.
[[nodiscard]] RaySet primary_rays(const RecordedFrame& frame);

/// A point that light reaches, lifted off its surface, with the normal of the side it reaches.
struct SurfacePoint {
    shared::float4 position;
    shared::float4 normal;
};

/// `count` random points: where one cosine-distributed bounce from what the camera sees ends.
/// Throws Error (exit code 2) where hardly any bounce hits anything.
[[nodiscard]] std::vector<SurfacePoint> bounce_points(const FlatScene& scene,
                                                      const RecordedFrame& frame,
                                                      const ClosestTracer& trace,
                                                      std::size_t count);

/// A diffuse bounce from each point, in the points' random order.
[[nodiscard]] RaySet bounce_rays(const std::vector<SurfacePoint>& points);

/// From each point to another one.
[[nodiscard]] RaySet segments(const std::vector<SurfacePoint>& points);

/// What vpl_gather traces for about `slots` slots of the frame's work list, in its order: runs of
/// neighbouring blocks from all over the image, every block against all VPLs of its set.
/// Blocks without a ray to trace are left out.
[[nodiscard]] PacketSet shadow_packets(const RecordedFrame& frame, std::size_t slots);

}  // namespace weft::bench

#endif
