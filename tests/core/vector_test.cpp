// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

#define NATIVE_KERNELS "kernels/core/vector.h"
#include "tests/testing/native_kernels.h"

namespace {

using namespace native;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float tiny = std::numeric_limits<float>::denorm_min();
constexpr float huge = std::numeric_limits<float>::max();

/// Reproducible vectors in the cube [-1, 1]^3.
struct Random {
    std::uint64_t state = 1;

    float next() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<float>(state >> 40) * 0x1p-23f - 1.0f;
    }
    float3 vector() {
        const float x = next();
        const float y = next();
        const float z = next();
        return f3(x, y, z);
    }
};

double exact_length(float3 v) {
    const double x = v.x, y = v.y, z = v.z;
    return std::sqrt(x * x + y * y + z * z);
}

bool equal(float3 a, float3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

TEST(Vector, ProductsFollowTheirDefinitions) {
    const float3 a = f3(1.0f, 2.0f, 3.0f), b = f3(-4.0f, 5.0f, 6.0f);
    EXPECT_EQ(dot3(a, b), 24.0f);
    EXPECT_TRUE(equal(cross3(a, b), f3(-3.0f, -18.0f, 13.0f)));
    Random random;
    for (int i = 0; i < 1000; ++i) {
        const float3 u = random.vector(), v = random.vector();
        EXPECT_TRUE(equal(cross3(u, v), -cross3(v, u)));
    }
}

TEST(Vector, ComponentsAreSelected) {
    const float3 v = f3(-7.0f, 2.0f, 5.0f);
    EXPECT_EQ(max_component(v), 5.0f);
    EXPECT_EQ(min_component(v), -7.0f);
    EXPECT_TRUE(equal(absolute3(v), f3(7.0f, 2.0f, 5.0f)));
    EXPECT_TRUE(equal(lowest3(v, f3(0.0f, 0.0f, 9.0f)), f3(-7.0f, 0.0f, 5.0f)));
    EXPECT_TRUE(equal(highest3(v, f3(0.0f, 0.0f, 9.0f)), f3(0.0f, 2.0f, 9.0f)));
    EXPECT_EQ(dominant_axis(v), 0);
    EXPECT_EQ(dominant_axis(f3(1.0f, -3.0f, 2.0f)), 1);
    EXPECT_EQ(dominant_axis(f3(1.0f, 3.0f, -4.0f)), 2);
    EXPECT_EQ(dominant_axis(f3(2.0f, -2.0f, 2.0f)), 0);
    EXPECT_EQ(dominant_axis(f3(0.0f, 2.0f, 2.0f)), 1);
}

TEST(Vector, LengthAndDirectionHoldAtEveryScale) {
    Random random;
    for (float scale : {1e-37f, 1e-30f, 1e-10f, 1.0f, 1e10f, 1e30f, 1e38f}) {
        for (int i = 0; i < 20'000; ++i) {
            const float3 v = random.vector() * scale;
            const double length = exact_length(v);
            ASSERT_NEAR(length3(v) / length, 1.0, 3.6e-7) << scale;
            const float3 n = normalize3(v);
            ASSERT_NEAR(n.x, v.x / length, 3e-7);
            ASSERT_NEAR(n.y, v.y / length, 3e-7);
            ASSERT_NEAR(n.z, v.z / length, 3e-7);
            ASSERT_NEAR(exact_length(n), 1.0, 2.5e-7);
        }
    }
}

TEST(Vector, LengthAndDirectionOfSpecialVectors) {
    const float3 zero = f3(0.0f, 0.0f, 0.0f);
    EXPECT_EQ(length3(zero), 0.0f);
    EXPECT_TRUE(equal(normalize3(zero), zero));
    EXPECT_EQ(length3(f3(0.0f, -tiny, 0.0f)), tiny);
    EXPECT_TRUE(equal(normalize3(f3(0.0f, -tiny, 0.0f)), f3(0.0f, -1.0f, 0.0f)));
    EXPECT_TRUE(equal(normalize3(f3(huge, 0.0f, 0.0f)), f3(1.0f, 0.0f, 0.0f)));
    EXPECT_EQ(length3(f3(huge, huge, 0.0f)), infinity);
    for (float bad : {infinity, -infinity, nan}) {
        for (float other : {0.0f, 1.0f, huge, bad}) {
            for (const float3 v :
                 {f3(bad, other, other), f3(other, bad, other), f3(other, other, bad)}) {
                EXPECT_TRUE(equal(normalize3(v), zero));
                EXPECT_FALSE(is_finite3(v));
                if (std::isnan(bad)) {
                    EXPECT_TRUE(std::isnan(length3(v)));
                } else {
                    EXPECT_EQ(length3(v), infinity);
                }
            }
        }
    }
    EXPECT_TRUE(is_finite3(f3(huge, -huge, tiny)));
    EXPECT_TRUE(is_finite3(zero));
}

void expect_basis(float3 n) {
    float3 t, b;
    make_basis(n, &t, &b);
    ASSERT_NEAR(exact_length(t), 1.0, 1e-6);
    ASSERT_NEAR(exact_length(b), 1.0, 1e-6);
    ASSERT_NEAR(dot3(t, n), 0.0f, 1e-6);
    ASSERT_NEAR(dot3(b, n), 0.0f, 1e-6);
    ASSERT_NEAR(dot3(t, b), 0.0f, 1e-6);
    const float3 c = cross3(t, b);
    ASSERT_NEAR(c.x, n.x, 1e-6);
    ASSERT_NEAR(c.y, n.y, 1e-6);
    ASSERT_NEAR(c.z, n.z, 1e-6);
}

TEST(Vector, BasisIsOrthonormalAndRightHanded) {
    Random random;
    for (int i = 0; i < 100'000; ++i) expect_basis(normalize3(random.vector()));
    // Near the poles, where earlier formulas lost all digits, and at both zeros of z.
    for (float z : {1.0f, -1.0f}) {
        for (float x : {0.0f, -0.0f, tiny, 1e-20f, 1e-7f, 1e-4f, 1e-3f}) {
            expect_basis(normalize3(f3(x, -x, z)));
        }
    }
    expect_basis(f3(1.0f, 0.0f, 0.0f));
    expect_basis(f3(0.0f, -1.0f, -0.0f));
}

TEST(Vector, LuminanceWeighsAsRec709) {
    EXPECT_EQ(luminance(f3(1.0f, 0.0f, 0.0f)), 0.2126f);
    EXPECT_EQ(luminance(f3(0.0f, 1.0f, 0.0f)), 0.7152f);
    EXPECT_EQ(luminance(f3(0.0f, 0.0f, 1.0f)), 0.0722f);
    EXPECT_NEAR(luminance(f3(1.0f, 1.0f, 1.0f)), 1.0f, 1e-7);
}

}  // namespace
