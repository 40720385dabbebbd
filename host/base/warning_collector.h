// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_WARNING_COLLECTOR_H
#define WEFT_BASE_WARNING_COLLECTOR_H

#include <cstddef>
#include <set>
#include <string>

#include "base/diagnostics.h"
#include "base/limits.h"
#include "base/warning.h"

namespace weft {

/// The warnings of one scene file. A file with a million equal flaws gives one line, which counts
/// them and names the first place. Messages that quote a hostile file could be endless, so there
/// are limits::max_warnings kinds.
class WarningCollector {
  public:
    explicit WarningCollector(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    /// Reports `number` units at `place` that are not rendered as the file asks: `message` says
    /// what is done instead, in at most 100 characters with a number of at most five digits and the
    /// unit, which leaves room for the place. What lies before its first comma is its title.
    void count(const std::string& place, WarningUnit unit, const std::string& message,
               std::size_t number = 1) {
        if (number > 0 && has_room(place, message))
            diagnostics_.count(place, unit, message, number);
    }

    /// The same where there is nothing to count: `place: message`, with how many other places
    /// there are.
    void once(const std::string& place, const std::string& message) { count(place, {}, message); }

  private:
    bool has_room(const std::string& place, const std::string& message) {
        if (kinds_.contains(message)) return true;
        if (is_full_) return false;
        if (kinds_.size() < limits::max_warnings) return kinds_.insert(message).second;
        is_full_ = true;
        diagnostics_.count(place, {}, "further kinds of warnings are left out", 1);
        return false;
    }

    Diagnostics& diagnostics_;
    std::set<std::string> kinds_;
    bool is_full_ = false;
};

}  // namespace weft

#endif
