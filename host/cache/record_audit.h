// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_RECORD_AUDIT_H
#define WEFT_CACHE_RECORD_AUDIT_H

#include <cstdint>
#include <span>

#include "shared/shared_types.h"
#include "shared/triangle_soup.h"

namespace weft {

/// Connections of VPLs that shine with records that face them which meet any of the triangles, or
/// whose VPL is elsewhere (VPL_MOVED in `changes`, by VPL): by testing each with every triangle, in
/// double precision (Moeller and Trumbore 1997). The reference
/// implementation of kernels/cache/cache_doubts.cl.
[[nodiscard]] std::uint64_t affected_connections(std::span<const shared::CacheRecord> records,
                                                 std::span<const shared::Vpl> vpls,
                                                 std::span<const std::uint32_t> changes,
                                                 const TriangleSoup& moved);

}  // namespace weft

#endif
