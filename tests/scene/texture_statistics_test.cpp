// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/texture_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/testing/noise_texture.h"

namespace weft::texture_statistics_test {
namespace {

constexpr Channel channels[] = {Channel::red, Channel::green, Channel::blue, Channel::alpha};

/// Texels of bytes between `low` and `high`, more than one thread takes at once.
Texture noise(int low, int high, bool srgb) {
    return test::noise_texture(700, 301, srgb, low, high);
}

double linear(const Texture& texture, std::size_t texel, std::size_t channel) {
    return test::linear_of(texture.rgba[4 * texel + channel], texture.srgb && channel < 3);
}

TEST(TextureStatistics, AreThoseOfAllTexels) {
    for (const bool srgb : {false, true}) {
        const Texture texture = noise(20, 210, srgb);
        const TextureStatistics found = measure_texture(texture);
        const std::size_t texels = texture.rgba.size() / 4;
        for (std::size_t c = 0; c < 4; ++c) {
            std::vector<double> values;
            double sum = 0.0;
            for (std::size_t i = 0; i < texels; ++i) {
                values.push_back(linear(texture, i, c));
                sum += values.back();
            }
            const auto [least, most] = std::minmax_element(values.begin(), values.end());
            EXPECT_EQ(found.range_of(channels[c]).least, *least) << c;
            EXPECT_EQ(found.range_of(channels[c]).most, *most) << c;
            EXPECT_NEAR(found.mean_of(channels[c]), sum / static_cast<double>(texels), 1e-12) << c;
        }
        double least = 1.0;
        double most = 0.0;
        for (std::size_t i = 0; i < texels; ++i) {
            const double y = 0.2126 * linear(texture, i, 0) + 0.7152 * linear(texture, i, 1) +
                             0.0722 * linear(texture, i, 2);
            least = std::min(least, y);
            most = std::max(most, y);
        }
        EXPECT_NEAR(found.range_of(Channel::luminance).least, least, 1e-15);
        EXPECT_NEAR(found.range_of(Channel::luminance).most, most, 1e-15);
        EXPECT_NEAR(found.mean_of(Channel::luminance),
                    0.2126 * found.mean.r + 0.7152 * found.mean.g + 0.0722 * found.mean.b, 1e-15);
    }
}

TEST(TextureStatistics, OfOneByteAreThatByte) {
    const TextureStatistics found = measure_texture(noise(51, 51, false));
    for (const Channel channel : channels) {
        EXPECT_NEAR(found.mean_of(channel), 0.2, 1e-15);
        EXPECT_EQ(found.range_of(channel).least, 0.2);
        EXPECT_EQ(found.range_of(channel).most, 0.2);
    }
}

TEST(TextureStatistics, NothingIsKnownOfWhatIsNotShown) {
    const std::vector<Texture> textures{noise(51, 51, false), noise(51, 51, false), {}};
    const auto found = measure_textures(textures, {false, true, true});
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
        EXPECT_EQ(found[i].mean_of(Channel::green), 1.0);
        EXPECT_EQ(found[i].range_of(Channel::green).least, 0.0);
        EXPECT_EQ(found[i].range_of(Channel::green).most, 1.0);
    }
    EXPECT_EQ(found[1].range_of(Channel::green).most, 0.2);
}

}  // namespace
}  // namespace weft::texture_statistics_test
