// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_edits.h"

#include <fmt/format.h>

#include <initializer_list>

#include "base/error.h"
#include "base/json_text.h"
#include "base/limits.h"

namespace weft {
namespace {

/// Whether two edits change the same thing in the same frame.
bool is_same_target(const nlohmann::json& a, const nlohmann::json& b) {
    for (const char* const key : {"frame", "object", "light", "material"})
        if (a.value(key, nlohmann::json()) != b.value(key, nlohmann::json())) return false;
    return true;
}

}  // namespace

void ViewEdits::add(std::string_view change, std::uint32_t frame, bool continues) {
    nlohmann::json edit = nlohmann::json::parse(change);
    for (const char* const key : {"frame", "until"})
        if (edit.contains(key))
            throw input_error(fmt::format("message#/edit/{}", key),
                              "is not for a page to say, expected an edit without it");
    edit["frame"] = frame;
    if (continues && !edits_.empty() && is_same_target(edits_.back(), edit)) {
        edits_.back() = std::move(edit);
        return;
    }
    if (edits_.size() >= limits::max_scene_edits)
        throw input_error("message#/edit",
                          fmt::format("is one of more than {}", limits::max_scene_edits));
    edits_.push_back(std::move(edit));
}

void ViewEdits::undo() {
    if (!edits_.empty()) edits_.erase(edits_.size() - 1);
}

std::string ViewEdits::text() const {
    return edits_.empty() ? std::string() : json_line({{"edits", edits_}});
}

}  // namespace weft
