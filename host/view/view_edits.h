// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_EDITS_H
#define WEFT_VIEW_VIEW_EDITS_H

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace weft {

/// The changes of a scene that pages have asked for, as a file of edits has them.
class ViewEdits {
  public:
    ViewEdits() = default;
    /// Those of a file of edits, which was read for the scene.
    explicit ViewEdits(const nlohmann::json& file) : edits_(file.at("edits")) {}

    /// Adds a change at a frame: an edit without its frame, JSON. Where it `continues` the one
    /// before, it takes its place, if that was of the same thing in the same frame. Throws Error
    /// (exit code 2) where there are too many.
    void add(std::string_view change, std::uint32_t frame, bool continues);
    /// Takes back the edit that came last, if there is one.
    void undo();
    void clear() { edits_.clear(); }

    [[nodiscard]] std::size_t count() const { return edits_.size(); }
    [[nodiscard]] const nlohmann::json& list() const { return edits_; }
    /// A file of edits in one line; empty where there are none.
    [[nodiscard]] std::string text() const;

  private:
    nlohmann::json edits_ = nlohmann::json::array();
};

}  // namespace weft

#endif
