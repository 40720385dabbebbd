// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_COMPILE_SERVER_H
#define WEFT_DEVICE_OPENCL_COMPILE_SERVER_H

#include <sys/types.h>

#include <functional>
#include <mutex>

#include "device/opencl/compile_request.h"

namespace weft {

/// A process that compiles programs for this one, several at once, each in a process of its own:
/// drivers such as PoCL compile one program at a time in a process, whatever its threads. It sleeps
/// between requests, gets no signal of the terminal, and ends with this object or this process.
class CompileServer {
  public:
    /// Forks, so it must be called before the process has a thread or has called OpenCL. Where that
    /// fails nothing is ever compiled.
    CompileServer();
    ~CompileServer();
    CompileServer(const CompileServer&) = delete;
    CompileServer& operator=(const CompileServer&) = delete;

    /// Waits until each program is in the cache or has failed. The caller has to compile those that
    /// failed, and gets their errors. A server that has died compiles nothing. `waiting` is called
    /// some times a second meanwhile, if given.
    [[nodiscard]] CompileTimes compile(const CompileRequest& request,
                                       const std::function<void()>& waiting = {});

    /// Process id of the server; -1 where it could not be started.
    [[nodiscard]] pid_t process() const noexcept { return process_; }

    /// The server that runs, or null. There must not be two.
    [[nodiscard]] static CompileServer* current() noexcept;

  private:
    std::mutex mutex_;
    int socket_ = -1;
    pid_t process_ = -1;
};

}  // namespace weft

#endif
