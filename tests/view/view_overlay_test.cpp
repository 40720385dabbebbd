// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_overlay.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/srgb.h"
#include "metrics/heat_map.h"

namespace weft::view_overlay_test {
namespace {

/// A white image of two pixels with levels.
Image levels() {
    return {.width = 2,
            .height = 1,
            .layers = {{"", "RGB", std::vector<float>(6, 1.0F)},
                       {"direct.level", "Y", {0.0F, 2.0F}},
                       {"depth", "Z", {1.0F, 1.0F}}},
            .metadata = {}};
}

TEST(ViewOverlay, NamesLayersOfSamplingAndTheErrorOfJudgedImages) {
    EXPECT_EQ(overlay_names(levels(), false), std::vector<std::string>{"direct.level"});
    EXPECT_EQ(overlay_names(levels(), true), (std::vector<std::string>{"direct.level", "error"}));
}

TEST(ViewOverlay, ShowsErrorsFromNoneToAll) {
    const std::vector<float> flip = {0.0F, 1.0F};
    const Image overlay = overlay_of(levels(), "error", flip, 0.0);
    ASSERT_EQ(overlay.layers.size(), 1U);
    for (std::size_t pixel = 0; pixel < 2; ++pixel)
        for (std::size_t c = 0; c < 3; ++c) {
            const float over =
                static_cast<float>(viridis(static_cast<double>(flip[pixel])).at(c)) / 255.0F;
            EXPECT_FLOAT_EQ(overlay.layers[0].values[2 * c + pixel],
                            linear_from_srgb(0.5F * (1.0F + over)));
        }
}

TEST(ViewOverlay, IsEmptyWhereThereIsNoSuchOverlay) {
    EXPECT_TRUE(overlay_of(levels(), "error", {}, 0.0).layers.empty());
    EXPECT_TRUE(overlay_of(levels(), "error", std::vector<float>(3), 0.0).layers.empty());
    EXPECT_TRUE(overlay_of(levels(), "depth", {}, 0.0).layers.empty());
    EXPECT_TRUE(overlay_of(levels(), "", {}, 0.0).layers.empty());
    EXPECT_FALSE(overlay_of(levels(), "direct.level", {}, 0.0).layers.empty());
}

}  // namespace
}  // namespace weft::view_overlay_test
