// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/hard_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bvh/wide_bvh.h"
#include "selftest/scene_builder.h"

namespace weft::selftest {
namespace {

/// Adds rays from around the unit cube; every second one ends at a random distance.
void add_random(RayBatch& rays, std::size_t count, std::uint32_t seed) {
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        const glm::vec3 target = random_point(uniform, 0.0F, 1.0F);
        const float length = std::exp2(std::floor(uniform(-10.0F, 10.0F)));
        rays.add(origin, (target - origin) * length,
                 i % 2 == 0 ? ray_infinity : uniform(0.0F, 2.0F) / length);
    }
}

/// Adds rays along axes: the other components of the direction are zero, negative zero or denormal,
/// and the origin is level with vertices.
void add_axis_aligned(RayBatch& rays, const RayGeometry& geometry, std::size_t count,
                      std::uint32_t seed) {
    // In the plane of a triangle only -0 and 0 are exact: there slopes must not be so small that
    // the products of edge functions underflow.
    constexpr std::array small{
        0.0F,    -0.0F,  1e-19F,  -1e-30F, std::numeric_limits<float>::denorm_min(),
        -1e-45F, 1e-40F, -1e-39F, 2e-38F};
    constexpr std::size_t above_underflow = 4;
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        glm::vec3 direction(0.0F);
        const int axis = static_cast<int>(i % 3);
        for (int k = 0; k < 3; ++k) {
            direction[k] =
                small.at(random_index(uniform, i % 4 == 0 ? above_underflow : small.size()));
            const shared::float4& p =
                geometry.positions[random_index(uniform, geometry.positions.size())];
            if (i % 4 == 0) origin[k] = k == 0 ? p.x : (k == 1 ? p.y : p.z);
        }
        origin[axis] = i % 2 == 0 ? -0.5F : 1.5F;
        direction[axis] = i % 2 == 0 ? 1.0F : -1.0F;
        rays.add(origin, direction);
    }
}

/// Adds rays from planes and corners of the boxes of the tree, and rays through their corners.
void add_box_rays(RayBatch& rays, const RayGeometry& geometry, std::size_t count,
                  std::uint32_t seed) {
    BvhSettings settings;
    settings.padding = geometry.extent() * 0x1p-22F;
    const WideBvh bvh = build_bvh(geometry.positions, geometry.triangles, settings);
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count;) {
        const shared::BvhNode& node = bvh.nodes[random_index(uniform, bvh.nodes.size())];
        const std::size_t child = random_index(uniform, 8);
        if (node.child[child] == BVH_EMPTY) continue;
        glm::vec3 corner(0.0F);
        for (int k = 0; k < 3; ++k)
            corner[k] = node.bounds[2 * k + (uniform(0.0F, 1.0F) < 0.5F ? 0 : 1)][child];
        glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        glm::vec3 direction = random_point(uniform, -1.0F, 1.0F);
        const int axis = static_cast<int>(random_index(uniform, 3));
        switch (i % 4) {
            case 0:  // through a corner
                direction = corner - origin;
                break;
            case 1:  // from a corner
                origin = corner;
                break;
            case 2:  // from a plane
                origin[axis] = corner[axis];
                break;
            default:  // in a plane
                origin[axis] = corner[axis];
                direction[axis] = i % 8 == 3 ? 0.0F : -0.0F;
                break;
        }
        rays.add(origin, direction);
        ++i;
    }
}

}  // namespace

RayBatch all_rays(const RayGeometry& geometry, std::size_t count, std::uint32_t seed) {
    RayBatch rays;
    add_random(rays, count, seed);
    add_axis_aligned(rays, geometry, count, seed + 1);
    add_box_rays(rays, geometry, count, seed + 2);
    return rays;
}

BvhMesh thin_needles() {
    // Needles lie beside coordinate 0, the only place where floats are fine enough.
    BvhMesh mesh = random_soup(100, 0.2F, 5);
    Uniform uniform(6);
    for (std::size_t i = 0; i < 300; ++i) {
        std::array<std::array<float, 3>, 3> v{};
        const std::size_t thin = i % 3;
        const std::size_t across = (i + 1) % 3;
        const std::size_t along = (i + 2) % 3;
        const float y = uniform(0.0F, 1.0F);
        const float x = uniform(0.0F, 1.0F);
        for (std::size_t k = 0; k < 3; ++k) v[k][across] = y;
        v[0][along] = x;
        v[1][along] = x + uniform(0.1F, 0.5F);
        v[2][along] = x + 0.1F;
        v[2][thin] = 1e-20F;
        mesh.add(v[0], v[1], v[2]);
    }
    return mesh;
}

void add_rays_in_planes(RayBatch& rays, std::size_t count, std::uint32_t seed) {
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        glm::vec3 direction = random_point(uniform, -1.0F, 1.0F);
        origin[static_cast<int>(i % 3)] = i % 2 == 0 ? 0.0F : 5e-21F;
        direction[static_cast<int>(i % 3)] = 0.0F;
        rays.add(origin, direction);
    }
}

RayGeometry huge_and_tiny(float size) {
    Mesh mesh;
    Uniform uniform(7);
    const auto add = [&](const glm::vec3& middle, float reach) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(middle + random_point(uniform, -reach, reach));
        mesh.triangles.push_back({first, first + 1, first + 2});
    };
    for (int i = 0; i < 200; ++i) add(random_point(uniform, -3.0F * size, 3.0F * size), size);
    for (int i = 0; i < 50; ++i) add(random_point(uniform, -5e8F, 5e8F), 4e8F);
    // Two far corners make the scene's centre that of the tiny triangles.
    for (const float end : {-1e9F, 1e9F}) {
        add(glm::vec3(0.5F * end), 1e7F);
        mesh.positions.back() = glm::vec3(end);
    }
    SceneBuilder builder;
    builder.add(mesh, builder.material(glm::vec3(0.5F)));
    return geometry_of(flatten(builder.scene));
}

RayBatch rays_huge_and_tiny(float size) {
    Uniform uniform(8);
    const float tiny = std::ldexp(size, -29);  // 10^9 becomes 2^0 and a bit
    RayBatch rays;
    for (std::size_t i = 0; i < 6000; ++i) {
        const bool near = i % 3 != 0;
        const glm::vec3 origin = random_point(uniform, -1.0F, 1.0F) * (near ? 6.0F * tiny : 1.0F);
        const glm::vec3 target = random_point(uniform, -1.0F, 1.0F) * (near ? 3.0F * tiny : 1.0F);
        rays.add(origin, i % 2 == 0 ? glm::normalize(target - origin) : target - origin);
    }
    return rays;
}

BvhMesh triangles_without_area() {
    // Corners on a grid of 1/256, so that points in a line are so exactly; one triangle with area
    // keeps the tree from being empty.
    BvhMesh mesh;
    Uniform uniform(9);
    mesh.add({0.0F, 0.0F, 0.0F}, {0.01F, 0.0F, 0.0F}, {0.0F, 0.01F, 0.0F});
    const auto grid = [&](float range) {
        return std::round(uniform(0.0F, range) * 256.0F) / 256.0F;
    };
    for (int i = 0; i < 300; ++i) {
        const std::array a{grid(0.5F), grid(0.5F), grid(0.5F)};
        std::array b = a;
        std::array c = a;
        for (std::size_t k = 0; k < 3 && i % 3 != 0; ++k) {
            const float step = grid(0.2F);
            b[k] += i % 3 == 1 ? step : 2.0F * step;  // a line, its middle included
            c[k] += i % 3 == 1 ? 0.0F : step;         // or two corners in one place
        }
        mesh.add(a, b, c);
    }
    return mesh;
}

void add_rays_at_flat_triangles(RayBatch& rays, const RayGeometry& geometry, std::size_t count,
                                std::uint32_t seed) {
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const auto id = static_cast<std::uint32_t>(1 + i % (geometry.triangles.size() - 1));
        const glm::vec3 a(geometry.corner(id, 0));
        const glm::vec3 b(geometry.corner(id, 1));
        const glm::vec3 target = a + std::round(uniform(0.0F, 4.0F)) * 0.25F * (b - a);
        const glm::vec3 origin = random_point(uniform, -0.5F, 1.5F);
        rays.add(origin, target - origin);
    }
}

}  // namespace weft::selftest
