// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mip_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/testing/noise_texture.h"

namespace weft::mip_levels_test {
namespace {

/// One level in doubles, 4 values a texel; alpha is in bytes.
struct ExactLevel {
    std::uint32_t width, height;
    std::vector<double> values;
};

/// All levels as the header defines them.
std::vector<ExactLevel> exact_levels(const Texture& texture) {
    std::vector<ExactLevel> levels{{texture.width, texture.height, {}}};
    for (std::size_t i = 0; i < texture.rgba.size(); ++i) {
        const int byte = texture.rgba[i];
        levels[0].values.push_back(i % 4 == 3 ? byte : test::linear_of(byte, texture.srgb));
    }
    while (levels.back().width > 1 || levels.back().height > 1) {
        const ExactLevel& from = levels.back();
        ExactLevel half{std::max(1U, from.width / 2), std::max(1U, from.height / 2), {}};
        std::vector<double> counts(std::size_t{half.width} * half.height);
        half.values.resize(4 * counts.size());
        for (std::uint32_t y = 0; y < from.height; ++y)
            for (std::uint32_t x = 0; x < from.width; ++x) {
                const std::size_t to = std::min(x / 2, half.width - 1) +
                                       std::size_t{std::min(y / 2, half.height - 1)} * half.width;
                ++counts[to];
                for (std::size_t c = 0; c < 4; ++c)
                    half.values[4 * to + c] +=
                        from.values[4 * (std::size_t{y} * from.width + x) + c];
            }
        for (std::size_t i = 0; i < half.values.size(); ++i) half.values[i] /= counts[i / 4];
        levels.push_back(half);
    }
    return levels;
}

TEST(MipLevels, AreMeansOfWhatTheyCover) {
    for (const auto& [width, height] : {std::pair{16U, 16U}, {37U, 5U}, {1U, 9U}, {1U, 1U}})
        for (const bool srgb : {false, true}) {
            const Texture texture = test::noise_texture(width, height, srgb);
            const std::vector<ExactLevel> exact = exact_levels(texture);
            const std::vector<LinearLevel> found = linear_mip_levels(texture);
            ASSERT_EQ(found.size(), exact.size());
            for (std::size_t l = 0; l < found.size(); ++l) {
                EXPECT_EQ(found[l].width, exact[l].width);
                EXPECT_EQ(found[l].height, exact[l].height);
                ASSERT_EQ(found[l].values.size() / 3, exact[l].values.size() / 4);
                for (std::size_t i = 0; i < found[l].values.size(); ++i)
                    EXPECT_NEAR(found[l].values[i], exact[l].values[i / 3 * 4 + i % 3], 1e-6);
            }
        }
}

TEST(MipLevels, KernelsReadTheNearestBytes) {
    for (const bool has_alpha : {false, true})
        for (const bool srgb : {false, true}) {
            Texture texture = test::noise_texture(37, 5, srgb);
            texture.has_alpha = has_alpha;
            constexpr std::uint32_t before = 0xDEADBEEF;
            std::vector<std::uint32_t> texels{before};
            append_mip_levels(texture, texels);
            EXPECT_EQ(texels[0], before);
            EXPECT_EQ(texels.size(), 1 + mip_texels(texture.width, texture.height));
            std::size_t next = 1;
            for (const ExactLevel& level : exact_levels(texture))
                for (std::size_t i = 0; i < level.values.size(); i += 4) {
                    ASSERT_LT(next, texels.size());
                    const std::uint32_t texel = texels[next++];
                    for (std::size_t c = 0; c < 3; ++c) {
                        const int byte = static_cast<int>(texel >> (8 * c) & 0xFFU);
                        const double value = test::linear_of(byte, srgb);
                        // Between the middles to the bytes on both sides.
                        EXPECT_GE(level.values[i + c],
                                  0.5 * (value + test::linear_of(byte - 1, srgb)) - 1e-6);
                        EXPECT_LE(level.values[i + c],
                                  0.5 * (value + test::linear_of(byte + 1, srgb)) + 1e-6);
                    }
                    if (has_alpha) {
                        EXPECT_NEAR(texel >> 24, level.values[i + 3], 0.5 + 1e-4);
                    } else {
                        EXPECT_EQ(texel >> 24, 0U);
                    }
                }
            EXPECT_EQ(next, texels.size());
        }
}

}  // namespace
}  // namespace weft::mip_levels_test
