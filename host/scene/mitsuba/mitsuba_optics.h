// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_OPTICS_H
#define WEFT_SCENE_MITSUBA_MITSUBA_OPTICS_H

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace weft::mitsuba {

/// The index of refraction that Mitsuba has by this name, as "bk7"; upper and lower case do not
/// matter.
[[nodiscard]] std::optional<double> named_ior(std::string_view name);

/// The names of all of them, for errors.
[[nodiscard]] std::string ior_names();

/// A metal's complex index of refraction by channel of linear Rec.709.
struct ConductorIndex {
    glm::vec3 eta{0.0F};
    glm::vec3 k{1.0F};
};

/// The metal that Mitsuba has by this name, as "Au"; "none" is a perfect mirror. Nothing for those
/// that Weft has no data of.
[[nodiscard]] std::optional<ConductorIndex> named_conductor(std::string_view name);

}  // namespace weft::mitsuba

#endif
