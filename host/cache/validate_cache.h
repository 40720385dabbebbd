// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_VALIDATE_CACHE_H
#define WEFT_CACHE_VALIDATE_CACHE_H

#include <cstdint>
#include <span>

#include "shared/shared_types.h"
#include "shared/triangle_soup.h"

namespace weft {

/// Number of connections, between a VPL that shines and a record that faces it, that meet any of
/// the triangles or whose VPL has moved (VPL_MOVED in `changes`, by VPL). Tests each with every
/// triangle, in double precision (Moeller and Trumbore 1997): the reference implementation of
/// kernels/cache/record_invalidation.cl.
[[nodiscard]] std::uint64_t affected_connections(std::span<const shared::CacheRecord> records,
                                                 std::span<const shared::Vpl> vpls,
                                                 std::span<const std::uint32_t> changes,
                                                 const TriangleSoup& moved);

}  // namespace weft

#endif
