// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/interrupt.h"

#include <fcntl.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "base/error.h"

namespace weft {
namespace {

// Time within which a second signal is ignored: programs that pass a signal on send it to the
// process and to its group. Nobody presses Ctrl-C twice so fast.
constexpr std::int64_t repeat_milliseconds = 200;

std::atomic<bool> requested{false};
std::atomic<std::int64_t> requested_at{0};   // 0 before the first signal
std::atomic<const char*> farewell{nullptr};  // null where there is work to keep
static_assert(std::atomic<bool>::is_always_lock_free &&
                  std::atomic<std::int64_t>::is_always_lock_free &&
                  std::atomic<const char*>::is_always_lock_free,
              "a signal handler may touch lock-free atomics only");

std::int64_t milliseconds() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1000000;
}

/// Standard error as it was when the guard was made: it may lead nowhere while a driver compiles.
std::atomic<int> errors{STDERR_FILENO};

void write_text(const char* text) {
    static_cast<void>(::write(errors, text, std::strlen(text)) < 0);
}

extern "C" void weft_handle_interrupt(int signal) {
    const int saved_errno = errno;
    if (const char* const message = farewell) {
        // There may be a progress bar, and the terminal shows ^C.
        termios terminal{};
        if (::tcgetattr(errors, &terminal) == 0) write_text("\n");
        write_text(message);
        write_text("\n");
        ::_exit(static_cast<int>(ExitCode::interrupted));
    }
    const std::int64_t now = milliseconds();
    std::int64_t first = 0;
    if (requested_at.compare_exchange_strong(first, now))
        requested = true;
    else if (signal == SIGINT && now - first > repeat_milliseconds)
        ::_exit(static_cast<int>(ExitCode::interrupted));
    errno = saved_errno;
}

}  // namespace

const std::atomic<bool>& interrupt_flag() noexcept {
    return requested;
}

InterruptGuard::InterruptGuard(const char* message) {
    const int copy = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    errors = copy >= 0 ? copy : STDERR_FILENO;
    farewell = message;
    requested = false;
    requested_at = 0;
    struct sigaction action {};
    action.sa_handler = weft_handle_interrupt;
    action.sa_flags = SA_RESTART;
    ::sigemptyset(&action.sa_mask);
    ::sigaction(SIGINT, &action, &old_interrupt_);
    ::sigaction(SIGTERM, &action, &old_terminate_);
}

InterruptGuard::~InterruptGuard() {
    ::sigaction(SIGINT, &old_interrupt_, nullptr);
    ::sigaction(SIGTERM, &old_terminate_, nullptr);
    farewell = nullptr;
    if (const int copy = errors.exchange(STDERR_FILENO); copy != STDERR_FILENO) ::close(copy);
}

void InterruptGuard::keep_work() noexcept {
    farewell = nullptr;
}

}  // namespace weft
