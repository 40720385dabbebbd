// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_SETTINGS_SWEEP_H
#define WEFT_TRADEOFF_SETTINGS_SWEEP_H

#include <string>
#include <vector>

#include "plan/preset.h"

namespace weft {

/// A setting to be measured.
struct Candidate {
    std::string name;    ///< unique among those of a sweep, such as "ais threshold 20"
    std::string family;  ///< the algorithm
    Preset preset;
    std::string variant{};       ///< part of `name` besides the algorithm and the samples
    bool fills_budgets = false;  ///< also measured with as many samples as budgets allow
};

/// The same settings with that many samples per pixel, named after them.
[[nodiscard]] Candidate with_samples(const Candidate& candidate, std::uint32_t samples);

/// The properties of a scene that decide which settings make a difference.
struct SweepScene {
    bool indirect = true;        ///< surfaces reflect light to each other
    bool sampled_lights = true;  ///< some light has an area, or is the environment
    bool media = false;          ///< light goes through participating media
    bool media_light = false;    ///< media scatter light to the camera
    bool adapts = true;          ///< `ais` may leave out samples in this scene
    bool oidn = false;           ///< the library Open Image Denoise is there
};

/// The properties of a scene by the plan of frames of the standard setting.
[[nodiscard]] SweepScene sweep_scene(const FramePlan& plan);

/// How many settings to try.
enum class SweepSize : std::uint8_t { quick, full };

/// Settings of single images, by algorithm: about a dozen, or about sixty. `tic` is for sequences
/// and has none. Settings that would make the same image as others of the list are left out.
[[nodiscard]] std::vector<Candidate> settings_sweep(const SweepScene& scene, SweepSize size);

}  // namespace weft

#endif
