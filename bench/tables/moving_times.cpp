// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/tables/moving_times.h"

#include "bench/dynamic/dynamic_frames.h"
#include "bench/dynamic/dynamic_methods.h"
#include "bench/dynamic/dynamic_run.h"
#include "bench/dynamic/dynamic_sequences.h"
#include "scene/flat_scene.h"

namespace weft::bench {

MovingTimes measure_moving(const BenchScene& source, const SamplingSettings& sampling,
                           std::uint32_t edge, std::uint32_t frames, Executor& executor,
                           Diagnostics& diagnostics) {
    const DynamicScene scene = load_dynamic_scene(source, diagnostics);
    DynamicSequence sequence(scene.scene, scene.camera, *scene.probe, Event::box, frames);
    FlatScene flat = flatten(sequence.at(0));
    DynamicRenderer ic(executor, {"ic", Algorithm::ic, sampling, false, true}, edge);
    DynamicRenderer tic(executor, {"tic", Algorithm::tic, sampling, false, true}, edge);
    MovingTimes times;
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        update_flat(sequence.at(frame), flat);
        const Camera camera = sequence.camera_at(frame);
        const DynamicFrame anew = ic.render(flat, camera);
        const DynamicFrame kept = tic.render(flat, camera);
        // In the first frame, whatever outlasts frames is made, and kernels are compiled.
        if (frame == 0) continue;
        times.ic.push_back(anew.ms);
        times.tic.push_back(kept.ms);
        times.update.push_back(kept.update_ms);
    }
    return times;
}

}  // namespace weft::bench
