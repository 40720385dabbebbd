// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/slabs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/testing/bvh_meshes.h"

namespace weft::slabs_test {
namespace {

TEST(Slabs, OrderedPlanesPartEveryValue) {
    test::Uniform uniform(3);
    for (const float scale : {1e-30F, 1e-3F, 1.0F, 1e15F}) {
        Box box{{uniform(-scale, 0.0F), 0, 0}, {uniform(0.1F * scale, scale), 1, 1}};
        const Slabs slabs(box, 0, 16);
        ASSERT_EQ(slabs.count(), 16U);
        for (int i = 0; i < 2000; ++i) {
            // Half of the values lie on planes or beside them, where roundings decide.
            float value = uniform(box.lower[0], box.upper[0]);
            if (i % 2 == 0) {
                const float plane = slabs.plane(1 + static_cast<std::size_t>(i) % 15);
                value = std::nextafter(plane, i % 4 == 0 ? -INFINITY : INFINITY);
                if (i % 3 == 0) value = plane;
            }
            const std::size_t k = slabs.slab_of(value);
            EXPECT_TRUE(k == 0 || slabs.plane(k) <= value);
            EXPECT_TRUE(k == 15 || value < slabs.plane(k + 1));
            const std::size_t last = slabs.last_slab(0, value);
            EXPECT_TRUE(last == 0 || slabs.plane(last) < value);
            EXPECT_EQ(last, k > 0 && slabs.plane(k) == value ? k - 1 : k);
        }
        EXPECT_EQ(slabs.slab_of(-INFINITY), 0U);
        EXPECT_EQ(slabs.slab_of(INFINITY), 15U);
    }
}

TEST(Slabs, ThereIsOneWherePlanesWouldCoincide) {
    const float next = std::nextafter(1.0F, 2.0F);
    EXPECT_EQ(Slabs({{1, 0, 0}, {1, 1, 1}}, 0, 16).count(), 1U);
    EXPECT_EQ(Slabs({{1, 0, 0}, {next, 1, 1}}, 0, 16).count(), 1U);
    EXPECT_EQ(Slabs({{0, 0, 0}, {1e-45F, 1, 1}}, 0, 16).count(), 1U);
    EXPECT_EQ(Slabs(Box{}, 0, 16).count(), 1U);
    EXPECT_EQ(Slabs(Box{}, 0, 16).slab_of(7.0F), 0U);
}

}  // namespace
}  // namespace weft::slabs_test
