// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/write_jpeg.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "scene/texture/jpeg.h"

namespace weft::write_jpeg_test {
namespace {

constexpr std::uint32_t width = 37;
constexpr std::uint32_t height = 21;

/// A picture that changes slowly, but more in one direction and channel than in others.
std::vector<std::uint32_t> some_picture() {
    std::vector<std::uint32_t> colours;
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            colours.push_back((6 * x) | (200 - 4 * y) << 8U | (60 + 2 * x + 3 * y) << 16U |
                              0xFF000000U);
    return colours;
}

TEST(WriteJpeg, IsReadAgainAsItWas) {
    const std::vector<std::uint32_t> colours = some_picture();
    for (const bool halves : {false, true}) {
        const auto bytes = jpeg_bytes(colours, width, height, {95, halves});
        const Texture read =
            decode_jpeg(bytes, "test", [](std::uint32_t, std::uint32_t, const std::string&) {});
        ASSERT_EQ(read.width, width);
        ASSERT_EQ(read.height, height);
        for (std::size_t i = 0; i < colours.size(); ++i)
            for (std::uint32_t c = 0; c < 3; ++c) {
                const int was = static_cast<int>(colours[i] >> (8 * c) & 0xFFU);
                const int is = static_cast<int>(read.rgba[4 * i + c]);
                // Colour of blocks at the border at half the size is off by some steps.
                ASSERT_LE(std::abs(was - is), halves ? 14 : 6) << i << ' ' << c << ' ' << halves;
            }
    }
}

TEST(WriteJpeg, LowerQualityTakesFewerBytes) {
    const std::vector<std::uint32_t> colours = some_picture();
    EXPECT_LT(jpeg_bytes(colours, width, height, {40, true}).size(),
              jpeg_bytes(colours, width, height, {92, false}).size());
}

TEST(WriteJpeg, RefusesWhatIsNoPicture) {
    const std::vector<std::uint32_t> colours(100);
    EXPECT_THROW((void)jpeg_bytes(colours, 0, 10, {}), std::runtime_error);
    EXPECT_THROW((void)jpeg_bytes(colours, 11, 10, {}), std::runtime_error);
    const std::vector<std::uint32_t> wide(70000);
    EXPECT_THROW((void)jpeg_bytes(wide, 70000, 1, {}), std::runtime_error);
    EXPECT_FALSE(jpeg_bytes(colours, 10, 10, {}).empty());
}

}  // namespace
}  // namespace weft::write_jpeg_test
