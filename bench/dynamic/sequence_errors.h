// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_SEQUENCE_ERRORS_H
#define WEFT_BENCH_DYNAMIC_SEQUENCE_ERRORS_H

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "bench/dynamic/dynamic_frames.h"
#include "image/image.h"
#include "scene/scene.h"
#include "tradeoff/image_errors.h"

namespace weft::bench {

/// What changes from a frame to the next beyond what changes in the references, over the pixels
/// that show the same place in both.
struct Flicker {
    double change = 0.0;         ///< mean, PU21 units
    double unsteady = 0.0;       ///< percent of these pixels, by more than one unit
    std::optional<double> seen;  ///< percent of these pixels, whose change an observer sees with a
                                 ///< probability of 75 % or more, but not that of the reference
};

/// How one frame of a method differs from what it should be.
struct FrameErrors {
    ImageErrors converged;
    ImageErrors same_vpls;  ///< without what an observer sees
    std::optional<Flicker> flicker;

    [[nodiscard]] nlohmann::json json() const;
};

/// Judges the frames of a sequence, one after the other, whatever method they are of.
class SequenceJudge {
  public:
    /// Goes on to the next frame; `visible`: HDR-VDP is to be asked.
    void next(ReferenceFrame reference, const Camera& camera, bool visible);

    /// `before`: the same method's image of the frame before, or null.
    [[nodiscard]] FrameErrors judge(const Image* before, const Image& now) const;

    /// Of the frame that is judged.
    [[nodiscard]] const ReferenceFrame& reference() const { return now_; }

  private:
    [[nodiscard]] Flicker flicker(const Image& before, const Image& now) const;

    ReferenceFrame before_, now_;
    Camera camera_before_, camera_;
    bool visible_ = false;
    bool follows_ = false;                 ///< another frame
    std::vector<std::uint32_t> matches_;   ///< by pixel, in the frame before
    std::vector<float> reference_change_;  ///< by pixel, probability that it is seen
};

}  // namespace weft::bench

#endif
