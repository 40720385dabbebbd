// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_PRESET_H
#define WEFT_PLAN_PRESET_H

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "plan/denoiser.h"
#include "plan/frame_plan.h"

namespace weft {

/// The contents of a preset file: settings of `weft render` that decide what an image costs and how
/// good it is.
struct Preset {
    Algorithm algorithm = default_algorithm;
    SamplingSettings sampling;  ///< cached and temporal say where indirect light comes from
    std::uint32_t samples = 1;  ///< per pixel, 1 and up
    Denoiser denoiser = Denoiser::none;
    /// Of ais: after so many samples further ones refine the image; see
    /// RenderSettings::refined_after. 0: none does.
    std::uint32_t refined_after = 0;
};

/// The preset as JSON for read_preset, every setting by its name.
[[nodiscard]] nlohmann::json preset_json(const Preset& preset);

/// Reads what preset_json wrote; what is not there has its default. Throws Error (exit code 2) that
/// names file and place where something is unknown, of the wrong kind or out of range.
[[nodiscard]] Preset read_preset(const std::filesystem::path& file);

}  // namespace weft

#endif
