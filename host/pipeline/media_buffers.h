// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_MEDIA_BUFFERS_H
#define WEFT_PIPELINE_MEDIA_BUFFERS_H

#include "device/launch.h"
#include "scene/flat_media.h"
#include "scene/flat_scene.h"

namespace weft {

/// Participating media on the device: none of the buffers for scenes without any, and none of the
/// last three for scenes without density grids.
using MediaBuffers = owned::MediaTables;

/// Uploads the media, with a tree of their boundaries. The camera is in none until
/// set_media_camera.
[[nodiscard]] MediaBuffers upload_media(Executor& executor, const FlatMedia& media);

/// Tells kernels which boundaries the camera is inside of.
void set_media_camera(Executor& executor, const FlatScene& scene, const Camera& camera,
                      MediaBuffers& buffers);

}  // namespace weft

#endif
