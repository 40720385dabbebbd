// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_SESSION_STATS_H
#define WEFT_SESSION_SESSION_STATS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "pipeline/frame_renderer.h"

namespace weft {

/// Name of the light, or other quantity, that the film's values belong to, by COMPONENT_*.
[[nodiscard]] const char* film_component_name(std::size_t component);

/// Values of one component that were negative or not finite, over all frames.
struct NonfiniteSummary {
    std::string component;
    std::uint64_t count = 0;         ///< above 0
    std::uint32_t first_image = 0;   ///< the first with such a value, from 0 on
    std::uint32_t first_sample = 0;  ///< its first frame with such a value
    std::uint32_t first_pixel = 0;   ///< its first such pixel, row-major
};

/// Statistics of the frames of a session: the last ones each, and totals of all.
class SessionStats {
  public:
    /// `kept`: how many of the last frames are kept one by one.
    explicit SessionStats(std::size_t kept) : kept_(kept) {}

    /// Adds frames in the order in which they were made.
    void add(std::vector<FrameStats> frames);
    /// Tells that the next frames come from another renderer, which counts its images from 0 on.
    void begin_renderer();

    [[nodiscard]] const std::deque<FrameStats>& last_frames() const { return frames_; }
    [[nodiscard]] std::uint64_t frames() const { return count_; }
    [[nodiscard]] double ms() const { return ms_; }
    [[nodiscard]] std::uint64_t rays() const { return rays_; }
    /// The components that had values negative or not finite, in any frame.
    [[nodiscard]] std::vector<NonfiniteSummary> nonfinite() const;

  private:
    void add_nonfinite(const FrameStats& frame);

    std::size_t kept_;
    std::deque<FrameStats> frames_;
    std::uint64_t count_ = 0;
    double ms_ = 0.0;
    std::uint64_t rays_ = 0;
    std::uint32_t first_image_ = 0;  ///< of the renderer
    std::uint32_t image_ = 0;        ///< of the last frame
    std::uint32_t sample_ = 0;       ///< of the next frame, if it is of the same image
    std::array<NonfiniteSummary, COMPONENT_COUNT> nonfinite_{};
};

}  // namespace weft

#endif
