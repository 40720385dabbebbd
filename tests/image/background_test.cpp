// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/background.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <vector>

#include "image/exr.h"
#include "image/png.h"
#include "tests/testing/temporary_folder.h"

namespace weft::background_test {
namespace {

/// Three pixels: nothing, half of a surface of (0.4, 0.2, 1), and all of it; premultiplied.
Image half_covered() {
    Image image;
    image.width = 3;
    image.height = 1;
    image.layers = {{"", "RGB", {0.0F, 0.2F, 0.4F, 0.0F, 0.1F, 0.2F, 0.0F, 0.5F, 1.0F}},
                    {"alpha", "A", {0.0F, 0.5F, 1.0F}},
                    {"direct", "RGB", std::vector<float>(9, 0.1F)},
                    {"emission", "RGB", std::vector<float>(9, 0.0F)}};
    return image;
}

std::vector<png_byte> png_values(const Image& image, const PngSettings& settings,
                                 png_uint_32 expected_format) {
    const std::vector<std::byte> bytes = png_bytes(image, settings);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return {};
    EXPECT_EQ(png.format, expected_format);
    std::vector<png_byte> values(PNG_IMAGE_SIZE(png));
    if (png_image_finish_read(&png, nullptr, values.data(), 0, nullptr) == 0) return {};
    return values;
}

/// The code of a linear value, to within the dither.
void expect_code(png_byte found, double linear) {
    const double code =
        255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
    EXPECT_NEAR(found, code, 1.0) << linear;
}

TEST(Background, AColourComesBehindBeautyAndEmission) {
    Image image = half_covered();
    put_behind({false, {1.0F, 0.5F, 0.0F}}, image);
    EXPECT_EQ(image.layers[0].values,
              (std::vector<float>{1.0F, 0.7F, 0.4F, 0.5F, 0.35F, 0.2F, 0.0F, 0.5F, 1.0F}));
    EXPECT_EQ(image.layers[1].values, (std::vector<float>{1.0F, 1.0F, 1.0F}));
    EXPECT_EQ(image.find("direct")->values, std::vector<float>(9, 0.1F));
    EXPECT_EQ(image.find("emission")->values,
              (std::vector<float>{1.0F, 0.5F, 0.0F, 0.5F, 0.25F, 0.0F, 0.0F, 0.0F, 0.0F}));
}

TEST(Background, TransparentChangesNothingNorDoesAnImageWithoutAlpha) {
    Image image = half_covered();
    const std::vector<float> before = image.layers[0].values;
    put_behind({}, image);
    EXPECT_EQ(image.layers[0].values, before);
    image.layers.erase(image.layers.begin() + 1);
    put_behind({false, glm::vec3(1.0F)}, image);
    EXPECT_EQ(image.layers[0].values, before);
    EXPECT_TRUE(alpha_of(image).empty());
}

TEST(Background, AlphaIsFoundInImagesFromFiles) {
    TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    write_exr(path, half_covered());
    Image read = read_exr(path);
    EXPECT_EQ(read.find("")->channels, "RGBA");
    ASSERT_EQ(alpha_of(read).size(), 3U);
    EXPECT_EQ(alpha_of(read)[1], 0.5F);
    put_behind({false, glm::vec3(1.0F)}, read);
    EXPECT_EQ(read.find("")->values, (std::vector<float>{1.0F, 0.7F, 0.4F, 1.0F, 0.6F, 0.2F, 1.0F,
                                                         1.0F, 1.0F, 1.0F, 1.0F, 1.0F}));
}

TEST(Background, PngFilesAreOpaqueUnlessAskedFor) {
    const auto opaque = png_values(half_covered(), {}, PNG_FORMAT_RGB);
    ASSERT_EQ(opaque.size(), 9U);
    expect_code(opaque[3], 0.2);
    expect_code(opaque[8], 1.0);
}

TEST(Background, TransparentPngFilesHaveStraightColours) {
    for (const double ev : {0.0, -1.0}) {
        const auto straight =
            png_values(half_covered(),
                       {.exposure_ev = ev, .tone = ToneCurve::none, .background = Background{}},
                       PNG_FORMAT_RGBA);
        ASSERT_EQ(straight.size(), 12U);
        EXPECT_EQ(straight[3], 0);
        EXPECT_EQ(straight[7], 128);
        EXPECT_EQ(straight[11], 255);
        // The colour of the edge is that of the surface.
        const double scale = std::exp2(ev);
        for (const std::size_t first : {std::size_t{4}, std::size_t{8}}) {
            expect_code(straight[first], 0.4 * scale);
            expect_code(straight[first + 1], 0.2 * scale);
            expect_code(straight[first + 2], 1.0 * scale);
        }
    }
}

TEST(Background, AColourIsShownAsGivenWhateverTheExposureAndCurve) {
    for (const ToneCurve tone : {ToneCurve::none, ToneCurve::filmic, ToneCurve::agx}) {
        const auto shown = png_values(
            half_covered(),
            {.exposure_ev = -3.0, .tone = tone, .background = Background{false, {1.0F, 0.25F, 0}}},
            PNG_FORMAT_RGB);
        ASSERT_EQ(shown.size(), 9U);
        EXPECT_EQ(shown[0], 255);
        expect_code(shown[1], 0.25);
        EXPECT_EQ(shown[2], 0);
    }
    const auto half = png_values(
        half_covered(), {.tone = ToneCurve::none, .background = Background{false, glm::vec3(1.0F)}},
        PNG_FORMAT_RGB);
    ASSERT_EQ(half.size(), 9U);
    expect_code(half[3], 0.7);
    expect_code(half[4], 0.6);
    expect_code(half[5], 1.0);
}

}  // namespace
}  // namespace weft::background_test
