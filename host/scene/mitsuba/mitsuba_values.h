// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_VALUES_H
#define WEFT_SCENE_MITSUBA_MITSUBA_VALUES_H

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/mitsuba/mitsuba_xml.h"

namespace weft::mitsuba {

/// The number in an attribute; it must be finite as a float. Throws Error (exit code 2), as all
/// functions here do for invalid values.
[[nodiscard]] double parse_number(const Element& element, const std::string& text);

/// Numbers separated by blanks or commas, at most `most` of them.
[[nodiscard]] std::vector<double> parse_numbers(const Element& element, const std::string& text,
                                                std::size_t most);

/// The `value` of an `<integer>`.
[[nodiscard]] long parse_integer(const Element& element);

/// The `value` of a `<boolean>`.
[[nodiscard]] bool parse_boolean(const Element& element);

/// A `<point>`, `<vector>`, `<translate>`, `<rotate>` or `<scale>`: `value` with three numbers or
/// x, y and z, which default to `missing`.
[[nodiscard]] glm::dvec3 parse_vector(const Element& element, double missing);

/// A `<transform>`: its children, the first one applied first. Affine, with finite entries.
[[nodiscard]] glm::dmat4 parse_transform(const Element& element);

/// The use of a colour, which decides what a bare spectrum means.
enum class ColourUse { reflectance, emission, medium };

/// The colour of a `<rgb>`, `<spectrum>` or `<float>` in linear Rec.709. A reflectance lies in
/// [0,1], the others are not negative. Spectra that vary become their mean, with a warning.
[[nodiscard]] glm::vec3 parse_colour(const Element& element, ColourUse use, Warnings& warnings);

/// Whether `parse_colour` can read this element.
[[nodiscard]] bool is_colour(const Element& element);

}  // namespace weft::mitsuba

#endif
