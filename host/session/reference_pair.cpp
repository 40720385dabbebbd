// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/reference_pair.h"

#include <algorithm>

namespace weft {

ReferencePair::ReferencePair(Executor& executor, const FlatScene& scene,
                             const std::shared_ptr<SceneBuffers>& uploaded, const Camera& camera,
                             const PathSettings& settings) {
    // Far from each other and from seeds that users choose.
    std::uint32_t seed = settings.seed;
    for (std::unique_ptr<ExactRenderer>& half : halves_) {
        constexpr std::uint32_t step = 0x9E3779B9;
        seed += step;
        PathSettings own = settings;
        own.seed = seed;
        half = make_exact_renderer(executor, scene, uploaded, camera, own, {});
    }
}

bool ReferencePair::render_frame(double ms, const KeepGoing& keep_going) {
    ExactRenderer& half = smaller();
    const std::uint64_t before = half.samples();
    // Both halves grow evenly.
    constexpr std::uint64_t most = 64;
    const std::uint64_t lacking = std::max(halves_[0]->samples(), halves_[1]->samples()) - before;
    half.limit_frames(ms, static_cast<std::uint32_t>(lacking > 0 ? std::min(lacking, most) : most));
    (void)half.render_frame(keep_going);
    (void)half.take_stats();
    return !half.has_open_frame() && half.samples() > before;
}

}  // namespace weft
