// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "bvh/flatten.h"
#include "bvh/wide_bvh.h"
#include "tests/testing/bvh_meshes.h"

// A plain traversal in double precision against testing every triangle.
namespace weft::bvh_traversal_test {
namespace {

using test::BvhMesh;

struct Ray {
    Point origin, direction;
};

struct Hit {
    double t = INFINITY;
    std::size_t triangles = 0;  // at that distance
};

Point minus(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point point(const shared::float4& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

void intersect(const Ray& ray, const Corners& corners, Hit& hit) {
    const Point a = point(corners[0]);
    const Point u = minus(point(corners[1]), a);
    const Point v = minus(point(corners[2]), a);
    const Point p = cross(ray.direction, v);
    const double determinant = dot(u, p);
    if (determinant == 0.0) return;
    const Point s = minus(ray.origin, a);
    const double x = dot(s, p) / determinant;
    const Point q = cross(s, u);
    const double y = dot(ray.direction, q) / determinant;
    const double t = dot(v, q) / determinant;
    if (x < 0.0 || y < 0.0 || x + y > 1.0 || t < 0.0 || t > hit.t) return;
    hit.triangles = t < hit.t ? 1 : hit.triangles + 1;
    hit.t = t;
}

bool crosses(const Ray& ray, const Box& box, double limit) {
    const double largest = std::max(
        {std::abs(ray.direction[0]), std::abs(ray.direction[1]), std::abs(ray.direction[2])});
    double enter = 0.0;
    double leave = limit;
    for (std::size_t a = 0; a < 3; ++a) {
        const double least = std::copysign(1e-18 * largest, ray.direction[a]);
        const double d = std::abs(ray.direction[a]) < 1e-18 * largest ? least : ray.direction[a];
        // Ordered by sign, not by min and max, or empty children would look like the whole space.
        const double near = d < 0.0 ? double{box.upper[a]} : double{box.lower[a]};
        const double far = d < 0.0 ? double{box.lower[a]} : double{box.upper[a]};
        enter = std::max(enter, (near - ray.origin[a]) / d);
        leave = std::min(leave, (far - ray.origin[a]) / d);
    }
    return enter <= leave * (1.0 + 1e-12);
}

Hit traverse(const WideBvh& bvh, const Ray& ray) {
    Hit hit;
    std::vector<std::uint32_t> seen;
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
        const std::uint32_t reference = stack.back();
        stack.pop_back();
        if (is_leaf(reference)) {
            for (std::uint32_t i = 0; i < leaf_count(reference); ++i) {
                const LeafTriangle triangle = leaf_triangle(bvh.leaves, reference, i);
                // A triangle that was split counts once.
                if (std::find(seen.begin(), seen.end(), triangle.id) != seen.end()) continue;
                seen.push_back(triangle.id);
                intersect(ray, triangle.corners, hit);
            }
            continue;
        }
        const shared::BvhNode& node = bvh.nodes[reference];
        for (std::size_t slot = 0; slot < node_width; ++slot)
            if (crosses(ray, child_box(node, slot), hit.t)) stack.push_back(node.child[slot]);
        EXPECT_LE(stack.size(), bvh.stack_need);
    }
    return hit;
}

Hit test_all(const BvhMesh& mesh, const Ray& ray) {
    Hit hit;
    for (const shared::Triangle& t : mesh.triangles)
        intersect(ray, {mesh.positions[t.v0], mesh.positions[t.v1], mesh.positions[t.v2]}, hit);
    return hit;
}

std::vector<Ray> random_rays(std::size_t count, std::uint32_t seed) {
    test::Uniform uniform(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        for (std::size_t k = 0; k < 3; ++k) {
            ray.origin[k] = uniform(-0.5F, 1.5F);
            ray.direction[k] = uniform(-1.0F, 1.0F);
        }
    }
    return rays;
}

// Along each axis both ways, with zeros of both signs, through the points of a 1/16 grid.
std::vector<Ray> axis_rays() {
    std::vector<Ray> rays;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int i = -1; i <= 17; ++i) {
            for (int j = -1; j <= 17; ++j) {
                const double sign = (i + j) % 2 == 0 ? 1.0 : -1.0;
                Ray ray{{i / 16.0, i / 16.0, i / 16.0}, {0.0 * sign, -0.0, 0.0}};
                ray.origin[(axis + 1) % 3] = j / 16.0;
                ray.origin[axis] = 0.5 - 3.0 * sign;
                ray.direction[axis] = sign;
                rays.push_back(ray);
            }
        }
    }
    return rays;
}

void compare(const BvhMesh& mesh, const BvhSettings& settings, std::size_t random_count) {
    const WideBvh bvh = build_bvh(mesh.positions, mesh.triangles, settings);
    std::vector<Ray> rays = random_rays(random_count, 5);
    const std::vector<Ray> more = axis_rays();
    rays.insert(rays.end(), more.begin(), more.end());
    std::size_t hits = 0;
    std::size_t different = 0;
    for (const Ray& ray : rays) {
        const Hit expected = test_all(mesh, ray);
        const Hit found = traverse(bvh, ray);
        hits += expected.triangles > 0 ? 1 : 0;
        different += expected.t != found.t || expected.triangles != found.triangles ? 1 : 0;
    }
    EXPECT_EQ(different, 0U);
    EXPECT_GT(hits, rays.size() / 100);
    EXPECT_LT(hits, rays.size());
}

TEST(BvhTraversal, FindsTheNearestHitsOfASoup) {
    for (const bool splits : {false, true})
        compare(test::random_soup(1000, 0.1F, 3), {.spatial_splits = splits}, 10000);
}

TEST(BvhTraversal, FindsTheNearestHitsOfNeedles) {
    const BvhMesh mesh = test::diagonal_needles(600, 3);
    EXPECT_TRUE(build_bvh(mesh.positions, mesh.triangles, {}).has_spatial_splits);
    for (const bool splits : {false, true}) compare(mesh, {.spatial_splits = splits}, 10000);
}

TEST(BvhTraversal, FindsTheNearestHitsOfAGridOfSharedEdges) {
    // Without padding a box that ends at coordinate 0 ends one denormal beyond it, which a ray
    // along that plane, whose direction is made 1e-18 there, leaves before it gets anywhere.
    compare(test::flat_grid(16), {.max_leaf_triangles = 2, .padding = 1e-6F}, 10000);
}

}  // namespace
}  // namespace weft::bvh_traversal_test
