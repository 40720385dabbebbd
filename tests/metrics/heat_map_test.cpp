// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/file.h"
#include "image/png.h"
#include "image/read_png.h"
#include "metrics/numeric.h"
#include "tests/testing/temporary_folder.h"

namespace weft::heat_map_test {
namespace {

using Colour = std::array<std::uint8_t, 3>;

/// The colours of an image as a PNG keeps them.
class Written {
  public:
    explicit Written(const Image& image) {
        const TemporaryFolder folder;
        write_png(folder.path() / "map.png", image, 0.0);
        const Image back = decode_png(read_file(folder.path() / "map.png", 1 << 20), "map.png");
        width_ = back.width;
        height_ = back.height;
        encoded_ = srgb_encode(back.layers[0].values);
    }
    [[nodiscard]] Colour at(std::size_t x, std::size_t y) const {
        Colour colour{};
        for (std::size_t c = 0; c < 3; ++c)
            colour[c] = static_cast<std::uint8_t>(
                std::lround(255.0F * encoded_[c * width_ * height_ + y * width_ + x]));
        return colour;
    }
    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t height() const { return height_; }

  private:
    std::size_t width_ = 0;
    std::size_t height_ = 0;
    std::vector<float> encoded_;
};

TEST(HeatMap, ColoursGrowLighter) {
    EXPECT_EQ(viridis(0.0), (Colour{68, 1, 84}));
    EXPECT_EQ(viridis(1.0), (Colour{253, 231, 37}));
    EXPECT_EQ(viridis(-3.0), viridis(0.0));
    EXPECT_EQ(viridis(std::numeric_limits<double>::infinity()), viridis(1.0));
    EXPECT_EQ(viridis(std::numeric_limits<double>::quiet_NaN()), viridis(0.0));
    double last = 0.0;
    for (int i = 0; i <= 100; ++i) {
        const Colour c = viridis(i / 100.0);
        const double luma = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
        EXPECT_GT(luma, last - 1e-9) << i;
        last = luma;
    }
}

TEST(HeatMap, ShowsValuesAndAScale) {
    const std::uint32_t width = 100;
    const std::uint32_t height = 10;
    std::vector<float> values(std::size_t{width} * height);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.002F * static_cast<float>(i);
    const Written image(heat_map(values, width, height, 2.0));
    ASSERT_EQ(image.width(), width);
    ASSERT_GT(image.height(), std::size_t{height} + 15);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            EXPECT_EQ(image.at(x, y), viridis(values[y * width + x] / 2.0));
    const std::size_t bar = height + 6;
    EXPECT_EQ(image.at(4, bar), viridis(0.0));
    EXPECT_EQ(image.at(width - 5, bar), viridis(1.0));
    // A 0 at the left and a 2 at the right, whose lowest row is all five dots.
    const Colour white = {255, 255, 255};
    const std::size_t top = height + 16;
    EXPECT_EQ(image.at(5, top), white);
    EXPECT_NE(image.at(4, top), white);
    for (std::size_t x = width - 9; x < width - 4; ++x) EXPECT_EQ(image.at(x, top + 6), white);
    EXPECT_NE(image.at(width - 10, top + 6), white);
}

TEST(HeatMap, OfASmallMapIsWideEnoughForItsNumbers) {
    const std::vector<float> one = {0.5F};
    const Image small = heat_map(one, 1, 1, 1.25e-7);
    EXPECT_GE(small.width, (std::string("0  1.25e-07").size()) * 6);
    EXPECT_EQ(small.layers[0].values.size(), std::size_t{3} * small.width * small.height);
}

TEST(HeatMap, RefusesWhatItCannotShow) {
    const std::vector<float> values(4);
    for (const double high : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(static_cast<void>(heat_map(values, 2, 2, high)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(heat_map(values, 2, 3, 1.0)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(heat_map({}, 0, 0, 1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace weft::heat_map_test
