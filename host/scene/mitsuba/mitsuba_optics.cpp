// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_optics.h"

#include <algorithm>
#include <array>

namespace weft::mitsuba {

namespace {

struct NamedIor {
    std::string_view name;
    double value;
};

/// At 589 nm, from 0 to 20 degrees Celsius.
constexpr std::array<NamedIor, 23> iors = {{
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"diamond", 2.419},
}};

struct NamedConductor {
    std::string_view name;
    ConductorIndex index;
};

/// Measured spectra, integrated with the CIE 1931 observer under equal-energy light from 360 to 830
/// nm, as Mitsuba's RGB variants do.
constexpr std::array<NamedConductor, 8> conductors = {{
    {"none", {glm::vec3(0.0F), glm::vec3(1.0F)}},
    {"Ag", {{0.1553F, 0.1167F, 0.1384F}, {4.8284F, 3.1222F, 2.1469F}}},
    {"Al", {{1.6575F, 0.8804F, 0.5212F}, {9.2238F, 6.2695F, 4.8370F}}},
    {"Au", {{0.1430F, 0.3753F, 1.4420F}, {3.9830F, 2.3856F, 1.6034F}}},
    {"Cu", {{0.2010F, 0.9237F, 1.1022F}, {3.9133F, 2.4530F, 2.1421F}}},
    {"Cr", {{4.3697F, 2.9165F, 1.6549F}, {5.2065F, 4.2313F, 3.7547F}}},
    {"W", {{4.3708F, 3.3002F, 2.9984F}, {3.5006F, 2.6049F, 2.2732F}}},
    {"TiN", {{1.6484F, 1.1505F, 1.3798F}, {3.3683F, 1.9435F, 1.1021F}}},
}};

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return result;
}

}  // namespace

std::optional<double> named_ior(std::string_view name) {
    const std::string wanted = lower(name);
    const auto* const found = std::find_if(
        iors.begin(), iors.end(), [&](const NamedIor& entry) { return entry.name == wanted; });
    if (found == iors.end()) return std::nullopt;
    return found->value;
}

std::string ior_names() {
    std::string names;
    for (const NamedIor& entry : iors) {
        if (!names.empty()) names += ", ";
        names += entry.name;
    }
    return names;
}

std::optional<ConductorIndex> named_conductor(std::string_view name) {
    const auto* const found =
        std::find_if(conductors.begin(), conductors.end(),
                     [&](const NamedConductor& entry) { return entry.name == name; });
    if (found == conductors.end()) return std::nullopt;
    return found->index;
}

}  // namespace weft::mitsuba
