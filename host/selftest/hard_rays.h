// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_HARD_RAYS_H
#define WEFT_SELFTEST_HARD_RAYS_H

#include <cstddef>
#include <cstdint>

#include "selftest/bvh_meshes.h"
#include "selftest/ray_batch.h"

// Triangles and rays with which traversals go wrong.
namespace weft::selftest {

/// `count` rays of each of three kinds about the unit cube: random ones; along axes, with
/// directions that have components 0, -0 and denormals; from, through and in the planes and corners
/// of the tree's boxes.
[[nodiscard]] RayBatch all_rays(const RayGeometry& geometry, std::size_t count, std::uint32_t seed);

/// Triangles of width 1e-20 in a loose soup.
[[nodiscard]] BvhMesh thin_needles();

/// Adds rays in the planes of such needles, which only those rays can hit.
void add_rays_in_planes(RayBatch& rays, std::size_t count, std::uint32_t seed);

/// 200 triangles of about `size` in the middle of 50 whose coordinates reach 10^9.
[[nodiscard]] RayGeometry huge_and_tiny(float size);

/// Rays for huge_and_tiny: two thirds start among the tiny triangles, the others among the huge
/// ones.
[[nodiscard]] RayBatch rays_huge_and_tiny(float size);

/// A triangle with area, number 0, and 300 that are points or lines.
[[nodiscard]] BvhMesh triangles_without_area();

/// Adds rays at corners and middles of all triangles but the first.
void add_rays_at_flat_triangles(RayBatch& rays, const RayGeometry& geometry, std::size_t count,
                                std::uint32_t seed);

}  // namespace weft::selftest

#endif
