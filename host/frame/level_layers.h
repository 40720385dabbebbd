// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FRAME_LEVEL_LAYERS_H
#define WEFT_FRAME_LEVEL_LAYERS_H

#include <string>

#include "image/image.h"
#include "schedule/level_scheduler.h"

namespace weft {

/// Adds what the scheduler decided for a component to a picture, as layers of one channel:
/// "COMPONENT.level", each tile's level (0 coarse, 1 middle, 2 full), and "COMPONENT.samples", 1
/// where a pixel has a sample.
void add_level_layers(const std::string& component, const LevelScheduler& scheduler, Image& image);

}  // namespace weft

#endif
