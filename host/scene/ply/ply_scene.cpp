// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_scene.h"

#include <utility>

#include "base/error.h"
#include "scene/mesh_edit.h"
#include "scene/ply/ply_reader.h"

namespace weft {

Scene read_ply_scene(const std::filesystem::path& path, Diagnostics& diagnostics) {
    Scene scene;
    scene.source = path.string();
    Mesh mesh = read_ply(path, "", diagnostics);
    if (mesh.triangles.empty())
        throw input_error(scene.source, "holds no faces that can be rendered, expected a mesh");
    orient_by_normals(mesh);
    Material material;
    material.name = "default";
    if (!mesh.colours.empty()) material.surface = DiffuseSurface{glm::vec3(1.0F)};
    Instance instance;
    instance.name = mesh.name;
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(std::move(material));
    scene.instances.push_back(std::move(instance));
    return scene;
}

}  // namespace weft
