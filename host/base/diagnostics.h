// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_DIAGNOSTICS_H
#define WEFT_BASE_DIAGNOSTICS_H

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/warning.h"

namespace weft {

/// Collects warnings, which the user should know but which do not stop the program, by their kind:
/// a kind is one message, however many places it applies to. The application prints them on
/// stderr.
class Diagnostics {
  public:
    /// Adds a statement about the whole run, `place: message` (or `message` where `place` is
    /// empty). The same statement about the same place is kept once.
    void warn(const std::string& place, const std::string& message);

    /// Adds a place to what the image lacks of what a scene file asks for, with the `number` of
    /// units there. Readers use a WarningCollector instead.
    void count(const std::string& place, WarningUnit unit, const std::string& message,
               std::size_t number);

    /// All kinds so far, in order of first appearance.
    [[nodiscard]] const std::vector<Warning>& list() const noexcept { return list_; }

    /// One line for each kind, none shortened.
    [[nodiscard]] std::vector<std::string> warnings() const;

    /// The kinds that appeared since the last call.
    [[nodiscard]] std::span<const Warning> take_new();

  private:
    Warning& kind(const std::string& key, std::string_view message);
    void add_place(Warning& warning, const std::string& place, std::size_t number);

    std::vector<Warning> list_;
    std::map<std::string, std::size_t> index_;  ///< into list_, by what distinguishes kinds
    std::size_t places_ = 0;                    ///< of all kinds
    std::size_t taken_ = 0;
};

}  // namespace weft

#endif
