// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/bench_scenes.h"

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/load/load_scene.h"
#include "scene/shapes.h"

namespace weft::bench {
namespace {

void add(Scene& scene, std::uint32_t mesh, std::uint32_t material, const glm::dmat4& to_world) {
    Instance instance;
    instance.mesh = mesh;
    instance.material = material;
    instance.to_world = to_world;
    scene.instances.push_back(instance);
}

glm::dmat4 placed(const glm::dvec3& position, const glm::dvec3& size, double turn = 0.0) {
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), position);
    return glm::scale(glm::rotate(moved, turn, glm::dvec3(0, 1, 0)), size);
}

/// The room [-1,1]^3 with a light under its ceiling; mesh 0 is a cube.
Scene lit_room() {
    Scene scene;
    Material wall;
    wall.surface = DiffuseSurface{glm::vec3(0.7F)};
    Material light;
    light.surface = DiffuseSurface{glm::vec3(0.0F)};
    light.emission.radiance = glm::vec3(10.0F);
    scene.materials = {wall, light};
    scene.meshes = {make_cube(), make_rectangle()};
    add(scene, 0, 0, glm::dmat4(1.0));
    // The rectangle's +z turned to point down.
    const glm::dmat4 down =
        glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(1.0, 0.0, 0.0));
    add(scene, 1, 1, placed({0.0, 0.99, 0.0}, glm::dvec3(0.3)) * down);
    Camera camera;
    camera.to_world = glm::inverse(
        glm::lookAt(glm::dvec3(0.1, 0.2, 0.95), glm::dvec3(0.0, -0.4, 0.0), glm::dvec3(0, 1, 0)));
    camera.fov = glm::radians(75.0);
    scene.cameras = {camera};
    return scene;
}

/// Value noise: smooth between hashed values on the integer grid.
double noise(double x, double z) {
    const auto corner = [](double i, double k) {
        auto h = static_cast<std::uint32_t>(static_cast<std::int64_t>(i) * 374761393 +
                                            static_cast<std::int64_t>(k) * 668265263);
        h = (h ^ (h >> 13)) * 1274126177U;
        return static_cast<double>((h ^ (h >> 16)) & 0xFFFFU) / 65535.0;
    };
    const double i = std::floor(x);
    const double k = std::floor(z);
    const double u = glm::smoothstep(0.0, 1.0, x - i);
    const double v = glm::smoothstep(0.0, 1.0, z - k);
    return glm::mix(glm::mix(corner(i, k), corner(i + 1, k), u),
                    glm::mix(corner(i, k + 1), corner(i + 1, k + 1), u), v);
}

/// Height over [-1,1]^2, about -0.9 to -0.1; rough down to small scales.
double height(double x, double z) {
    double sum = 0.0;
    double amplitude = 0.4;
    double frequency = 3.0;
    for (int octave = 0; octave < 7; ++octave) {
        sum += amplitude * noise(x * frequency + 17.0 * octave, z * frequency - 31.0 * octave);
        amplitude *= 0.5;
        frequency *= 2.1;
    }
    return sum - 0.9;
}

Mesh terrain(std::uint32_t edge) {
    Mesh mesh;
    const std::uint32_t row = edge + 1;
    for (std::uint32_t k = 0; k < row; ++k)
        for (std::uint32_t i = 0; i < row; ++i) {
            const double x = 2.0 * i / edge - 1.0;
            const double z = 2.0 * k / edge - 1.0;
            mesh.positions.emplace_back(x, height(x, z), z);
        }
    for (std::uint32_t k = 0; k < edge; ++k)
        for (std::uint32_t i = 0; i < edge; ++i) {
            const std::uint32_t a = k * row + i;
            mesh.triangles.push_back({a, a + row, a + 1});
            mesh.triangles.push_back({a + 1, a + row, a + row + 1});
        }
    return mesh;
}

constexpr std::string_view fog_suffix = "-fog";

/// DIR/NAME/NAME.xml; NAME-fog is beside NAME.
std::filesystem::path scene_file(const std::filesystem::path& folder, const std::string& name) {
    std::filesystem::path file = folder / name / (name + ".xml");
    if (!std::filesystem::is_regular_file(file) && name.ends_with(fog_suffix))
        file = folder / name.substr(0, name.size() - fog_suffix.size()) / (name + ".xml");
    return file;
}

}  // namespace

Scene box_scene() {
    Scene scene = lit_room();
    for (int i = 0; i < 6; ++i) {
        const double angle = 1.1 * i;
        const double size = 0.1 + 0.03 * i;
        add(scene, 0, 0,
            placed({0.6 * std::cos(angle), size - 1.0, 0.6 * std::sin(angle)}, glm::dvec3(size),
                   0.4 * i));
    }
    return scene;
}

Scene terrain_scene(std::uint32_t edge) {
    Scene scene = lit_room();
    scene.meshes.push_back(terrain(edge));
    add(scene, 2, 0, glm::dmat4(1.0));
    return scene;
}

std::vector<BenchScene> bench_scenes(const std::filesystem::path& folder,
                                     const std::vector<std::string>& names, bool quick) {
    std::vector<BenchScene> scenes;
    for (const std::string& name : names) {
        const std::filesystem::path file = scene_file(folder, name);
        if (!std::filesystem::is_regular_file(file)) continue;
        scenes.push_back(
            {name, [file](Diagnostics& diagnostics) { return load_scene(file, diagnostics); },
             file});
    }
    scenes.push_back({"box", [](Diagnostics&) { return box_scene(); }, {}});
    scenes.push_back({"terrain-300k", [](Diagnostics&) { return terrain_scene(387); }, {}});
    if (!quick)
        scenes.push_back({"terrain-5m", [](Diagnostics&) { return terrain_scene(1581); }, {}});
    return scenes;
}

}  // namespace weft::bench
