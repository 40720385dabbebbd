// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FRAME_MEDIA_BUFFERS_H
#define WEFT_FRAME_MEDIA_BUFFERS_H

#include <memory>
#include <vector>

#include "device/executor.h"
#include "scene/flat_media.h"
#include "scene/flat_scene.h"

namespace weft {

/// Participating media on the device; the order of `all`, and of `grids` behind it, is that of
/// MEDIA_ARGS. Empty for scenes without any, and `grids` for scenes without density grids.
struct MediaBuffers {
    std::vector<std::unique_ptr<Buffer>> all;
    std::vector<std::unique_ptr<Buffer>> grids;

    /// The buffers, followed by others.
    [[nodiscard]] std::vector<Buffer*> followed_by(const std::vector<Buffer*>& others) const;
};

/// Uploads the media, with a tree of their boundaries. The camera is in none until
/// set_media_camera.
[[nodiscard]] MediaBuffers upload_media(Executor& executor, const FlatMedia& media);

/// Tells kernels which boundaries the camera is inside of.
void set_media_camera(Executor& executor, const FlatScene& scene, const Camera& camera,
                      MediaBuffers& buffers);

}  // namespace weft

#endif
