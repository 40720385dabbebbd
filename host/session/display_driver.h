// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_DISPLAY_DRIVER_H
#define WEFT_SESSION_DISPLAY_DRIVER_H

#include <cstdint>
#include <span>

#include "image/tone.h"

namespace weft {

/// An image as a display gets it.
struct DisplayFrame {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    /// Row-major, top row first; red in the lowest byte, then green, blue and 255. sRGB. What has
    /// alpha is shown before black.
    std::span<const std::uint32_t> colours;
    std::uint64_t samples = 0;  ///< of every pixel
};

/// Receives the image of a session each time that samples have been added to it: a window, a
/// stream, a test.
class DisplayDriver {
  public:
    virtual ~DisplayDriver() = default;

    /// Takes a frame, whose colours are valid during the call only. Called by the thread that
    /// renders.
    virtual void show(const DisplayFrame& frame) = 0;
    /// Exposure of the next frame, in stops.
    [[nodiscard]] virtual double exposure_ev() const { return 0.0; }
    /// Tone curve of the next frame.
    [[nodiscard]] virtual ToneCurve tone() const { return ToneCurve::none; }
};

}  // namespace weft

#endif
