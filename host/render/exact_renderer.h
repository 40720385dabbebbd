// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_EXACT_RENDERER_H
#define WEFT_RENDER_EXACT_RENDERER_H

#include <cstdint>

#include "film/film_sums.h"
#include "pipeline/frame_renderer.h"

namespace weft {

/// Renders references: adds independent samples of an unbiased estimate to exact sums, so that the
/// same samples give the same bits however they are spread over frames, runs and machines.
class ExactRenderer : public FrameRenderer {
  public:
    /// Samples still to be made.
    [[nodiscard]] virtual std::uint32_t samples_left() const noexcept = 0;
    static constexpr std::uint32_t any_samples = 0xFFFFFFFF;
    /// Lets the next frames take no longer than so many milliseconds, as far as one sample does not
    /// take longer, and have no more than so many samples, at least 1; infinity and any_samples for
    /// no limit.
    virtual void limit_frames(double ms, std::uint32_t samples = any_samples) noexcept = 0;
    /// Whether a cancelled frame waits to go on.
    [[nodiscard]] virtual bool has_open_frame() const noexcept = 0;
    /// Expected milliseconds of the next frame; 0 before the first.
    [[nodiscard]] virtual double next_frame_ms() const noexcept = 0;
    /// The sums as they are now.
    [[nodiscard]] virtual FilmSums sums() = 0;
};

}  // namespace weft

#endif
