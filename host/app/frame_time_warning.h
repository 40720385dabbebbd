// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_FRAME_TIME_WARNING_H
#define WEFT_APP_FRAME_TIME_WARNING_H

#include <optional>
#include <span>
#include <string>

#include "session/session_stats.h"

namespace weft {

/// What there is to say where the last of `frames`, eight at most, took clearly longer than the
/// target of --frame-time (milliseconds): how long they took, and whether that is all that can be
/// reached. Empty where they kept to it. Goes by the median, since any frame may be late by chance.
[[nodiscard]] std::optional<std::string> frame_time_warning(double target_ms,
                                                            std::span<const FrameStats> frames);

}  // namespace weft

#endif
