// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_STOPWATCH_H
#define WEFT_BASE_STOPWATCH_H

#include <chrono>
#include <utility>

namespace weft {

/// Wall time in milliseconds, running from construction.
class Stopwatch {
  public:
    /// Time since the last lap, or since construction for the first.
    double lap() {
        const auto now = Clock::now();
        return Milliseconds(now - std::exchange(last_, now)).count();
    }

    /// Time since construction.
    [[nodiscard]] double total() const { return Milliseconds(Clock::now() - start_).count(); }

  private:
    using Clock = std::chrono::steady_clock;
    using Milliseconds = std::chrono::duration<double, std::milli>;

    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
};

}  // namespace weft

#endif
