// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/load/load_scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>

#include "base/error.h"
#include "scene/gltf/gltf_reader.h"
#include "scene/mesh_tangents.h"
#include "scene/mitsuba/mitsuba_reader.h"
#include "scene/obj/obj_reader.h"
#include "scene/ply/ply_scene.h"
#include "scene/texture/environment_file.h"
#include "scene/validate_scene.h"

namespace weft {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return extension;
}

Scene read_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                 MaterialDetail detail) {
    const std::string extension = lower_extension(path);
    if (extension == ".gltf" || extension == ".glb") return read_gltf(path, diagnostics, detail);
    if (extension == ".xml") return read_mitsuba(path, diagnostics, detail);
    if (extension == ".obj") return read_obj(path, diagnostics, detail);
    if (extension == ".ply") return read_ply_scene(path, diagnostics);
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        throw input_error(path.string(), "is a folder, expected a scene file");
    throw input_error(path.string(),
                      "is not a known kind of scene file, expected glTF 2.0 (.gltf, .glb), "
                      "Mitsuba 3 (.xml), OBJ (.obj) or PLY (.ply)");
}

/// The rotation by `degrees` about +y, counter-clockwise seen from above.
glm::dmat3 turn_about_y(double degrees) {
    const double angle = glm::radians(std::fmod(degrees, 360.0));
    const double sine = std::sin(angle);
    const double cosine = std::cos(angle);
    return {{cosine, 0.0, -sine}, {0.0, 1.0, 0.0}, {sine, 0.0, cosine}};
}

void set_environment(const SceneReading& reading, Scene& scene, Diagnostics& diagnostics) {
    if (!reading.environment.empty()) {
        const EnvironmentFile file = read_environment(reading.environment);
        if (file.mended > 0)
            diagnostics.warn(reading.environment.string(),
                             std::to_string(file.mended) + " " + std::string(mended_values));
        scene.environment = Environment{glm::vec3(1.0F), file.image};
    }
    if (reading.environment_rotation == 0.0) return;
    if (scene.environment && scene.environment->image)
        scene.environment->to_world =
            turn_about_y(reading.environment_rotation) * scene.environment->to_world;
    else
        diagnostics.warn(scene.source, "no image of the environment that could be turned");
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                 const SceneReading& reading) {
    Scene scene = read_scene(path, diagnostics, reading.materials);
    scene.detail = reading.materials;
    set_environment(reading, scene, diagnostics);
    add_missing_tangents(scene);
    validate_scene(scene);
    add_default_light(scene, reading.light, diagnostics);
    return scene;
}

}  // namespace weft
