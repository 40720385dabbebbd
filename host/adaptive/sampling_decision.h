// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_SAMPLING_DECISION_H
#define WEFT_ADAPTIVE_SAMPLING_DECISION_H

#include <array>
#include <cstdint>
#include <string>

#include "image/image.h"

namespace weft {

/// Numbers of tiles by their level, and of pixels that were sampled.
struct LevelCounts {
    std::array<std::uint32_t, 3> tiles{};  ///< coarse, middle, full
    std::uint64_t samples = 0;             ///< pixels that are sampled in full
};

/// Where a component was sampled in the last frame, as statistics, layers and the frame budget need
/// to know it.
class SamplingDecision {
  public:
    SamplingDecision() = default;
    SamplingDecision(const SamplingDecision&) = delete;
    SamplingDecision& operator=(const SamplingDecision&) = delete;
    virtual ~SamplingDecision() = default;

    [[nodiscard]] virtual LevelCounts counts() const = 0;
    /// Whether a higher threshold might save samples of a frame like this.
    [[nodiscard]] virtual bool can_save() const = 0;
    /// Whether a lower threshold might add samples to a frame like this.
    [[nodiscard]] virtual bool can_spend() const = 0;
    /// Adds layers named "COMPONENT...." of one channel to an image.
    virtual void add_layers(const std::string& component, Image& image) const = 0;
};

}  // namespace weft

#endif
