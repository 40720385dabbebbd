// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_THREAD_LIMIT_H
#define WEFT_APP_THREAD_LIMIT_H

#include <tbb/global_control.h>

#include <cstdint>
#include <optional>

namespace weft {

/// How many threads the program uses where the user asks for `wanted`: at least 1, and no more than
/// there are processors or than a ThreadLimit allows. TBB would warn of more, in words of its own.
[[nodiscard]] std::uint32_t usable_threads(std::uint32_t wanted);

/// Limits the threads of all parallel work of the host while it lives, the calling thread included:
/// scheduling, building and native kernels alike. It never allows more than was allowed before. It
/// does not limit the threads of OpenCL drivers.
class ThreadLimit {
  public:
    /// `threads` is 1 and up; empty sets no limit.
    explicit ThreadLimit(std::optional<std::uint32_t> threads);
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    std::optional<tbb::global_control> control_;
};

}  // namespace weft

#endif
