// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "base/quote.h"

namespace weft::mitsuba {

namespace {

bool is_value(const Element& element) {
    static constexpr std::array<std::string_view, 10> tags = {
        "integer", "float",  "boolean",  "string",    "rgb",
        "point",   "vector", "spectrum", "transform", "blackbody"};
    return std::find(tags.begin(), tags.end(), element.tag) != tags.end();
}

}  // namespace

Object::Object(const Element& element, Context& context)
    : element_(context.document.resolve(element)), context_(context) {
    std::set<std::string> names;
    for (const Element& child : element_.children) {
        const Element& target = context.document.resolve(child);
        const std::string* const name = child.attribute("name");
        if (name == nullptr && is_value(target) && child.tag != "ref") (void)child.required("name");
        if (name != nullptr && !names.insert(*name).second)
            throw input_error(child.place(),
                              quote(*name) + " is given twice, expected it once in an object");
        entries_.push_back({name == nullptr ? std::string() : *name, &target});
    }
}

std::string Object::id_or(const std::string& fallback) const {
    const std::string* const id = element_.attribute("id");
    return id == nullptr ? fallback : *id;
}

const Element* Object::find(std::string_view name) {
    for (Entry& entry : entries_) {
        if (entry.name != name || name.empty()) continue;
        entry.used = true;
        return entry.element;
    }
    return nullptr;
}

const Element* Object::find(std::string_view name, std::initializer_list<std::string_view> tags) {
    const Element* const found = find(name);
    if (found != nullptr && std::find(tags.begin(), tags.end(), found->tag) == tags.end())
        throw input_error(found->place(), fmt::format("{} is a <{}>, expected a <{}>", quote(name),
                                                      found->tag, *tags.begin()));
    return found;
}

double Object::number(std::string_view name, double missing) {
    const Element* const found = find(name, {"float", "integer"});
    return found == nullptr ? missing : parse_number(*found, found->required("value"));
}

std::optional<long> Object::integer(std::string_view name) {
    const Element* const found = find(name, {"integer"});
    if (found == nullptr) return std::nullopt;
    return parse_integer(*found);
}

bool Object::boolean(std::string_view name, bool missing) {
    const Element* const found = find(name, {"boolean"});
    return found == nullptr ? missing : parse_boolean(*found);
}

std::optional<std::string> Object::text(std::string_view name) {
    const Element* const found = find(name, {"string"});
    if (found == nullptr) return std::nullopt;
    return found->required("value");
}

std::optional<glm::dvec3> Object::vector(std::string_view name) {
    const Element* const found = find(name, {"point", "vector"});
    if (found == nullptr) return std::nullopt;
    return parse_vector(*found, 0.0);
}

glm::dmat4 Object::transform(std::string_view name) {
    const Element* const found = find(name, {"transform"});
    return found == nullptr ? glm::dmat4(1.0) : parse_transform(*found);
}

glm::vec3 Object::colour(std::string_view name, ColourUse use, const glm::vec3& missing) {
    const Element* const found = find(name);
    if (found == nullptr) return missing;
    if (is_colour(*found)) return parse_colour(*found, use, context_.warnings);
    context_.warnings.once(
        *found, fmt::format("{} of {} {} as a <{}> is not supported, ignored", quote(name),
                            element_.tag, quote(type()), found->tag));
    return missing;
}

std::filesystem::path Object::file() {
    const Element* const found = find("filename", {"string"});
    if (found == nullptr)
        throw input_error(place(), fmt::format("{} {} without 'filename', expected one",
                                               element_.tag, quote(type())));
    return context_.document.find_file(found->required("value"), found->place());
}

std::vector<const Element*> Object::nested(std::string_view tag) {
    std::vector<const Element*> found;
    for (Entry& entry : entries_) {
        if (entry.used || entry.element->tag != tag) continue;
        entry.used = true;
        found.push_back(entry.element);
    }
    return found;
}

void Object::ignore(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) (void)find(name);
}

void Object::report_unused() {
    for (const Entry& entry : entries_) {
        if (entry.used) continue;
        const std::string what = entry.name.empty() ? fmt::format("nested <{}>", entry.element->tag)
                                                    : "property " + quote(entry.name);
        context_.warnings.once(*entry.element, fmt::format("{} of {} {} is not supported, "
                                                           "ignored",
                                                           what, element_.tag, quote(type())));
    }
}

}  // namespace weft::mitsuba
