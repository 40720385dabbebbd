// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_OBJECT_H
#define WEFT_SCENE_MITSUBA_MITSUBA_OBJECT_H

#include <filesystem>
#include <glm/glm.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mitsuba/mitsuba_values.h"
#include "scene/mitsuba/mitsuba_xml.h"

namespace weft::mitsuba {

/// What every part of the reader needs.
struct Context {
    Document& document;
    Warnings& warnings;
};

/// The properties and nested objects of one `<shape>`, `<bsdf>`, ... Each access marks what it
/// used, so that the rest can be reported. Wrong values throw Error with `file:line`.
class Object {
  public:
    /// Follows references. Throws Error when a property has no name or is given twice.
    Object(const Element& element, Context& context);

    [[nodiscard]] const Element& element() const { return element_; }
    [[nodiscard]] std::string place() const { return element_.place(); }

    /// The `type` attribute, which must be there.
    [[nodiscard]] const std::string& type() const { return element_.required("type"); }

    /// The `id` attribute, or `fallback` where there is none.
    [[nodiscard]] std::string id_or(const std::string& fallback) const;

    /// The property or nested object of this name, or null.
    [[nodiscard]] const Element* find(std::string_view name);

    [[nodiscard]] double number(std::string_view name, double missing);
    [[nodiscard]] std::optional<long> integer(std::string_view name);
    [[nodiscard]] bool boolean(std::string_view name, bool missing);
    [[nodiscard]] std::optional<std::string> text(std::string_view name);
    [[nodiscard]] std::optional<glm::dvec3> vector(std::string_view name);
    [[nodiscard]] glm::dmat4 transform(std::string_view name);
    [[nodiscard]] glm::vec3 colour(std::string_view name, ColourUse use, const glm::vec3& missing);

    /// The file named by `filename`, resolved inside the folder of the scene.
    [[nodiscard]] std::filesystem::path file();

    /// Nested objects of a tag that are not used yet, in order of appearance.
    [[nodiscard]] std::vector<const Element*> nested(std::string_view tag);

    /// Marks properties that are known and have no effect here.
    void ignore(std::initializer_list<std::string_view> names);

    /// Warns once about everything that no access used.
    void report_unused();

  private:
    struct Entry {
        std::string name;
        const Element* element;  ///< references followed
        bool used = false;
    };

    const Element* find(std::string_view name, std::initializer_list<std::string_view> tags);

    const Element& element_;
    Context& context_;
    std::vector<Entry> entries_;
};

}  // namespace weft::mitsuba

#endif
