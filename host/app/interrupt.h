// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_INTERRUPT_H
#define WEFT_APP_INTERRUPT_H

#include <signal.h>

#include <atomic>

namespace weft {

/// Set once the user asked to stop, with Ctrl-C (SIGINT) or SIGTERM. Work loops poll it.
[[nodiscard]] const std::atomic<bool>& interrupt_flag() noexcept;

/// While it lives, SIGINT and SIGTERM set interrupt_flag() instead of ending the program, so that
/// what was rendered can be kept; a second Ctrl-C ends the program at once with exit code 130.
/// At most one lives at a time.
class InterruptGuard {
  public:
    /// Clears the flag and installs the handlers.
    InterruptGuard();

    /// Restores the earlier handlers.
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

  private:
    struct sigaction old_interrupt_ {};
    struct sigaction old_terminate_ {};
};

}  // namespace weft

#endif
