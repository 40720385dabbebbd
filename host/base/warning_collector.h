// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_WARNING_COLLECTOR_H
#define WEFT_BASE_WARNING_COLLECTOR_H

#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "base/diagnostics.h"
#include "base/limits.h"

namespace weft {

/// The warnings of one glTF file. A file with a million equal flaws gives one line, which names
/// the first place.
class WarningCollector {
  public:
    explicit WarningCollector(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    /// Warns at the first place where `message` applies, and never again. Messages that quote a
    /// hostile file could be endless, so there is a last one.
    void once(const std::string& place, const std::string& message) {
        if (said_.size() > limits::max_warnings || !said_.insert(message).second) return;
        if (said_.size() <= limits::max_warnings)
            diagnostics_.warn(place, message);
        else
            diagnostics_.warn(place, "further kinds of warnings are left out");
    }

    /// Counts flaws of one kind; `flush` reports `first place: <total> <what>`.
    void count(const std::string& place, const std::string& what, std::size_t number) {
        if (number == 0) return;
        counts_.try_emplace(what, Count{place, 0}).first->second.number += number;
    }

    /// Reports what was counted.
    void flush() {
        for (const auto& [what, count] : counts_)
            diagnostics_.warn(count.place, std::to_string(count.number) + " " + what);
        counts_.clear();
    }

  private:
    struct Count {
        std::string place;
        std::size_t number;
    };

    Diagnostics& diagnostics_;
    std::set<std::string> said_;
    std::map<std::string, Count> counts_;
};

}  // namespace weft

#endif
