// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_OBJ_OBJ_MESH_H
#define WEFT_SCENE_OBJ_OBJ_MESH_H

#include <cstdint>
#include <span>
#include <vector>

#include "base/warning_collector.h"
#include "scene/obj/obj_data.h"
#include "scene/obj/obj_polygon.h"
#include "scene/scene.h"

namespace weft {

/// Which attributes a mesh keeps of its file.
struct ObjMeshOptions {
    bool uvs = true;
    bool normals = true;
    bool colours = true;
};

/// Makes meshes of faces of an OBJ file. Corners that agree in position, texture coordinates and
/// normal become one vertex. Faces without normals among others that have some keep their own
/// normal. Texture coordinates stay as in the file, v upwards.
class ObjMeshMaker {
  public:
    ObjMeshMaker(const ObjData& data, WarningCollector& report) : data_(data), report_(report) {}

    /// The mesh of the faces with these indices. Faces with a corner that is not finite are left
    /// out and counted in the report.
    [[nodiscard]] Mesh make(std::span<const std::uint32_t> faces, const ObjMeshOptions& wanted);

  private:
    /// The indices that identify a vertex, and where it is used.
    struct Key {
        std::int32_t position;
        std::int32_t uv;
        std::int32_t normal;  // beyond those of the file: of a face in face_normals_
        std::uint32_t corner;
    };

    void add_face(const ObjFace& face, const ObjMeshOptions& options, bool any_normals);
    void add_vertex(const Key& key, const ObjMeshOptions& options, bool any_normals, Mesh& mesh);
    [[nodiscard]] bool has_normals(std::span<const std::uint32_t> faces) const;
    [[nodiscard]] bool is_usable_normal(std::int32_t normal) const;

    const ObjData& data_;
    WarningCollector& report_;
    PolygonCutter cutter_;
    std::vector<glm::dvec3> polygon_;
    std::vector<Key> keys_;
    std::vector<PolygonCutter::Triangle> triangles_;
    std::vector<glm::vec3> face_normals_;
};

}  // namespace weft

#endif
