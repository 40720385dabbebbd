// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_ERROR_H
#define WEFT_BASE_ERROR_H

#include <stdexcept>
#include <string>
#include <string_view>

#include "base/quote.h"

namespace weft {

/// Process exit codes; part of the user interface.
enum class ExitCode : int {
    success = 0,
    usage = 1,
    bad_input = 2,
    device = 3,
    out_of_memory = 4,
    output = 5,
    interrupted = 130,
};

/// A failure with the exit code it ends the program with. `what()` is the one line shown to the
/// user: `place: what is wrong, what was expected`.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

    /// `place` is `file:line`, `file` or `file#/json/pointer`; file names may hold anything.
    Error(ExitCode code, const std::string& place, const std::string& message)
        : std::runtime_error(place.empty() ? message : one_line(place) + ": " + message),
          code_(code) {}

    [[nodiscard]] ExitCode code() const noexcept { return code_; }

  private:
    ExitCode code_;
};

/// Shorthand for the error every reader throws: exit code 2 with a place.
[[nodiscard]] inline Error input_error(const std::string& place, const std::string& message) {
    return {ExitCode::bad_input, place, message};
}

/// Whether a library's message says that it could start no thread (oneTBB's, in its own words and
/// in Embree's). Threads that cannot be started lack memory for their stacks.
[[nodiscard]] inline bool says_no_thread(std::string_view message) {
    return message.starts_with("pthread_create has failed");
}

}  // namespace weft

#endif
