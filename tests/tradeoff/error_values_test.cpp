// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/error_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/error.h"
#include "tradeoff/image_errors.h"

namespace weft::error_values_test {
namespace {

constexpr std::uint32_t edge = 64;

/// A gradient, and spots of growing contrast upon it.
Image make_image(float contrast) {
    Layer layer{"", "RGB", std::vector<float>(3 * edge * edge)};
    for (std::uint32_t i = 0; i < edge * edge; ++i) {
        const float x = static_cast<float>(i % edge) / edge;
        const float y = static_cast<float>(i / edge) / edge;
        const float spot = (i % edge) % 16 < 6 && (i / edge) % 16 < 6 ? contrast * x * y : 0.0F;
        for (std::uint32_t c = 0; c < 3; ++c)
            layer.values[c * edge * edge + i] = 0.2F + 0.5F * x + spot;
    }
    return {edge, edge, {layer}, {}};
}

double value(const std::vector<double>& values, ErrorMeasure measure) {
    return values.at(static_cast<std::size_t>(measure));
}

TEST(ErrorValues, EachIsAtItsPlace) {
    const Image reference = make_image(0.0F);
    const Image test = make_image(0.6F);
    const std::vector<double> values = error_values(reference, test);
    const ImageErrors errors = image_errors(reference, test, "", {});
    ASSERT_EQ(values.size(), error_measures);
    EXPECT_EQ(value(values, ErrorMeasure::hdrflip), *errors.hdrflip);
    EXPECT_EQ(value(values, ErrorMeasure::vdp75), errors.published->p75);
    EXPECT_EQ(value(values, ErrorMeasure::vdp95), errors.published->p95);
    EXPECT_EQ(value(values, ErrorMeasure::vdp75_display), errors.display->p75);
    EXPECT_EQ(value(values, ErrorMeasure::vdp95_display), errors.display->p95);
    EXPECT_EQ(value(values, ErrorMeasure::relmse), *errors.relmse);
    EXPECT_EQ(value(values, ErrorMeasure::bias), std::abs(*errors.bias));
    // Otherwise two of them might have changed places unseen.
    EXPECT_EQ(std::set<double>(values.begin(), values.end()).size(), error_measures);
}

TEST(ErrorValues, NothingDiffersFromItself) {
    EXPECT_EQ(error_values(make_image(0.3F), make_image(0.3F)),
              std::vector<double>(error_measures, 0.0));
    const std::vector<float> map = error_map(make_image(0.3F), make_image(0.3F));
    EXPECT_EQ(map.size(), std::size_t{edge} * edge);
    EXPECT_EQ(*std::max_element(map.begin(), map.end()), 0.0F);
}

TEST(ErrorValues, WhatCannotBeComparedIsRefused) {
    Image black = make_image(0.0F);
    std::fill(black.layers[0].values.begin(), black.layers[0].values.end(), 0.0F);
    EXPECT_THROW((void)error_values(black, make_image(0.3F)), Error);
    EXPECT_THROW((void)layer_as_beauty(make_image(0.3F), "missing"), Error);
}

}  // namespace
}  // namespace weft::error_values_test
