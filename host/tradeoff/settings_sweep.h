// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_SETTINGS_SWEEP_H
#define WEFT_TRADEOFF_SETTINGS_SWEEP_H

#include <string>
#include <vector>

#include "plan/preset.h"

namespace weft {

/// Settings to be measured.
struct Candidate {
    std::string name;    ///< unique among those of a sweep, such as "ais threshold 20"
    std::string family;  ///< the algorithm
    Preset preset;
    std::string variant{};       ///< what `name` says besides the algorithm and the samples
    bool fills_budgets = false;  ///< worth as many samples as there is time for
};

/// The same settings with that many samples per pixel, named after them.
[[nodiscard]] Candidate with_samples(const Candidate& candidate, std::uint32_t samples);

/// What of a scene decides which settings make a difference.
struct SweepScene {
    bool indirect = true;        ///< light comes by way of surfaces
    bool sampled_lights = true;  ///< some light has an area, or is the environment
    bool media = false;          ///< light goes through participating media
    bool media_light = false;    ///< which scatter some of it to the camera
    bool adapts = true;          ///< `ais` may leave out samples of it
};

/// That of a scene for which frames of the standard setting are planned like this.
[[nodiscard]] SweepScene sweep_scene(const FramePlan& plan);

/// How many settings to try.
enum class SweepSize : std::uint8_t { quick, full };

/// Settings of single pictures, by algorithm: about a dozen, or about fifty. `tic` is for sequences
/// and has none. Settings that would make the same picture as others of the list are left out.
[[nodiscard]] std::vector<Candidate> settings_sweep(const SweepScene& scene, SweepSize size);

}  // namespace weft

#endif
