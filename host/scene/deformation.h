// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_DEFORMATION_H
#define WEFT_SCENE_DEFORMATION_H

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "scene/animation.h"

namespace weft {

struct Mesh;

/// Displacements by a morph target of the vertices of a mesh at a weight of 1, in object space.
struct MorphTarget {
    std::vector<glm::vec3> positions;  ///< one a vertex; empty: none
    std::vector<glm::vec3> normals;    ///< likewise
};

/// Which joints of a skin carry the vertices of a mesh, and with what weights.
struct JointInfluences {
    std::uint32_t width = 0;            ///< joints of a vertex; 0: no joint carries the mesh
    std::vector<std::uint16_t> joints;  ///< `width` a vertex
    std::vector<float> weights;         ///< likewise, not negative, with a sum of 1 up to rounding
};

/// The undeformed vertices of a mesh. Triangles and all other attributes stay those of the mesh.
struct MeshShape {
    std::vector<glm::vec3> positions;  ///< object space
    std::vector<glm::vec3> normals;    ///< one a vertex, or empty
    std::vector<glm::vec4> tangents;   ///< likewise; see Mesh::tangents
    std::vector<MorphTarget> targets;
    JointInfluences influences;
};

/// The joints that carry the vertices of meshes.
struct Skin {
    Attachment frame;  ///< the space of carried vertices, in which the skeleton stands
    std::vector<Attachment> joints;
    std::vector<glm::dmat4> inverse_bind;  ///< by joint: from a shape's space to the joint's
};

/// How a mesh of a scene changes its form over time.
struct Deformation {
    std::uint32_t mesh = 0;                  ///< index into Scene::meshes: the deformed mesh
    std::shared_ptr<const MeshShape> shape;  ///< the undeformed one; copies of a scene share it
    int skin = -1;                           ///< index into Scene::skins, or -1
    int weights_track = -1;                  ///< index into Animation::tracks, or -1
    std::vector<double> weights;             ///< of the targets, where there is no track
};

/// The matrices by which the joints of a skin carry vertices: from a shape's space to that of the
/// frame. `nodes_to_world` as nodes_to_world_at makes them. Not finite where the frame is singular.
[[nodiscard]] std::vector<glm::dmat4> joint_matrices(const Skin& skin,
                                                     std::span<const glm::dmat4> nodes_to_world);

/// Sets positions, normals and tangents of `mesh`, as many as the shape has, to the deformed ones
/// of `shape`: its targets are added with `weights`, one each, and joints carry the result with the
/// weighted mean of their matrices (`joints`, one for each that the shape refers to; without
/// influences, none is needed). Normals stay perpendicular to the surface, tangents along it; they
/// have unit length, or are 0 where they have no direction. Targets do not turn tangents, which
/// kernels make perpendicular to normals. Returns whether most vertices are mirrored: then faces
/// and normals point inwards.
bool deform(const MeshShape& shape, std::span<const double> weights,
            std::span<const glm::dmat4> joints, Mesh& mesh);

}  // namespace weft

#endif
