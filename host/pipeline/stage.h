// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_STAGE_H
#define WEFT_PIPELINE_STAGE_H

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace weft {

/// The steps of a frame: each runs one kernel or some work of the host (stages.def).
enum class Stage : std::uint8_t {
#define WEFT_STAGE(id, name) id,
#include "pipeline/stages.def"
#undef WEFT_STAGE
};

/// How statistics, progress and benchmarks print a stage.
[[nodiscard]] constexpr std::string_view stage_name(Stage stage) {
    constexpr std::string_view names[] = {
#define WEFT_STAGE(id, name) name,
#include "pipeline/stages.def"
#undef WEFT_STAGE
    };
    return names[static_cast<std::size_t>(stage)];
}

/// Whether a stage gives receivers or pixels light, or what stands for it, such as occlusion. The
/// others prepare that, or make an image of it.
[[nodiscard]] constexpr bool brings_light(Stage stage) {
    switch (stage) {
        case Stage::area_lights:
        case Stage::punctual_lights:
        case Stage::distant_light:
        case Stage::shadow_probes:
        case Stage::vpl_gather:
        case Stage::vpl_residual:
        case Stage::bounce_rays:
        case Stage::cache_lookup:
        case Stage::media_area_lights:
        case Stage::media_punctual_lights:
        case Stage::media_vpls:
        case Stage::media_distant_light:
        case Stage::occlusion_rays:
            return true;
        default:
            return false;
    }
}

}  // namespace weft

#endif
