// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/testing/watertight.h"

namespace weft::watertight_slow_test {
namespace {

TEST(WatertightSlow, NoneOfTenMillionRaysLeavesAClosedMesh) {
    // 5 meshes at 5 places.
    test::expect_watertight(400000);
}

}  // namespace
}  // namespace weft::watertight_slow_test
