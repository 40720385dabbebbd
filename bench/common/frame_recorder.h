// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_FRAME_RECORDER_H
#define WEFT_BENCH_COMMON_FRAME_RECORDER_H

#include <cstdint>
#include <memory>
#include <vector>

#include "device/executor.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft::bench {

/// What the VPL gathering of a frame reads, and the acceleration structure the frame was made with.
struct RecordedFrame {
    shared::RenderParams params{};          ///< of the VPL gathering, and of the primary rays
    shared::SetList list{};                 ///< the VPLs of each set
    std::uint32_t slots = 0;                ///< stride of the planes of receivers
    std::vector<float> receivers;           ///< planes, see kernels/core/receivers.h
    std::vector<std::uint32_t> block_sets;  ///< by block of PACKET_BLOCK slots
    std::vector<shared::Vpl> vpls;
    std::unique_ptr<TracedScene> scene;  ///< of the executor that made the frame
    float box_padding = 0.0F;            ///< that `scene` was built with
};

/// Renders one frame of the standard setting (igi, 512 x 512, 3 x 3 interleaving, 64 VPLs a set,
/// tile 64) and keeps what its VPL gathering was given. Throws Error (exit code 2) where the scene
/// calls for no indirect light.
[[nodiscard]] RecordedFrame record_frame(Executor& executor, const FlatScene& scene,
                                         const Camera& camera);

}  // namespace weft::bench

#endif
