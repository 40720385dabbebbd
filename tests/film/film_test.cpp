// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "shared/shared_types.h"

namespace weft::film_test {
namespace {

constexpr std::uint32_t width = 3;
constexpr std::uint32_t height = 2;
constexpr std::size_t pixels = std::size_t{width} * height;

/// Plane p holds 100 p + the pixel's index.
std::vector<float> numbered() {
    std::vector<float> values(FILM_PLANES * FILM_STRIDE(pixels));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>(100 * (i / FILM_STRIDE(pixels)) + i % FILM_STRIDE(pixels));
    return values;
}

float value(const Image& image, const std::string& layer, std::size_t channel, std::size_t pixel) {
    const Layer* found = image.find(layer);
    if (found == nullptr) throw std::runtime_error("no layer " + layer);
    return found->values.at(channel * pixels + pixel);
}

TEST(Film, LayersTakeTheirPlanes) {
    const std::vector<float> low(FILM_PLANES * FILM_STRIDE(pixels), 0.0F);
    const Image image = resolve_film(numbered(), low, width, height, 1, 0);
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    ASSERT_EQ(image.layers.size(), 8u);
    EXPECT_EQ(image.layers[0].name, "");
    EXPECT_EQ(image.layers[1].name, "alpha");
    EXPECT_EQ(image.layers[1].channels, "A");
    EXPECT_EQ(image.layers[1].values[2], 100.0F * FILM_ALPHA + 2.0F);
    struct Expected {
        const char* name;
        const char* channels;
        int plane;
    };
    for (const Expected& expected : {Expected{"direct", "RGB", FILM_DIRECT},
                                     {"indirect", "RGB", FILM_INDIRECT},
                                     {"emission", "RGB", FILM_EMISSION},
                                     {"albedo", "RGB", FILM_ALBEDO},
                                     {"normal", "XYZ", FILM_NORMAL},
                                     {"depth", "Z", FILM_DEPTH}}) {
        const Layer* layer = image.find(expected.name);
        ASSERT_NE(layer, nullptr) << expected.name;
        EXPECT_EQ(layer->channels, expected.channels);
        ASSERT_EQ(layer->values.size(), layer->channels.size() * pixels);
        for (std::size_t c = 0; c < layer->channels.size(); ++c)
            for (std::size_t p = 0; p < pixels; ++p)
                EXPECT_EQ(
                    layer->values[c * pixels + p],
                    static_cast<float>(100 * (static_cast<std::size_t>(expected.plane) + c) + p))
                    << expected.name << " channel " << c << " pixel " << p;
    }
}

TEST(Film, BeautyIsTheSumOfComponents) {
    const std::vector<float> low(FILM_PLANES * FILM_STRIDE(pixels), 0.0F);
    const Image image = resolve_film(numbered(), low, width, height, 1, 0);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t p = 0; p < pixels; ++p)
            EXPECT_EQ(value(image, "", c, p), value(image, "direct", c, p) +
                                                  value(image, "indirect", c, p) +
                                                  value(image, "emission", c, p));
}

TEST(Film, LayersAreMeansOverSamples) {
    const std::vector<float> low(FILM_PLANES * FILM_STRIDE(pixels), 0.0F);
    const Image image = resolve_film(numbered(), low, width, height, 4, 0);
    EXPECT_EQ(value(image, "direct", 0, 2), 302.0F / 4.0F);
    EXPECT_EQ(value(image, "depth", 0, 5), 1505.0F / 4.0F);
}

TEST(Film, CompensationCounts) {
    // Together both parts hold 2^24 + 1, which no float can: a mean of 2 samples shows it.
    const std::vector<float> high(FILM_PLANES * FILM_STRIDE(pixels), 16777216.0F);
    const std::vector<float> low(FILM_PLANES * FILM_STRIDE(pixels), 1.0F);
    const Image image = resolve_film(high, low, width, height, 2, 0);
    EXPECT_EQ(value(image, "direct", 1, 3), 8388608.5F);
    // The sum of components is rounded once, too.
    EXPECT_EQ(value(image, "", 1, 3), static_cast<float>(3.0 * 8388608.5));
}

TEST(Film, OneSampleHasNoRest) {
    const std::vector<float> low(FILM_PLANES * FILM_STRIDE(pixels), 1.0F);
    const Image written = resolve_film(numbered(), low, width, height, 1, 0);
    const Image absent = resolve_film(numbered(), {}, width, height, 1, 0);
    for (std::size_t p = 0; p < pixels; ++p) {
        EXPECT_EQ(value(written, "direct", 0, p), numbered()[3 * FILM_STRIDE(pixels) + p]);
        EXPECT_EQ(value(absent, "direct", 0, p), value(written, "direct", 0, p));
    }
}

TEST(Film, WithoutSamplesNothingIsDividedByZero) {
    const std::vector<float> none(FILM_PLANES * FILM_STRIDE(pixels), 0.0F);
    const Image image = resolve_film(none, none, width, height, 0, 0);
    for (const Layer& layer : image.layers)
        for (const float v : layer.values) EXPECT_EQ(v, 0.0F);
}

}  // namespace
}  // namespace weft::film_test
