// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_CONVEX_MEDIA_H
#define WEFT_SCENE_CONVEX_MEDIA_H

#include "scene/flat_media.h"

namespace weft {

/// Finds out whether the segments of a line inside of the boundaries of media follow from planes
/// alone, and fills in what kernels need for that (MediaRecord::convex and what follows it): where
/// every boundary is closed and convex, each two are apart or one is inside of the other, and no
/// density grid lies around another boundary. Otherwise `convex` is 0 and kernels walk through
/// boundaries hit by hit.
void find_convex_boundaries(FlatMedia& media);

}  // namespace weft

#endif
