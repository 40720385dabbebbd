// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics.h"

#include "base/limits.h"
#include "base/quote.h"

namespace weft {

void Diagnostics::warn(const std::string& place, const std::string& message) {
    // A line end separates what is part of the key, since neither place nor message has one.
    const std::string shown = one_line(place);
    Warning& warning = kind(shown + '\n' + message, message);
    if (warning.places.empty()) add_place(warning, shown, 1);
}

void Diagnostics::count(const std::string& place, WarningUnit unit, const std::string& message,
                        std::size_t number) {
    if (number == 0) return;
    Warning& warning = kind(message, message);
    warning.unit = unit;
    warning.of_file = true;
    add_place(warning, one_line(place), number);
}

Warning& Diagnostics::kind(const std::string& key, std::string_view message) {
    const auto [entry, is_new] = index_.try_emplace(key, list_.size());
    if (is_new) list_.emplace_back().message = message;
    return list_[entry->second];
}

void Diagnostics::add_place(Warning& warning, const std::string& place, std::size_t number) {
    warning.number += number;
    if (!warning.places.empty() && warning.places.back().text == place)
        warning.places.back().number += number;
    else if (warning.places.empty() || places_ < limits::max_warning_places)
        warning.places.push_back({place, number});
    else
        ++warning.places_left_out;
    ++places_;
}

std::vector<std::string> Diagnostics::warnings() const {
    std::vector<std::string> lines;
    lines.reserve(list_.size());
    for (const Warning& warning : list_) lines.push_back(warning_line(warning));
    return lines;
}

std::span<const Warning> Diagnostics::take_new() {
    const std::span<const Warning> fresh = std::span<const Warning>(list_).subspan(taken_);
    taken_ = list_.size();
    return fresh;
}

}  // namespace weft
