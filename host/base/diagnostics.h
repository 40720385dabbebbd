// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_DIAGNOSTICS_H
#define WEFT_BASE_DIAGNOSTICS_H

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/quote.h"

namespace weft {

/// Collects warnings, which the user should know but which do not stop the program. The same text
/// is kept once, however often it is reported; the application prints the list on stderr.
class Diagnostics {
  public:
    /// Adds `place: message` (or `message` where `place` is empty) unless it is already there.
    void warn(const std::string& place, const std::string& message) {
        std::string text = place.empty() ? message : one_line(place) + ": " + message;
        if (std::find(warnings_.begin(), warnings_.end(), text) == warnings_.end())
            warnings_.push_back(std::move(text));
    }

    /// All warnings so far, in order of first appearance.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

  private:
    std::vector<std::string> warnings_;
};

}  // namespace weft

#endif
