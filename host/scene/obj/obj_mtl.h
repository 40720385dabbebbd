// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_OBJ_OBJ_MTL_H
#define WEFT_SCENE_OBJ_OBJ_MTL_H

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/warning_collector.h"
#include "scene/material.h"

namespace weft {

/// An image that a material names, with its options. Texture coordinates uv of the file become
/// uv * scale + offset.
struct MtlMap {
    std::string file;  ///< as it is written
    std::string place;
    bool clamp = false;
    glm::dvec2 scale{1.0};
    glm::dvec2 offset{0.0};
    double strength = 1.0;  ///< -bm, of normals
    char channel = 0;       ///< -imfchan: r, g, b, m (alpha), l (luminance); 0: not given
};

/// The statements of an MTL material that Weft uses.
struct MtlMaterial {
    std::string place;
    std::optional<glm::vec3> diffuse;      ///< Kd, linear, in [0, 1]
    glm::vec3 emission{0.0F};              ///< Ke, radiance
    std::optional<glm::vec3> specular;     ///< Ks, in [0, 1]
    std::optional<glm::vec3> filter;       ///< Tf, in [0, 1]
    std::optional<double> exponent;        ///< Ns
    std::optional<double> ior;             ///< Ni
    std::optional<double> dissolve;        ///< d
    std::optional<double> transparency;    ///< Tr
    std::optional<double> illumination;    ///< illum
    std::optional<double> roughness;       ///< Pr
    std::optional<double> metallic;        ///< Pm
    std::optional<double> coat;            ///< Pc
    std::optional<double> coat_roughness;  ///< Pcr
    std::optional<MtlMap> diffuse_map;
    std::optional<MtlMap> emission_map;
    std::optional<MtlMap> specular_map;
    std::optional<MtlMap> exponent_map;
    std::optional<MtlMap> dissolve_map;
    std::optional<MtlMap> roughness_map;
    std::optional<MtlMap> metallic_map;
    std::optional<MtlMap> normal_map;
};

/// Reads the materials of an MTL file into `materials`, where the first one of a name stays, as far
/// as `detail` asks. What Weft does not simulate is named in `report`. Throws Error (exit code 2)
/// with `file:line` for numbers that are wrong.
void parse_mtl(std::string_view text, const std::string& file, WarningCollector& report,
               MaterialDetail detail, std::map<std::string, MtlMaterial, std::less<>>& materials);

}  // namespace weft

#endif
