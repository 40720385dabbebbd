// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_SAMPLING_DECISION_H
#define WEFT_ADAPTIVE_SAMPLING_DECISION_H

#include <array>
#include <cstdint>
#include <string>

#include "image/image.h"

namespace weft {

/// How many tiles and pixels were sampled how densely.
struct LevelCounts {
    std::array<std::uint32_t, 3> tiles{};  ///< coarse, middle, full
    std::uint64_t samples = 0;             ///< pixels that are sampled in full
};

/// What has decided in the last frame where a component is sampled, as others may know it.
class SamplingDecision {
  public:
    SamplingDecision() = default;
    SamplingDecision(const SamplingDecision&) = delete;
    SamplingDecision& operator=(const SamplingDecision&) = delete;
    virtual ~SamplingDecision() = default;

    [[nodiscard]] virtual LevelCounts counts() const = 0;
    /// Whether a higher or a lower threshold might change the samples of a frame like this.
    [[nodiscard]] virtual bool can_save() const = 0;
    [[nodiscard]] virtual bool can_spend() const = 0;
    /// Adds layers named "COMPONENT...." of one channel to a picture.
    virtual void add_layers(const std::string& component, Image& image) const = 0;
};

}  // namespace weft

#endif
