// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_SCENE_BUILDER_H
#define WEFT_SELFTEST_SCENE_BUILDER_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "scene/scene.h"

namespace weft::selftest {

/// A camera at `from` that looks at `at`; `fov` in radians, vertical.
inline Camera look_at(const glm::dvec3& from, const glm::dvec3& at, double fov) {
    const glm::dvec3 backward = glm::normalize(from - at);
    const glm::dvec3 helper =
        std::abs(backward.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
    const glm::dvec3 right = glm::normalize(glm::cross(helper, backward));
    Camera camera;
    camera.fov = fov;
    camera.to_world =
        glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(backward, right), 0.0),
                   glm::dvec4(backward, 0.0), glm::dvec4(from, 1.0));
    return camera;
}

/// Uniform scaling by `scale`, then a move.
inline glm::dmat4 placement(double scale, const glm::dvec3& move) {
    glm::dmat4 matrix(scale);
    matrix[3] = glm::dvec4(move, 1.0);
    return matrix;
}

/// The parallelogram corner + [0,1] u + [0,1] v with normal u x v, in n x n cells; uv 0..1.
inline Mesh quad_mesh(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v,
                      std::uint32_t n = 1) {
    Mesh mesh;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const float s = static_cast<float>(i) / static_cast<float>(n);
            const float t = static_cast<float>(j) / static_cast<float>(n);
            mesh.positions.push_back(corner + s * u + t * v);
            mesh.uvs.emplace_back(s, t);
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            mesh.triangles.push_back({a, a + 1, a + n + 2});
            mesh.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    return mesh;
}

/// The unit sphere as an icosahedron whose faces are quartered `level` times: 20 4^level triangles,
/// all vertices on the sphere, normals outwards or, for light inside, `inwards`.
inline Mesh icosphere(std::uint32_t level, bool inwards) {
    const double golden = 0.5 * (1.0 + std::sqrt(5.0));
    Mesh mesh;
    const auto add = [&](const glm::dvec3& p) {
        mesh.positions.emplace_back(glm::normalize(p));
        return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    };
    for (const double s : {-1.0, 1.0})
        for (const double t : {-golden, golden}) {
            add({0.0, s, t});
            add({s, t, 0.0});
            add({t, 0.0, s});
        }
    // The faces are the triples of vertices at the distance of an edge, 2 before normalising.
    const auto near = [&](std::uint32_t a, std::uint32_t b) {
        return glm::dot(mesh.positions[a], mesh.positions[b]) > 0.4F;
    };
    for (std::uint32_t a = 0; a < 12; ++a)
        for (std::uint32_t b = a + 1; b < 12; ++b)
            for (std::uint32_t c = b + 1; c < 12; ++c) {
                if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
                const glm::vec3 n = glm::cross(mesh.positions[b] - mesh.positions[a],
                                               mesh.positions[c] - mesh.positions[a]);
                const bool outwards = glm::dot(n, mesh.positions[a]) > 0.0F;
                mesh.triangles.push_back(outwards != inwards ? std::array{a, b, c}
                                                             : std::array{a, c, b});
            }
    for (std::uint32_t l = 0; l < level; ++l) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), 0U);
            if (is_new)
                at->second = add(glm::dvec3(mesh.positions[a]) + glm::dvec3(mesh.positions[b]));
            return at->second;
        };
        auto coarse = std::exchange(mesh.triangles, {});
        for (const auto& [a, b, c] : coarse) {
            const std::uint32_t ab = middle(a, b);
            const std::uint32_t bc = middle(b, c);
            const std::uint32_t ca = middle(c, a);
            mesh.triangles.push_back({a, ab, ca});
            mesh.triangles.push_back({ab, b, bc});
            mesh.triangles.push_back({ca, bc, c});
            mesh.triangles.push_back({ab, bc, ca});
        }
    }
    return mesh;
}

/// The cube [-1,1]^3 as a room: six faces with normals inwards, uv 0..1 on each.
inline Mesh room_mesh() {
    Mesh room;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0F, 1.0F}) {
            glm::vec3 corner(-1.0F);
            glm::vec3 u(0.0F);
            glm::vec3 v(0.0F);
            corner[axis] = side;
            u[(axis + (side < 0.0F ? 1 : 2)) % 3] = 2.0F;
            v[(axis + (side < 0.0F ? 2 : 1)) % 3] = 2.0F;
            const Mesh face = quad_mesh(corner, u, v);
            const auto base = static_cast<std::uint32_t>(room.positions.size());
            room.positions.insert(room.positions.end(), face.positions.begin(),
                                  face.positions.end());
            room.uvs.insert(room.uvs.end(), face.uvs.begin(), face.uvs.end());
            for (const auto& [a, b, c] : face.triangles)
                room.triangles.push_back({base + a, base + b, base + c});
        }
    return room;
}

/// Builds a scene; every mesh has its own instance.
class SceneBuilder {
  public:
    Scene scene;

    SceneBuilder() { scene.source = "test scene"; }

    /// Adds a material; returns its index.
    std::uint32_t material(const glm::vec3& albedo, const glm::vec3& emission = glm::vec3(0.0F)) {
        Material made;
        made.surface = DiffuseSurface{albedo};
        made.emission.radiance = emission;
        scene.materials.push_back(made);
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }

    /// Adds the mesh once, with that material and transform.
    void add(Mesh mesh, std::uint32_t material, const glm::dmat4& to_world = glm::dmat4(1.0)) {
        scene.meshes.push_back(std::move(mesh));
        Instance instance;
        instance.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
        instance.material = material;
        instance.to_world = to_world;
        scene.instances.push_back(instance);
    }

    /// Adds a light without area; the light of spots and directional lights travels along
    /// `direction`.
    PunctualLight& light(LightType type, const glm::dvec3& position, const glm::vec3& intensity,
                         const glm::dvec3& direction = {0.0, 0.0, -1.0}) {
        PunctualLight made;
        made.type = type;
        made.position = position;
        made.direction = glm::normalize(direction);
        made.intensity = intensity;
        scene.lights.push_back(made);
        return scene.lights.back();
    }
};

}  // namespace weft::selftest

#endif
