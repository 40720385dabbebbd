// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_XML_H
#define WEFT_SCENE_MITSUBA_MITSUBA_XML_H

#include <cstddef>
#include <deque>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/warning_collector.h"

namespace weft::mitsuba {

/// An XML element after `$parameter` substitution, with the place it was read from.
struct Element {
    std::string tag;
    const std::string* file = nullptr;
    std::size_t line = 0;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<Element> children;

    /// `file:line`, for messages.
    [[nodiscard]] std::string place() const;

    /// The value of an attribute, or null.
    [[nodiscard]] const std::string* attribute(const std::string& name) const;

    /// The value of an attribute that must be there; throws Error (exit code 2) otherwise.
    [[nodiscard]] const std::string& required(const std::string& name) const;
};

/// Warnings of one scene file at the places of its elements; as those of WarningCollector.
class Warnings {
  public:
    explicit Warnings(Diagnostics& diagnostics)
        : diagnostics_(diagnostics), collector_(diagnostics) {}

    /// Reports one unit, the element, that is not rendered as the file asks.
    void count(const Element& element, WarningUnit unit, const std::string& message);

    /// The same where there is nothing to count.
    void once(const Element& element, const std::string& message);

    /// The diagnostics to which readers of other files report.
    [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }

  private:
    Diagnostics& diagnostics_;
    WarningCollector collector_;
};

/// A scene file with its includes, as a tree. Elements keep their address.
struct Document {
    std::filesystem::path path;
    std::deque<std::string> files;  ///< names that Element::file points to
    Element root;                   ///< `<scene>`; includes are spliced into its children
    std::unordered_map<std::string, const Element*> ids;
    std::vector<std::filesystem::path>
        folders;  ///< of `<path>`, those that are searched last first

    /// The element that a `<ref>` leads to, or the element itself. Throws Error (exit code 2) when
    /// the id does not exist.
    [[nodiscard]] const Element& resolve(const Element& element) const;

    /// The file that `reference` at `place` leads to: in the last folder of `folders` that has it,
    /// else in that of the scene, whether it is there or not. Throws Error (exit code 2) for a
    /// reference that leaves its folder.
    [[nodiscard]] std::filesystem::path find_file(const std::string& reference,
                                                  const std::string& place) const;
};

/// Reads a Mitsuba 2 or 3 XML file: `default`, `$name`, `include` and `alias` are resolved here.
/// Elements and attributes that the format does not know are named once in `warnings` and
/// left out. Throws Error with `file:line` (exit code 2).
void load_document(const std::filesystem::path& path, Warnings& warnings, Document& document);

}  // namespace weft::mitsuba

#endif
