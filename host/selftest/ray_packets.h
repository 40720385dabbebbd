// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_RAY_PACKETS_H
#define WEFT_SELFTEST_RAY_PACKETS_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "selftest/ray_batch.h"
#include "selftest/watertight.h"

// Rays that share their origins, PACKET_BLOCK at a time, as packets require.
namespace weft::selftest {

/// Sorts rays into blocks of one kind; hard_rays.h repeats its kinds every twelve rays. All rays
/// become infinite, and those of a block start where its first one does. Each block is there twice:
/// with the rays' own directions, and with directions towards the points that the rays aimed at.
/// Rays beyond the last full twelve blocks are left out.
[[nodiscard]] RayBatch in_packets(const RayBatch& rays);

/// Blocks of rays from inside of a room: at vertices, at points of edges and anywhere. Their
/// directions lead out of the room.
[[nodiscard]] RayBatch packets_inside(const Room& room, std::size_t blocks, std::uint32_t seed);

/// The rays of in_packets or packets_inside as segments from origin to origin + direction.
[[nodiscard]] PacketBatch shadow_packets(const RayBatch& packets);

/// Which of these segments are blocked, by ray.
[[nodiscard]] std::vector<int> blocked_in_packets(const RayQueries& queries,
                                                  const RayBatch& packets);

}  // namespace weft::selftest

#endif
