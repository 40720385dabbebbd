// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_DISPLAY_RESOLVE_H
#define WEFT_SESSION_DISPLAY_RESOLVE_H

#include <memory>
#include <set>
#include <utility>

#include "device/executor.h"
#include "pipeline/frame_renderer.h"
#include "session/display_driver.h"

namespace weft {

/// Turns films into 8-bit images on the device: the mean of the samples, exposed, under a tone
/// curve, sRGB encoded and dithered as PNG files are. Builds no kernel and holds no memory before
/// the first one.
class DisplayResolve {
  public:
    /// `executor` must outlive it.
    explicit DisplayResolve(Executor& executor) : executor_(executor) {}

    /// Shows a film of at least one sample. Throws Error as the executor does.
    void show(const FilmView& film, DisplayDriver& display);

  private:
    /// Fills colours_; returns false where that was cancelled.
    bool resolve(const FilmView& film, float exposure, ToneCurve tone, std::uint32_t pixels);

    Executor& executor_;
    std::set<std::pair<KernelId, std::uint32_t>> built_;  ///< kernels with their features
    DeviceBuffer<kinds::DisplayColours> colours_;
};

}  // namespace weft

#endif
