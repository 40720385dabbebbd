// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FRAME_VIRTUAL_LIGHTS_H
#define WEFT_FRAME_VIRTUAL_LIGHTS_H

#include "frame/frame_context.h"

namespace weft {

/// Fills FrameBuffers::light_samples with the points on lights of a frame: a stage of `component`,
/// the first of the frame that uses them.
void make_light_samples(FrameContext& frame, const char* component);

/// Fills a buffer with the points on area lights from which light in media comes: those of
/// FramePlan::media_samples_per_set of every set.
void make_media_samples(FrameContext& frame, const char* component, Buffer& samples);

/// Fills FrameBuffers::vpls with the indirect VPLs of a frame, likewise.
void walk_vpls(FrameContext& frame, const char* component);

}  // namespace weft

#endif
