// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_RAY_PACKETS_H
#define WEFT_SELFTEST_RAY_PACKETS_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "selftest/ray_batch.h"
#include "selftest/watertight.h"

// Rays that share their origins, PACKET_BLOCK at a time, as packets ask for.
namespace weft::selftest {

/// Rays in blocks of one kind, of which hard_rays.h repeats all every twelve rays; without end. The
/// rays of a block start where its first one does. Each block is there twice: with the directions
/// that its rays had, and with such as lead to where these pointed. Rays beyond the last full
/// twelve blocks are left out.
[[nodiscard]] RayBatch in_packets(const RayBatch& rays);

/// Blocks of rays from inside of a room: at vertices, at points of edges and anywhere. Their
/// directions lead out of the room.
[[nodiscard]] RayBatch packets_inside(const Room& room, std::size_t blocks, std::uint32_t seed);

/// What in_packets or packets_inside made as segments from origin to origin + direction.
[[nodiscard]] PacketBatch shadow_packets(const RayBatch& packets);

/// Which of them are blocked, by ray.
[[nodiscard]] std::vector<int> blocked_in_packets(const RayQueries& queries,
                                                  const RayBatch& packets);

}  // namespace weft::selftest

#endif
