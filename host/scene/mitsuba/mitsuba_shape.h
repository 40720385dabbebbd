// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_SHAPE_H
#define WEFT_SCENE_MITSUBA_MITSUBA_SHAPE_H

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>

#include "scene/mitsuba/mitsuba_material.h"
#include "scene/mitsuba/mitsuba_medium.h"
#include "scene/mitsuba/mitsuba_object.h"
#include "scene/scene.h"

namespace weft::mitsuba {

/// Turns `<shape>` elements into meshes with instances or medium boundaries. Transforms that
/// mirror are folded into the mesh, so that every Instance::to_world keeps handedness and the
/// triangles face the side that Mitsuba takes as the front.
class ShapeReader {
  public:
    ShapeReader(Context& context, MaterialReader& materials, MediumReader& media, Scene& scene)
        : context_(context), materials_(materials), media_(media), scene_(scene) {}

    /// Adds one shape; kinds that are not supported are named in a warning and left out. Throws
    /// Error (exit code 2) for wrong values and files.
    void read(const Element& element);

  private:
    /// The inputs that determine the mesh of a shape.
    struct Source {
        std::string type;
        std::string path;  ///< of the PLY or OBJ file
        bool face_normals = false;
        bool flip_v = false;  ///< texture coordinate v runs upwards in the file
        bool flip_normals = false;
        glm::dmat4 to_world{1.0};
        bool mirrored = false;  ///< to_world changes handedness
    };

    [[nodiscard]] Source read_source(Object& object);
    [[nodiscard]] std::uint32_t add_mesh(Object& object, const Source& source,
                                         const MitsubaSurface& surface);
    [[nodiscard]] Mesh read_mesh_file(Object& object, const Source& source);
    [[nodiscard]] Mesh make_mesh(Object& object, const Source& source);
    void fit_texture(Object& object, const MitsubaSurface& surface, Mesh& mesh);
    void add_boundary(Object& object, const Source& source, std::uint32_t mesh,
                      const MitsubaSurface& surface, MediumBoundary boundary);
    void count_triangles(Object& object, std::uint32_t mesh);

    Context& context_;
    MaterialReader& materials_;
    MediumReader& media_;
    Scene& scene_;
    std::map<std::string, std::uint32_t> shared_meshes_;
    std::size_t triangles_ = 0;
};

}  // namespace weft::mitsuba

#endif
