// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_DEADLINE_H
#define WEFT_SESSION_DEADLINE_H

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "base/stopwatch.h"

namespace weft {

/// When the samples of an image have to be done: at the end of a budget's time, less what was
/// reserved for what has to happen after them.
class Deadline {
  public:
    /// `time_ms`: of the whole, empty for no deadline; `spent_ms` of it were spent before now.
    /// `clock` returns milliseconds; the steady clock, from now on, where it is empty.
    Deadline(const std::optional<double>& time_ms, double spent_ms,
             std::function<double()> clock = {})
        : time_ms_(time_ms), spent_ms_(spent_ms), clock_(std::move(clock)) {
        if (clock_) begin_ms_ = clock_();
    }

    [[nodiscard]] bool is_set() const { return time_ms_.has_value(); }
    /// Milliseconds since the work began, those spent before included.
    [[nodiscard]] double ms() const {
        return spent_ms_ + (clock_ ? clock_() - begin_ms_ : watch_.total());
    }
    /// Reserves so many milliseconds at the end, in place of what was reserved before.
    void reserve(double ms) { reserved_ms_ = std::max(ms, 0.0); }
    /// Milliseconds until the deadline, below 0 after it; infinite without one.
    [[nodiscard]] double left_ms() const {
        return time_ms_ ? *time_ms_ - reserved_ms_ - ms() : std::numeric_limits<double>::infinity();
    }
    /// Share of the time until the deadline that has gone, at most 1. Only where one is set.
    [[nodiscard]] double share() const {
        const double all = *time_ms_ - reserved_ms_;
        return all > 0.0 ? std::min(1.0, ms() / all) : 1.0;
    }

  private:
    std::optional<double> time_ms_;
    double spent_ms_;
    std::function<double()> clock_;
    double begin_ms_ = 0.0;
    double reserved_ms_ = 0.0;
    Stopwatch watch_;
};

}  // namespace weft

#endif
