// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/silenced_errors.h"

#include <fcntl.h>
#include <unistd.h>

#include <mutex>

#include "base/null_device.h"

namespace weft {
namespace {

// There is one standard error: who comes first takes it away, and who goes last gives it back.
std::mutex guard;
int living = 0;
int kept = -1;  ///< a copy of the descriptor; below zero where there is none

}  // namespace

SilencedErrors::SilencedErrors() {
    const std::lock_guard lock(guard);
    if (living++ > 0) return;
    kept = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (kept < 0) return;
    lead_to_null_device({STDERR_FILENO});
}

SilencedErrors::~SilencedErrors() {
    const std::lock_guard lock(guard);
    if (--living > 0 || kept < 0) return;
    ::dup2(kept, STDERR_FILENO);
    ::close(kept);
}

}  // namespace weft
