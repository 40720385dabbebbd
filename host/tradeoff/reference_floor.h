// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_REFERENCE_FLOOR_H
#define WEFT_TRADEOFF_REFERENCE_FLOOR_H

#include <optional>

#include "image/image.h"

namespace weft {

/// How much the two halves of a reference differ from each other: in percent of the pixels, those
/// at which an observer sees the difference with a probability of 75 % or more, by HDR-VDP.
struct ReferenceFloor {
    double published = 0.0;  ///< 1 cd/m^2 at value 1
    double display = 0.0;    ///< 100 cd/m^2 at value 1

    [[nodiscard]] bool within(const ReferenceFloor& limits) const {
        return published <= limits.published && display <= limits.display;
    }
};

/// The floor of a reference that is good enough to judge any image by.
inline constexpr ReferenceFloor good_floor{0.1, 1.0};

/// Measures the floor of a reference with layers of its halves; none where it has none. Takes
/// seconds. Throws Error (exit code 2) where an edge is below 2 pixels.
[[nodiscard]] std::optional<ReferenceFloor> measured_floor(const Image& reference);

/// Writes the floor into the metadata of a reference, where `stated_floor` finds it.
void state_floor(const ReferenceFloor& floor, Image& reference);
[[nodiscard]] std::optional<ReferenceFloor> stated_floor(const Image& reference);

}  // namespace weft

#endif
