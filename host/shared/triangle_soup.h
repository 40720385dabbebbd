// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SHARED_TRIANGLE_SOUP_H
#define WEFT_SHARED_TRIANGLE_SOUP_H

#include <span>

#include "shared/shared_types.h"

namespace weft {

/// Triangles with their vertices, which other objects own.
struct TriangleSoup {
    std::span<const shared::float4> positions;
    std::span<const shared::Triangle> triangles;
};

}  // namespace weft

#endif
