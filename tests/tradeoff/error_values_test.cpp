// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/error_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "base/error.h"
#include "metrics/unbiased_mse.h"
#include "tradeoff/image_errors.h"
#include "tradeoff/reference_images.h"

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

/// A reference with the halves `first` and `second`.
Image with_halves(const Image& first, const Image& second) {
    Image reference = first;
    for (std::size_t i = 0; i < reference.layers[0].values.size(); ++i)
        reference.layers[0].values[i] =
            0.5F * (first.layers[0].values[i] + second.layers[0].values[i]);
    for (const auto& [name, half] :
         {std::pair{first_half_layer, &first}, std::pair{second_half_layer, &second}}) {
        reference.layers.push_back(half->layers[0]);
        reference.layers.back().name = name;
    }
    return reference;
}

TEST(ErrorValues, HalvesGiveTheUnbiasedErrorAndTheFloor) {
    const Image first = make_image(0.1F);
    const Image second = make_image(0.15F);
    const Image test = make_image(0.6F);
    const Image reference = with_halves(first, second);
    const auto rgb = [](const Image& image) { return RgbView{image.layers[0].values, edge, edge}; };
    const ErrorEstimate expected =
        unbiased_errors({rgb(first), rgb(second)}, rgb(test)).relmse.value();
    const ErrorEstimate found = unbiased_value(reference, test).value();
    EXPECT_EQ(found.value, expected.value);
    EXPECT_EQ(found.low, expected.low);
    EXPECT_EQ(found.high, expected.high);
    EXPECT_GT(found.high, found.low);
    EXPECT_EQ(image_errors(reference, test, "", {}).unbiased_relmse->value, expected.value);
    EXPECT_EQ(image_errors(reference, test, "", {}).json()["unbiased_relmse"]["low"], expected.low);
    EXPECT_FALSE(
        image_errors(reference, test, "", {.unbiased = false}).unbiased_relmse.has_value());
    EXPECT_EQ(noise_relmse_of(reference),
              unbiased_errors({rgb(first), rgb(second)}, rgb(test)).noise_relmse);
    const ImageErrors floor = floor_errors(reference).value();
    EXPECT_EQ(floor.hdrflip, image_errors(first, second, "", {}).hdrflip);
    EXPECT_GT(*floor.hdrflip, 0.0);
    // Errors are those against the whole.
    EXPECT_EQ(error_values(reference, test), error_values(layer_as_beauty(reference, ""), test));
}

TEST(ErrorValues, WithoutHalvesThereIsNeither) {
    const Image plain = make_image(0.1F);
    EXPECT_FALSE(unbiased_value(plain, make_image(0.6F)).has_value());
    EXPECT_FALSE(floor_errors(plain).has_value());
    EXPECT_FALSE(noise_relmse_of(plain).has_value());
    const ImageErrors errors = image_errors(plain, make_image(0.6F), "", {});
    EXPECT_FALSE(errors.unbiased_relmse.has_value());
    EXPECT_FALSE(errors.json().contains("unbiased_relmse"));
}

TEST(ErrorValues, WhatCannotBeComparedIsRefused) {
    Image black = make_image(0.0F);
    std::fill(black.layers[0].values.begin(), black.layers[0].values.end(), 0.0F);
    EXPECT_THROW((void)error_values(black, make_image(0.3F)), Error);
    EXPECT_THROW((void)unbiased_value(with_halves(black, black), make_image(0.3F)), Error);
    EXPECT_THROW((void)layer_as_beauty(make_image(0.3F), "missing"), Error);
}

}  // namespace
}  // namespace weft::error_values_test
