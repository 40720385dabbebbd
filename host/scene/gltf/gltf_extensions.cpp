// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "base/quote.h"

namespace weft {
namespace {

/// Read in full, or named by a warning of their own where a material uses them.
constexpr std::array<std::string_view, 21> understood = {
    "EXT_lights_image_based",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "WEFT_medium",
};

/// Not read, but what the rest of the file says of a material is a substitute, even where the file
/// requires them.
constexpr std::array<std::string_view, 3> with_substitute = {
    "ADOBE_materials_clearcoat_specular",
    "ADOBE_materials_clearcoat_tint",
    "KHR_materials_volume_scatter",
};

bool is_understood(std::string_view name) {
    return std::find(understood.begin(), understood.end(), name) != understood.end();
}

bool has_substitute(std::string_view name) {
    return std::find(with_substitute.begin(), with_substitute.end(), name) != with_substitute.end();
}

}  // namespace

void check_gltf_extensions(const GltfDocument& document, WarningCollector& report) {
    const JsonValue root = document.root();
    const std::optional<JsonValue> required = root.find("extensionsRequired");
    for (std::size_t i = 0; required && i < required->size(); ++i) {
        const JsonValue name = required->element(i);
        if (!is_understood(name.as_string()) && !has_substitute(name.as_string()))
            throw name.error("the file requires the extension " + quote(name.as_string()) +
                             ", which is not supported");
    }
    const std::optional<JsonValue> used = root.find("extensionsUsed");
    for (std::size_t i = 0; used && i < used->size(); ++i) {
        const JsonValue name = used->element(i);
        if (!is_understood(name.as_string()))
            report.once(name.place(), "extension " + quote(name.as_string()) +
                                          " is not supported and is ignored");
    }
}

}  // namespace weft
