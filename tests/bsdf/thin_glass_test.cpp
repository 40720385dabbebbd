// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#define NATIVE_KERNELS "kernels/bsdf/thin_glass.h"
#include "tests/testing/native_kernels.h"

namespace weft::thin_glass_test {
namespace {

using native::f3;

native::IndexRatio ratio_of(double eta) {
    return {static_cast<float>(eta), static_cast<float>((eta - 1.0) * (eta + 1.0))};
}

TEST(ThinGlass, PanesReflectAtBothSurfacesForEver) {
    const double expected[][2] = {{1.0, 0.923077}, {std::sqrt(0.75), 0.920266}, {0.5, 0.836232}};
    for (const auto& [c, transmitted] : expected) {
        const native::Pane pane = native::pane_of_glass(ratio_of(1.5), static_cast<float>(c));
        EXPECT_NEAR(pane.transmitted, transmitted, 1e-6) << c;
        EXPECT_NEAR(pane.reflected, 1.0 - transmitted, 1e-6) << c;
        // The same as a sum over the reflections inside.
        const auto f = native::dielectric_fresnel(ratio_of(1.5), static_cast<float>(c));
        double sum = 0.0;
        for (int i = 0; i < 60; ++i)
            sum += double(f.transmitted) * std::pow(double(f.reflected), 2 * i) * f.transmitted;
        EXPECT_NEAR(pane.transmitted, sum, 1e-6) << c;
    }
    const native::Pane grazing = native::pane_of_glass(ratio_of(1.5), 0.0F);
    EXPECT_NEAR(grazing.reflected, 1.0F, 1e-6F);
    EXPECT_NEAR(grazing.transmitted, 0.0F, 1e-6F);
}

TEST(ThinGlass, SheetsOfALowIndexAreClearer) {
    const native::Facets facets = native::make_facets(0.5F, 0.25F, FACETS_BECKMANN);
    EXPECT_EQ(native::sheet_facets(facets, 1.5F).alpha_x, 0.5F);
    EXPECT_EQ(native::sheet_facets(facets, 2.5F).alpha_y, 0.25F);
    EXPECT_NEAR(native::sheet_facets(facets, 1.25F).alpha_x, 0.25F, 1e-7F);
    EXPECT_TRUE(native::facets_are_smooth(native::sheet_facets(facets, 1.0F)));
    EXPECT_EQ(native::sheet_facets(facets, 1.25F).flags, FACETS_BECKMANN);
    EXPECT_EQ(native::across_sheet(f3(1, 2, 3)).z, -3.0F);
}

}  // namespace
}  // namespace weft::thin_glass_test
