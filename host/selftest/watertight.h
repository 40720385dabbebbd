// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_WATERTIGHT_H
#define WEFT_SELFTEST_WATERTIGHT_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "selftest/bvh_meshes.h"
#include "selftest/ray_batch.h"
#include "selftest/scene_builder.h"

// Rays from inside of closed meshes, none of which may get out.
namespace weft::selftest {

// Largest distance of a hit from its triangle, in sizes of the mesh: a coordinate of a centred mesh
// is rounded by 2^-24 of it, and origin, shear and quotient each add about as much; where a ray
// hits a triangle at a small angle, the error along the ray is larger.
constexpr double hit_tolerance = 4e-6;

/// A closed mesh around the origin, of size about 2.
struct ClosedMesh {
    const char* name;
    Mesh mesh;
    double cube = 0.0;  // half the edge where the mesh is a cube, else 0
};

/// A sphere of latitudes and longitudes whose inner vertices are moved at random; vertices at poles
/// and seam are shared.
inline Mesh rough_sphere(std::uint32_t rings, std::uint32_t sectors, std::uint32_t seed) {
    Uniform uniform(seed);
    Mesh mesh;
    const auto add = [&](float theta, float phi) {
        const float r = 2.0F + uniform(-0.1F, 0.1F);
        mesh.positions.push_back(r * glm::vec3(std::sin(theta) * std::cos(phi),
                                               std::sin(theta) * std::sin(phi), std::cos(theta)));
        for (int k = 0; k < 3; ++k) mesh.positions.back()[k] += uniform(-0.05F, 0.05F);
        return static_cast<std::uint32_t>(mesh.positions.size() - 1);
    };
    const float pi = std::numbers::pi_v<float>;
    const std::uint32_t top = add(0.0F, 0.0F);
    for (std::uint32_t i = 1; i < rings; ++i)
        for (std::uint32_t j = 0; j < sectors; ++j)
            add(pi * static_cast<float>(i) / static_cast<float>(rings),
                2.0F * pi * static_cast<float>(j) / static_cast<float>(sectors));
    const std::uint32_t bottom = add(pi, 0.0F);
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return top + 1 + (i - 1) * sectors + j % sectors;
    };
    for (std::uint32_t j = 0; j < sectors; ++j) {
        mesh.triangles.push_back({top, at(1, j), at(1, j + 1)});
        mesh.triangles.push_back({bottom, at(rings - 1, j + 1), at(rings - 1, j)});
        for (std::uint32_t i = 1; i + 1 < rings; ++i) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

/// The cube [-2,2]^3 with n x n squares a face; all edges share their vertices.
inline Mesh shared_cube(std::uint32_t n) {
    Mesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> known;
    const int size = static_cast<int>(n);
    const auto vertex = [&](const std::array<int, 3>& p) {
        const auto [at, is_new] =
            known.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
        if (is_new)
            mesh.positions.push_back(glm::vec3(p[0], p[1], p[2]) * 4.0F / static_cast<float>(n) -
                                     2.0F);
        return at->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int side : {0, size})
            for (int i = 0; i < size; ++i)
                for (int j = 0; j < size; ++j) {
                    const auto at = [&](int di, int dj) {
                        std::array<int, 3> p{};
                        p[axis] = side;
                        p[(axis + 1) % 3] = i + di;
                        p[(axis + 2) % 3] = j + dj;
                        return vertex(p);
                    };
                    mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
                    mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
                }
    return mesh;
}

/// A ragged star: an icosphere whose vertices are moved along their radii.
inline Mesh ragged_blob(std::uint32_t level, std::uint32_t seed) {
    Uniform uniform(seed);
    Mesh mesh = icosphere(level, false);
    for (glm::vec3& p : mesh.positions) p *= uniform(1.0F, 2.0F);
    return mesh;
}

inline std::vector<ClosedMesh> closed_meshes() {
    Mesh sphere = icosphere(4, false);
    for (glm::vec3& p : sphere.positions) p *= 2.0F;
    std::vector<ClosedMesh> meshes;
    meshes.push_back({"sphere with moved vertices", rough_sphere(48, 64, 11)});
    meshes.push_back({"icosphere", std::move(sphere)});
    meshes.push_back({"cube", shared_cube(1), 2.0});
    meshes.push_back({"cube of 16 x 16 squares a face", shared_cube(16), 2.0});
    meshes.push_back({"ragged blob", ragged_blob(4, 13)});
    return meshes;
}

/// How a mesh is placed before rays are traced.
struct Placement {
    const char* name;
    double scale;
    glm::dvec3 move;
    bool units = true;  // flattened, which centres and scales; false: floats as they are
};

inline std::vector<Placement> placements() {
    const glm::dvec3 far(148376.0, 1234.0, -223423.0);
    return {{"in place", 1.0, glm::dvec3(0.0)},
            {"far away", 1.0, far},
            {"small", 1e-3, glm::dvec3(0.0)},
            {"large and far away", 1e3, far},
            {"far away and not centred", 1.0, far, false}};
}

/// A placed mesh with a ball inside of it.
struct Room {
    RayGeometry geometry;
    glm::dvec3 centre{0.0};
    double radius = 0.0;  // of the ball about the centre, which the mesh does not touch
    double scale = 1.0;   // of the mesh
};

/// Distance of a point from a triangle.
inline double distance_to(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c) {
    const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
    const double height = glm::dot(p - a, n);
    const glm::dvec3 foot = p - height * n;
    double nearest = INFINITY;
    bool inside = true;
    const std::array corners{a, b, c};
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 s = corners[k];
        const glm::dvec3 e = corners[(k + 1) % 3] - s;
        inside = inside && glm::dot(glm::cross(e, foot - s), n) >= 0.0;
        const double along = std::clamp(glm::dot(p - s, e) / glm::dot(e, e), 0.0, 1.0);
        nearest = std::min(nearest, glm::length(p - s - along * e));
    }
    return inside ? std::abs(height) : nearest;
}

inline Room place(const Mesh& mesh, const Placement& placement) {
    Room room;
    if (placement.units) {
        SceneBuilder builder;
        builder.add(mesh, builder.material(glm::vec3(0.5F)),
                    selftest::placement(placement.scale, placement.move));
        const FlatScene flat = flatten(builder.scene);
        room.geometry = geometry_of(flat);
        room.centre = flat.units.point(placement.move);
        room.scale = placement.scale * flat.units.scale;
    } else {
        for (const glm::vec3& p : mesh.positions) {
            const glm::vec3 q(placement.scale * glm::dvec3(p) + placement.move);
            room.geometry.positions.push_back({q.x, q.y, q.z, 0.0F});
        }
        for (const auto& [a, b, c] : mesh.triangles)
            room.geometry.triangles.push_back({a, b, c, 0});
        room.centre = placement.move;
        room.scale = placement.scale;
    }
    room.radius = INFINITY;
    for (std::uint32_t i = 0; i < room.geometry.triangles.size(); ++i)
        room.radius = std::min(room.radius,
                               distance_to(room.centre, room.geometry.corner(i, 0),
                                           room.geometry.corner(i, 1), room.geometry.corner(i, 2)));
    return room;
}

/// Rays from inside of a room, a fifth each: anywhere, at vertices, at points of edges, along an
/// axis, and from the height of a vertex in its plane. Directions have all lengths.
inline RayBatch rays_inside(const Room& room, std::size_t count, std::uint32_t seed) {
    Uniform uniform(seed);
    const auto index = [&](std::size_t n) {
        return std::min(n - 1,
                        static_cast<std::size_t>(uniform(0.0F, 1.0F) * static_cast<float>(n)));
    };
    const auto ball = [&] {
        for (;;) {
            const glm::dvec3 p(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            if (glm::dot(p, p) <= 1.0) return p;
        }
    };
    RayBatch rays;
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 origin(room.centre + 0.9 * room.radius * ball());
        const auto triangle = static_cast<std::uint32_t>(index(room.geometry.triangles.size()));
        const int k = static_cast<int>(index(3));
        const glm::vec3 a(room.geometry.corner(triangle, k));
        const glm::vec3 b(room.geometry.corner(triangle, (k + 1) % 3));
        glm::vec3 direction(0.0F);
        switch (i % 5) {
            case 0:
                direction = glm::vec3(ball());
                break;
            case 1:
                direction = a - origin;
                break;
            case 2:
                direction = a + uniform(0.0F, 1.0F) * (b - a) - origin;
                break;
            case 3:
                direction = i % 2 == 0 ? glm::vec3(0.0F) : glm::vec3(-0.0F);
                direction[k] = uniform(-1.0F, 1.0F);
                break;
            default:
                // The origin gets a coordinate of the vertex, where it stays inside then.
                if (std::abs(static_cast<double>(a[k]) - room.centre[k]) < 0.3 * room.radius)
                    origin[k] = a[k];
                direction = a - origin;
                break;
        }
        if (direction == glm::vec3(0.0F)) direction.z = 1.0F;
        rays.add(origin, direction * std::exp2(std::floor(uniform(-20.0F, 20.0F))));
    }
    return rays;
}

/// Wrong answers for rays from inside of rooms.
struct Leaks {
    std::size_t closest = 0;  // rays without a hit
    std::size_t any = 0;      // rays that are not blocked
    std::size_t apart = 0;    // hits that are off their triangle, or off the faces of a cube
    std::size_t rays = 0;
    double worst = 0.0;  // distance of a hit from its triangle, in extents of the mesh
};

/// Distance from inside of the cube of half edge `half` about `centre` to its faces, in units of
/// the direction's length.
inline double cube_exit(const glm::dvec3& origin, const glm::dvec3& direction,
                        const glm::dvec3& centre, double half) {
    double t = INFINITY;
    for (int k = 0; k < 3; ++k)
        if (direction[k] != 0.0)
            t = std::min(
                t, (centre[k] + std::copysign(half, direction[k]) - origin[k]) / direction[k]);
    return t;
}

inline void count_leaks(const ClosedMesh& mesh, const Room& room, const RayBatch& rays,
                        const std::vector<RayHit>& hits, const std::vector<int>& any,
                        Leaks& leaks) {
    const double size = 2.0 * room.scale;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ++leaks.rays;
        leaks.any += any[i] == 1 ? 0 : 1;
        if (hits[i].triangle >= room.geometry.triangles.size()) {
            ++leaks.closest;
            continue;
        }
        const glm::dvec3 o = rays.origin(i);
        const glm::dvec3 d = rays.direction(i);
        const double t = static_cast<double>(hits[i].t);
        const std::uint32_t id = hits[i].triangle;
        double error = distance_to(o + t * d, room.geometry.corner(id, 0),
                                   room.geometry.corner(id, 1), room.geometry.corner(id, 2)) /
                       size;
        if (mesh.cube > 0.0)
            error =
                std::max(error, std::abs(t - cube_exit(o, d, room.centre, mesh.cube * room.scale)) *
                                    glm::length(d) / size);
        leaks.worst = std::max(leaks.worst, error);
        leaks.apart += error <= hit_tolerance ? 0 : 1;
    }
}

/// Sends `count` rays, in batches, through one mesh at one place.
inline Leaks leaks_of(Executor& executor, const ClosedMesh& mesh, const Room& room,
                      std::size_t count, std::uint32_t seed, float padding = 0x1p-22F) {
    constexpr std::size_t batch = 100000;
    const RayQueries queries(executor, room.geometry, padding);
    Leaks leaks;
    for (std::size_t first = 0; first < count; first += batch) {
        const RayBatch rays = rays_inside(room, std::min(batch, count - first), seed++);
        count_leaks(mesh, room, rays, queries.closest(rays), queries.any(rays), leaks);
    }
    return leaks;
}

}  // namespace weft::selftest

#endif
