// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_LEVEL_LAYERS_H
#define WEFT_ADAPTIVE_LEVEL_LAYERS_H

#include <string>

#include "adaptive/level_scheduler.h"
#include "image/image.h"

namespace weft {

/// Adds what the scheduler decided for a component to an image, as layers of one channel:
/// "COMPONENT.level", each tile's level (0 coarse, 1 middle, 2 full); "COMPONENT.samples", 1 where
/// a pixel has a sample; "COMPONENT.error" and "COMPONENT.error_middle", the largest error, in just
/// noticeable differences, that was expected of interpolating each tile's coarse or middle lattice,
/// 0 where that was not judged and the largest float where it was not finite.
void add_level_layers(const std::string& component, const LevelScheduler& scheduler, Image& image);

}  // namespace weft

#endif
