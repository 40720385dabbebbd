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

}  // namespace weft

#endif
