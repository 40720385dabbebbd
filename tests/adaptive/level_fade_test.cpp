// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/level_fade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/testing/made_up_frames.h"
#include "tests/testing/render_fixture.h"
#include "tests/testing/room_scenes.h"

// Tiles that fade to a coarser level: their heights against a closed form, the samples that they
// need, and what images show of them.
namespace weft::level_fade_test {
namespace {

using test::Frame;
using test::MadeUpImage;
using test::RandomBits;
using test::room_with_ball;
using test::TestBackend;

TEST(LevelFade, HeightsRiseAtOnceAndFallBySteps) {
    RandomBits random(1);
    for (int run = 0; run < 100; ++run) {
        std::vector<Level> wanted;
        float height = 0.0F;
        for (int image = 0; image < 80; ++image) {
            const bool changes = random.below(12) == 0;
            wanted.push_back(wanted.empty() || changes ? static_cast<Level>(random.below(3))
                                                       : wanted.back());
            height =
                wanted.size() == 1 ? height_of(wanted.back()) : faded_height(height, wanted.back());
            // What was wanted in any image so far, less a step for each since then.
            float expected = 0.0F;
            for (std::size_t i = 0; i < wanted.size(); ++i)
                expected =
                    std::max(expected, height_of(wanted[i]) -
                                           fade_step * static_cast<float>(wanted.size() - 1 - i));
            ASSERT_EQ(height, expected);
            ASSERT_LE(height_of(level_below(height)), height);
            ASSERT_GE(height_of(level_above(height)), height);
            ASSERT_LT(height_of(level_above(height)) - height_of(level_below(height)), 1.5F);
        }
    }
}

TEST(LevelFade, GoesOnFromTheLastWholeImage) {
    LevelFade fade;
    fade.begin_sequence();
    EXPECT_TRUE(fade.earlier().empty());
    fade.show({2.0F});
    fade.show({1.0F});
    EXPECT_TRUE(fade.earlier().empty()) << "frames of one image";
    fade.begin_image();
    ASSERT_EQ(fade.earlier().size(), 1U);
    EXPECT_EQ(fade.earlier()[0], 1.0F);
    fade.begin_image();  // after one without a whole frame
    ASSERT_EQ(fade.earlier().size(), 1U);
    EXPECT_EQ(fade.earlier()[0], 1.0F);
    fade.begin_sequence();
    EXPECT_TRUE(fade.earlier().empty());
    fade.begin_image();
    EXPECT_TRUE(fade.earlier().empty());
}

std::vector<float> random_heights(const TileGrid& grid, RandomBits& random) {
    std::vector<float> heights;
    for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile)
        heights.push_back(fade_step * static_cast<float>(random.below(33)));
    return heights;
}

TEST(LevelFade, SamplesServeBothLevelsAndNothingIsJudgedOtherwise) {
    RandomBits random(2);
    std::size_t between = 0;
    for (const TileGrid& grid : test::small_images())
        for (const double threshold : {0.03, 0.3, 3.0}) {
            const test::MadeUpImage image = test::random_image(grid, random);
            const test::Signal signal = test::random_signal(random);
            const std::vector<float> earlier = random_heights(grid, random);
            const Frame free = test::run_frame(image, threshold, signal);
            const Frame faded = test::run_frame(image, threshold, signal, false, {}, {}, earlier);
            EXPECT_EQ(faded.levels, free.levels);
            EXPECT_EQ(faded.verdict.asked, free.verdict.asked);
            EXPECT_EQ(faded.verdict.kept, free.verdict.kept);
            EXPECT_EQ(faded.rounds[0].pixels, free.rounds[0].pixels);
            EXPECT_EQ(faded.rounds[1].pixels, free.rounds[1].pixels);
            std::vector<Level> below;
            std::vector<Level> above;
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
                const float height = faded.heights[tile];
                ASSERT_EQ(free.heights[tile], height_of(free.levels[tile]));
                ASSERT_EQ(height, faded_height(earlier[tile], free.levels[tile]));
                below.push_back(level_below(height));
                above.push_back(level_above(height));
                between += below.back() != above.back() ? 1U : 0U;
            }
            const std::vector<TileMask> coarser = required_masks(grid, below);
            const std::vector<TileMask> finer = required_masks(grid, above);
            for (std::uint32_t tile = 0; tile < grid.tiles(); ++tile) {
                const TileMask needed = (coarser[tile] | finer[tile]) & image.lit[tile];
                ASSERT_EQ(needed & ~faded.sampled[tile], 0U) << "tile " << tile;
            }
        }
    EXPECT_GT(between, 100U) << "nothing faded";
}

const Camera from_the_left = test::look_at({0.3, 0.1, 0.95}, {-0.1, -0.1, 0.0}, 1.2);
const Camera from_the_right = test::look_at({-0.2, 0.0, 0.95}, {0.1, -0.1, 0.0}, 1.2);

RenderSettings settings() {
    RenderSettings small = test::small_settings(Algorithm::ais, 85, 67);
    small.sampling.vpls_per_set = 16;
    small.sampling.threshold = 6.0;
    small.direct = false;
    return small;
}

/// An image from one side, and then some from the other.
std::vector<Image> sequence(TestBackend backend, int count) {
    Renderer renderer(test::shared_executor(backend), room_with_ball(), from_the_left, settings());
    EXPECT_TRUE(renderer.render_frame({}));
    std::vector<Image> images;
    for (int image = 0; image < count; ++image) {
        renderer.move_camera(from_the_right);
        EXPECT_TRUE(renderer.render_frame({}));
        images.push_back(renderer.image());
    }
    return images;
}

TEST(LevelFade, OpenClEqualsTheNativeKernelsBitForBit) {
    if (!test::has_opencl()) GTEST_SKIP() << "no OpenCL device";
    const std::vector<Image> native = sequence(TestBackend::own_bvh, 24);
    const std::vector<Image> opencl = sequence(TestBackend::opencl, 24);
    for (std::size_t i = 0; i < native.size(); ++i)
        EXPECT_EQ(test::differing_values(native[i], opencl[i]), 0U) << i;
}

// From level to level takes 16 images, and with what is held no two tiles are more than
// quiet_images apart: from the 8th to the 15th image all that fade are between the same two
// levels, and images change evenly. In the end nothing fades any more.
TEST(LevelFade, ImagesChangeEvenlyAndThenNoMore) {
    const std::vector<Image> images = sequence(TestBackend::own_bvh, 48);
    std::size_t fading = 0;
    for (std::size_t i = 8; i < 14; ++i) {
        const auto& before = images[i - 1].find("indirect")->values;
        const auto& now = images[i].find("indirect")->values;
        const auto& after = images[i + 1].find("indirect")->values;
        for (std::size_t k = 0; k < now.size(); ++k) {
            const float change = now[k] - before[k];
            ASSERT_NEAR(after[k] - now[k], change, 4e-6F * now[k]) << "image " << i;
            fading += std::abs(change) > 1e-4F * now[k] ? 1U : 0U;
        }
    }
    EXPECT_GT(fading, 100U) << "nothing fades";
    EXPECT_EQ(test::differing_values(images.back(), images[images.size() - 2]), 0U);
}

}  // namespace
}  // namespace weft::level_fade_test
