// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_CHILD_PROCESS_H
#define WEFT_BENCH_COMMON_CHILD_PROCESS_H

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace weft::bench {

/// Another program whose standard input and output are ours to write and read, line by line. What
/// it says on standard error is dropped. It ends with this object at the latest.
class ChildProcess {
  public:
    /// Starts `command`, which is looked for in PATH. Throws Error (exit code 3) where that fails.
    explicit ChildProcess(const std::vector<std::string>& command);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Writes a line; whether the child still listens.
    bool write_line(const std::string& line);

    /// The next line that the child writes; nothing where it has ended, or said nothing for ten
    /// minutes.
    [[nodiscard]] std::optional<std::string> read_line();

    /// Why a child that no longer answers does not, e.g. "it ended by signal 6".
    [[nodiscard]] std::string fate();

  private:
    int socket_ = -1;
    pid_t process_ = -1;
    std::string unread_;
};

}  // namespace weft::bench

#endif
