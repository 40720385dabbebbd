// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/convex_media.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "scene/flat_scene.h"
#include "tests/testing/bvh_meshes.h"
#include "tests/testing/density_grid_reference.h"
#include "tests/testing/media_builder.h"

namespace weft::convex_media_test {
namespace {

using test::add_boundary;
using test::cube_mesh;
using test::placement;

Scene scene_of_media(std::size_t count) {
    Scene scene;
    for (std::size_t i = 0; i < count; ++i)
        scene.media.push_back(test::medium_of(glm::vec3(1.0F), glm::vec3(0.5F)));
    return scene;
}

/// The boundaries around a point, by their planes.
std::uint32_t inside_planes(const shared::MediaRecord& space, const glm::dvec3& p) {
    std::uint32_t around = 0;
    std::uint32_t i = 0;
    for (std::uint32_t k = 0; k < space.boundaries; ++k) {
        bool inside = true;
        for (; i < space.plane_end[k]; ++i) {
            const shared::float4& plane = space.planes[i];
            inside &= glm::dot(glm::dvec3(plane.x, plane.y, plane.z), p) <= double{plane.w};
        }
        if (inside) around |= 1U << k;
    }
    return around;
}

/// Expects planes that tell inside from outside as winding numbers do, in a cube of this size.
void expect_planes_of_boundaries(const Scene& scene, float size) {
    const FlatMedia media = flatten(scene).media;
    ASSERT_EQ(media.space.convex, 1U);
    test::Uniform uniform(5);
    std::size_t enclosed = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto value = [&] { return double{uniform(-size, size)}; };
        const glm::dvec3 p(value(), value(), value());
        const std::uint32_t around = inside_planes(media.space, p);
        EXPECT_EQ(around, boundaries_around(media, p));
        enclosed += around != 0 ? 1 : 0;
    }
    EXPECT_GT(enclosed, 100U);
    EXPECT_LT(enclosed, 3900U);
}

TEST(ConvexMedia, PlanesEncloseWhatMeshesEnclose) {
    Scene scene = scene_of_media(4);
    const glm::dmat4 turned =
        glm::rotate(placement(0.7, {0.2, -0.1, 0.1}), 0.8, glm::dvec3(1.0, 2.0, 3.0));
    add_boundary(scene, cube_mesh(), glm::scale(turned, glm::dvec3(1.0, -0.5, 2.0)), 0);
    expect_planes_of_boundaries(scene, 2.0F);
    add_boundary(scene, cube_mesh(), placement(0.1, {0.2, -0.1, 0.1}), 1);
    add_boundary(scene, test::icosphere(0, true), placement(0.4, {-1.4, -1.4, 1.4}), -1, 2);
    expect_planes_of_boundaries(scene, 2.0F);
}

TEST(ConvexMedia, KnowsWhichBoundaryIsAroundWhich) {
    Scene scene = scene_of_media(4);
    add_boundary(scene, cube_mesh(), placement(1.0, {0, 0, 0}), 0);
    add_boundary(scene, cube_mesh(), placement(0.5, {0, 0, 0}), 1);
    add_boundary(scene, cube_mesh(), placement(0.25, {0.25, 0, 0}), 2);    // shares a face
    add_boundary(scene, cube_mesh(), placement(0.125, {1.125, 0, 0}), 3);  // and from outside
    const shared::MediaRecord& space = flatten(scene).media.space;
    ASSERT_EQ(space.convex, 1U);
    EXPECT_EQ(space.around[0], NO_MEDIUM);
    EXPECT_EQ(space.around[1], 2U);
    EXPECT_EQ(space.around[2], 3U);
    EXPECT_EQ(space.around[3], NO_MEDIUM);
    for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(space.plane_end[k], 6 * (k + 1));
}

TEST(ConvexMedia, OppositeFacesFollowEachOther) {
    Scene scene = scene_of_media(1);
    add_boundary(scene, cube_mesh(),
                 glm::rotate(placement(0.7, {5.0, -0.1, 0.1}), 0.8, glm::dvec3(1.0, 2.0, 3.0)), 0);
    const shared::MediaRecord& space = flatten(scene).media.space;
    ASSERT_EQ(space.plane_end[0], 6U);
    for (std::uint32_t i = 0; i < 6; i += 2) {
        EXPECT_EQ(space.planes[i].x, -space.planes[i + 1].x);
        EXPECT_EQ(space.planes[i].y, -space.planes[i + 1].y);
        EXPECT_EQ(space.planes[i].z, -space.planes[i + 1].z);
    }
}

TEST(ConvexMedia, SpaceWithoutBoundariesIsConvex) {
    Scene scene = scene_of_media(1);
    scene.outer_medium = 0;
    EXPECT_EQ(flatten(scene).media.space.convex, 1U);
    test::add_grid(scene, 0, make_random_grid({2, 2, 2}, 1));
    EXPECT_EQ(flatten(scene).media.space.convex, 0U);
}

std::uint32_t is_convex(Mesh mesh) {
    Scene scene = scene_of_media(1);
    add_boundary(scene, std::move(mesh), glm::dmat4(1.0), 0);
    return flatten(scene).media.space.convex;
}

TEST(ConvexMedia, WalksWhereOneBoundaryIsNotConvex) {
    EXPECT_EQ(is_convex(cube_mesh()), 1U);
    EXPECT_EQ(is_convex(test::icosphere(0, false)), 1U);
    EXPECT_EQ(is_convex(test::icosphere(2, false)), 0U) << "too many planes";
    Mesh open = cube_mesh();
    open.triangles.pop_back();
    EXPECT_EQ(is_convex(open), 0U);
    Mesh dented = cube_mesh();
    const auto centre = static_cast<std::uint32_t>(dented.positions.size());
    const auto [a, b, c] = dented.triangles.back();
    dented.triangles.pop_back();
    dented.positions.emplace_back(0.0F, 0.0F, 0.0F);
    dented.triangles.push_back({a, b, centre});
    dented.triangles.push_back({b, c, centre});
    dented.triangles.push_back({c, a, centre});
    EXPECT_EQ(is_convex(dented), 0U);
    Mesh two = cube_mesh();
    const Mesh other = cube_mesh();
    for (const auto& t : other.triangles)
        two.triangles.push_back({t[0] + static_cast<std::uint32_t>(two.positions.size()),
                                 t[1] + static_cast<std::uint32_t>(two.positions.size()),
                                 t[2] + static_cast<std::uint32_t>(two.positions.size())});
    for (const glm::vec3& p : other.positions) two.positions.push_back(p + glm::vec3(3.0F));
    EXPECT_EQ(is_convex(two), 0U) << "two pieces";
}

TEST(ConvexMedia, WalksWhereBoundariesCutEachOther) {
    Scene scene = scene_of_media(2);
    add_boundary(scene, cube_mesh(), placement(1.0, {0, 0, 0}), 0);
    add_boundary(scene, cube_mesh(), placement(0.5, {0.8, 0, 0}), 1);
    EXPECT_EQ(flatten(scene).media.space.convex, 0U);
    scene.medium_boundaries.back().to_world = placement(0.5, {1.5, 0, 0});
    EXPECT_EQ(flatten(scene).media.space.convex, 1U);
}

TEST(ConvexMedia, WalksWhereAGridLiesAroundABoundary) {
    for (const std::size_t gridded : {0U, 1U}) {
        Scene scene = scene_of_media(2);
        add_boundary(scene, cube_mesh(), placement(1.0, {0, 0, 0}), 0);
        add_boundary(scene, cube_mesh(), placement(0.5, {0, 0, 0}), 1);
        test::add_grid(scene, gridded, make_random_grid({2, 2, 2}, 1));
        EXPECT_EQ(flatten(scene).media.space.convex, gridded);
    }
}

TEST(ConvexMedia, ManyBoundariesAreWalked) {
    Scene scene = scene_of_media(1);
    for (std::uint32_t k = 0; k <= CONVEX_BOUNDARIES; ++k) {
        EXPECT_EQ(k > 0 && flatten(scene).media.space.convex == 0U, false);
        add_boundary(scene, cube_mesh(), placement(0.4, {k, 0, 0}), 0);
    }
    EXPECT_EQ(flatten(scene).media.space.convex, 0U);
}

}  // namespace
}  // namespace weft::convex_media_test
