// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_INTERRUPT_H
#define WEFT_APP_INTERRUPT_H

#include <signal.h>

#include <atomic>

namespace weft {

/// Set once the user asked to stop, with Ctrl-C (SIGINT) or SIGTERM. Work loops poll it.
[[nodiscard]] const std::atomic<bool>& interrupt_flag() noexcept;

/// While it lives, SIGINT and SIGTERM end the program at once with exit code 130 and a line on
/// standard error, until there is work to keep. From then on they set interrupt_flag(), so that it
/// can be kept, and only a second Ctrl-C ends the program at once. At most one lives at a time.
class InterruptGuard {
  public:
    /// Clears the flag and installs the handlers. `message` is the line for an end before there is
    /// any work, such as "weft: interrupted"; it must outlive the guard.
    explicit InterruptGuard(const char* message);

    /// Restores the earlier handlers.
    ~InterruptGuard();

    /// Says that from now on there may be work to keep.
    void keep_work() noexcept;
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

  private:
    struct sigaction old_interrupt_ {};
    struct sigaction old_terminate_ {};
};

}  // namespace weft

#endif
