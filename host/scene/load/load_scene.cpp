// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/load/load_scene.h"

#include <algorithm>
#include <string>
#include <system_error>

#include "base/error.h"
#include "scene/gltf/gltf_reader.h"
#include "scene/mitsuba/mitsuba_reader.h"
#include "scene/obj/obj_reader.h"
#include "scene/ply/ply_scene.h"
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

}  // namespace

Scene load_scene(const std::filesystem::path& path, Diagnostics& diagnostics, DefaultLight light,
                 MaterialDetail detail) {
    Scene scene = read_scene(path, diagnostics, detail);
    validate_scene(scene);
    add_default_light(scene, light, diagnostics);
    return scene;
}

}  // namespace weft
