// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_SILENCED_ERRORS_H
#define WEFT_DEVICE_OPENCL_SILENCED_ERRORS_H

namespace weft {

/// Throws away what the process writes to standard error while any lives, in whatever thread. For
/// calls in which a driver compiles: compilers print lines of their own there beside what the call
/// returns.
class SilencedErrors {
  public:
    SilencedErrors();
    ~SilencedErrors();
    SilencedErrors(const SilencedErrors&) = delete;
    SilencedErrors& operator=(const SilencedErrors&) = delete;
};

}  // namespace weft

#endif
