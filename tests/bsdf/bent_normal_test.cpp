// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#define NATIVE_KERNELS "kernels/bsdf/bent_normal.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

namespace weft::bent_normal_test {
namespace {

using native::dot3;
using native::f3;
using native::float3;

float3 random_direction(native::Random* random, float cos_limit) {
    const float u = native::next_random(random);
    const float v = native::next_random(random);
    return native::cone_direction(u, v, cos_limit);
}

TEST(BentNormal, MirrorsTheViewerAboveTheTriangle) {
    native::Random random = native::make_random(1, 2, 3);
    const float3 geometric = f3(0, 0, 1);
    int bent = 0;
    float lowest = 1.0F;
    for (int i = 0; i < 1'000'000; ++i) {
        const float3 v = random_direction(&random, 0.0F);
        const float3 normal = random_direction(&random, -1.0F);
        if (!(v.z > 1e-4F)) continue;
        const float3 found = native::bent_normal(v, normal, geometric);
        ASSERT_NEAR(native::length3(found), 1.0F, 1e-6F);
        const float facing = dot3(found, v);
        ASSERT_GT(facing, 0.0F);
        const float3 mirrored = found * (2.0F * facing) - v;
        const float least = std::min(0.9F * v.z, LEAST_BENT_HEIGHT);
        // Roundings of about 1, of a direction that may be 1e-4 from the other.
        ASSERT_GT(mirrored.z, 0.0F) << v.z;
        lowest = std::min(lowest, mirrored.z / least);
        bent += dot3(found, normal) < 0.999999F ? 1 : 0;
    }
    EXPECT_GT(lowest, 0.99F);
    EXPECT_GT(bent, 300'000);
}

TEST(BentNormal, LeavesWhatNeedsNoBending) {
    native::Random random = native::make_random(4, 5, 6);
    for (int i = 0; i < 100'000; ++i) {
        const float3 geometric = random_direction(&random, -1.0F);
        const float3 v = native::to_world(random_direction(&random, 0.1F), geometric);
        // A normal map is flat in most places.
        const float3 same = native::bent_normal(v, geometric, geometric);
        ASSERT_EQ(same.x, geometric.x);
        const float3 normal = native::to_world(random_direction(&random, 0.9F), geometric);
        const float facing = dot3(normal, v);
        if (!(facing >= LEAST_BENT_HEIGHT) ||
            dot3(normal * (2.0F * facing) - v, geometric) < LEAST_BENT_HEIGHT)
            continue;
        const float3 found = native::bent_normal(v, normal, geometric);
        ASSERT_TRUE(found.x == normal.x && found.y == normal.y && found.z == normal.z);
    }
}

TEST(BentNormal, BendsWithoutAStep) {
    // A normal that turns away from the viewer: the bent one follows without a jump.
    const float3 v = native::normalize3(f3(0.8F, 0.0F, 0.3F));
    float3 before = native::bent_normal(v, f3(0, 0, 1), f3(0, 0, 1));
    for (int i = 1; i <= 10'000; ++i) {
        const float angle = -1.5F * static_cast<float>(i) / 10'000.0F;
        float s, c;
        native::m_sincos(angle, &s, &c);
        const float3 now = native::bent_normal(v, f3(s, 0.0F, c), f3(0, 0, 1));
        ASSERT_LT(native::length3(now - before), 2e-3F) << angle;
        before = now;
    }
}

TEST(BentNormal, IsFiniteForViewersAlongTheTriangle) {
    for (const float height : {0.0F, 1e-30F, 1e-7F, 1e-4F})
        for (const float3 normal : {f3(0, 0, 1), f3(0, 0, -1), f3(1, 0, 0), f3(-1, 0, 0)}) {
            const float3 found = native::bent_normal(f3(1, 0, height), normal, f3(0, 0, 1));
            EXPECT_TRUE(native::is_finite3(found)) << height;
        }
}

}  // namespace
}  // namespace weft::bent_normal_test
