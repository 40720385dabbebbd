// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_OBJ_OBJ_DATA_H
#define WEFT_SCENE_OBJ_OBJ_DATA_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/warning_collector.h"

namespace weft {

/// A corner of a face: indices into the tables of ObjData, -1 where it names none.
struct ObjCorner {
    std::int32_t position = -1;
    std::int32_t uv = -1;
    std::int32_t normal = -1;
};

/// A polygon of at least three corners.
struct ObjFace {
    std::uint32_t first = 0;  ///< index into ObjData::corners
    std::uint32_t count = 0;
    std::uint32_t line = 0;
};

/// A material that is used from this face on, until the next use.
struct ObjMaterialUse {
    std::uint32_t first_face = 0;
    std::uint32_t name = 0;  ///< index into ObjData::material_names
};

/// The files that an `mtllib` names, in its words.
struct ObjLibrary {
    std::string place;
    std::string names;
};

/// The contents of an OBJ file, with indices checked, before meshes are made of it.
struct ObjData {
    std::string file;
    std::vector<glm::vec3> positions;  ///< may be infinite or NaN
    std::vector<glm::vec3> colours;    ///< linear, in [0, 1]; empty, or as long as `positions`
    std::vector<glm::vec2> uvs;        ///< v upwards, finite
    std::vector<glm::vec3> normals;    ///< unit length, or zero where invalid
    std::vector<ObjCorner> corners;
    std::vector<ObjFace> faces;
    std::vector<ObjMaterialUse> uses;
    std::vector<std::string> material_names;  ///< each once
    std::vector<ObjLibrary> libraries;

    /// `file:line` of a face.
    [[nodiscard]] std::string place(const ObjFace& face) const {
        return file + ":" + std::to_string(face.line);
    }
};

/// Reads the statements of an OBJ file. Statements that Weft does not use are named in `report`.
/// Throws Error (exit code 2) with `file:line` for numbers and indices that are wrong.
[[nodiscard]] ObjData parse_obj(std::string_view text, const std::string& file,
                                WarningCollector& report);

}  // namespace weft

#endif
