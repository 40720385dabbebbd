// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/testing/render_fixture.h"

// Images of several frames: what the film adds up, and that it converges.
namespace weft::progressive_test {
namespace {

using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

SceneBuilder room_scene() {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.7F, 0.6F, 0.5F}));
    builder.add(test::quad_mesh({-0.3F, 0.9F, -0.3F}, {0.6F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.6F}),
                builder.material(glm::vec3(0.5F), {5.0F, 6.0F, 7.0F}));
    Mesh block = test::room_mesh();
    for (auto& triangle : block.triangles) std::swap(triangle[1], triangle[2]);
    builder.add(std::move(block), builder.material({0.3F, 0.5F, 0.8F}),
                test::placement(0.3, {-0.4, -0.7, -0.3}));
    return builder;
}

const FlatScene& room() {
    static const FlatScene flat = flatten(room_scene().scene);
    return flat;
}

Camera camera() {
    return test::look_at({0.3, 0.1, 0.95}, {-0.1, -0.1, 0.0}, 1.2);
}

RenderSettings settings_of(Algorithm algorithm, std::uint32_t frames, std::uint32_t seed = 0) {
    RenderSettings settings = test::small_settings(algorithm, 45, 31);
    settings.samples = frames;
    settings.seed = seed;
    return settings;
}

/// Means of the film after each of the first frames.
std::vector<Image> after_each_frame(TestBackend backend, const RenderSettings& settings,
                                    std::uint32_t frames) {
    Renderer renderer(test::shared_executor(backend), room(), camera(), settings);
    std::vector<Image> images;
    for (std::uint32_t f = 0; f < frames; ++f) {
        EXPECT_TRUE(renderer.render_frame({}));
        EXPECT_EQ(renderer.samples(), f + 1);
        images.push_back(renderer.image());
    }
    return images;
}

TEST(Progressive, TheFilmIsTheMeanOfItsFrames) {
    // The k-th frame is k times the k-th mean less k - 1 times the one before. Every frame is an
    // image of its own: never negative, and its share of the whole does not shrink.
    constexpr std::uint32_t frames = 8;
    for (const TestBackend backend : test::backends()) {
        const auto means = after_each_frame(backend, settings_of(Algorithm::igi, frames), frames);
        const std::vector<float>& whole = means.back().find("")->values;
        const double expected = test::mean_of(whole);
        for (std::uint32_t k = 1; k < frames; ++k) {
            const std::vector<float>& after = means[k].find("")->values;
            const std::vector<float>& before = means[k - 1].find("")->values;
            double sum = 0.0;
            double lowest = 0.0;
            std::size_t changed = 0;
            for (std::size_t i = 0; i < after.size(); ++i) {
                const double frame = (k + 1.0) * static_cast<double>(after[i]) -
                                     static_cast<double>(k) * static_cast<double>(before[i]);
                sum += frame;
                lowest = std::min(lowest, frame / (static_cast<double>(after[i]) + 1e-3));
                changed += after[i] != before[i] ? 1 : 0;
            }
            EXPECT_GE(lowest, -1e-5) << "frame " << k;
            EXPECT_GT(changed, after.size() / 2) << "frame " << k;
            EXPECT_NEAR(sum / static_cast<double>(after.size()), expected, 0.1 * expected)
                << "frame " << k;
        }
    }
}

TEST(Progressive, EqualFramesHaveTheirValueAsMeanBitForBit) {
    // Punctual light through pixel centres has no randomness: the compensated sum of 500 equal
    // frames divided by 500 is the frame.
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.7F, 0.6F, 0.5F}));
    builder.light(LightType::point, {0.3, 0.4, 0.2}, {1.0F, 2.0F, 3.3F});
    RenderSettings settings = test::small_settings(Algorithm::igi, 13, 11);
    settings.indirect = false;
    for (const TestBackend backend : test::backends()) {
        const Rendering one = test::render(backend, builder.scene, camera(), settings);
        const Rendering many = test::render(backend, builder.scene, camera(), settings, 500);
        EXPECT_GT(test::mean_of(one.layer("direct")), 0.0);
        EXPECT_EQ(test::differing_values(one.image, many.image), 0U);
        EXPECT_EQ(many.stats.size(), 500U);
    }
}

TEST(Progressive, SameSeedGivesTheSameBitsAndAnotherSeedOthers) {
    for (const TestBackend backend : test::backends())
        for (const Algorithm algorithm : {Algorithm::igi, Algorithm::ir}) {
            const auto image = [&](std::uint32_t seed) {
                return test::render_flat(test::shared_executor(backend), room(), camera(),
                                         settings_of(algorithm, 3, seed), 3);
            };
            const Rendering first = image(7);
            EXPECT_EQ(test::differing_values(first.image, image(7).image), 0U);
            for (const std::uint32_t seed : {8U, 0x80000007U}) {
                const Rendering other = image(seed);
                for (const char* layer : {"direct", "indirect", "depth"}) {
                    const std::vector<float>& a = first.layer(layer);
                    const std::vector<float>& b = other.layer(layer);
                    std::size_t different = 0;
                    for (std::size_t i = 0; i < a.size(); ++i) different += a[i] != b[i] ? 1 : 0;
                    EXPECT_GT(different, a.size() / 2) << layer << " seed " << seed;
                }
            }
        }
}

TEST(Progressive, TheErrorFallsAsFramesAccumulate) {
    // Each algorithm against its own limit (the filter of `igi` blurs shadows by design). Pixel
    // variance falls as 1/n, but for the bound, which loses less and less. Over four seeds the
    // squared error of 4 frames must be below 0.55 of that of one, and so on up to 16; it would be
    // 0.25 for independent samples, with a spread of some per cents for 4,000 values a seed.
    for (const Algorithm algorithm : {Algorithm::igi, Algorithm::ir}) {
        constexpr std::uint32_t longest = 16;
        const auto image = [&](std::uint32_t frames, std::uint32_t seed) {
            // Pixel centres for all lengths, so that edges do not count.
            return test::render_flat(test::shared_executor(TestBackend::embree), room(), camera(),
                                     settings_of(algorithm, 1, seed), frames);
        };
        const Rendering converged = image(longest * 12, 1234);
        std::array<double, 2> before{1e9, 1e9};
        for (std::uint32_t frames = 1; frames <= longest; frames *= 4) {
            std::array<double, 2> error{};
            for (std::uint32_t seed = 0; seed < 4; ++seed) {
                const Rendering test = image(frames, seed);
                error[0] +=
                    test::relative_mse(converged.layer("direct"), test.layer("direct")) / 4.0;
                error[1] +=
                    test::relative_mse(converged.layer("indirect"), test.layer("indirect")) / 4.0;
            }
            for (std::size_t i = 0; i < 2; ++i) {
                EXPECT_LT(error[i], 0.55 * before[i]) << frames << (i == 0 ? " direct" : "");
                EXPECT_LT(error[i], (i == 0 ? 1e-3 : 0.05) / frames) << frames;
            }
            before = error;
        }
    }
}

TEST(Progressive, FramesEndedEarlyAreDroppedAndChangeNothing) {
    const RenderSettings settings = settings_of(Algorithm::igi, 3);
    for (const TestBackend backend : test::backends()) {
        const auto expected = after_each_frame(backend, settings, 3);
        // Ended at every stage in turn but those that a frame always has.
        for (const Stage stage :
             {Stage::light_samples, Stage::area_lights, Stage::vpl_walk, Stage::vpl_gather}) {
            Renderer renderer(test::shared_executor(backend), room(), camera(), settings);
            ASSERT_TRUE(renderer.render_frame({}));
            ASSERT_TRUE(renderer.render_frame({}));
            const bool complete =
                renderer.render_frame([&](Stage running, double) { return running != stage; });
            ASSERT_FALSE(complete) << stage_name(stage);
            EXPECT_EQ(renderer.samples(), 2U) << stage_name(stage);
            EXPECT_EQ(test::differing_values(renderer.image(), expected[1]), 0U)
                << stage_name(stage);
            ASSERT_TRUE(renderer.render_frame({}));
            EXPECT_EQ(renderer.samples(), 3U) << stage_name(stage);
            EXPECT_EQ(test::differing_values(renderer.image(), expected[2]), 0U)
                << stage_name(stage);
        }
    }
}

TEST(Progressive, AFirstFrameEndedEarlyIsKeptAndClean) {
    RenderSettings settings = settings_of(Algorithm::ir, 1);
    settings.width = 300;
    settings.height = 200;
    for (const TestBackend backend : test::backends()) {
        std::uint32_t asked = 0;
        Renderer renderer(test::shared_executor(backend), room(), camera(), settings);
        const bool complete = renderer.render_frame(
            [&](Stage stage, double) { return stage != Stage::vpl_gather || ++asked < 3; });
        ASSERT_FALSE(complete);
        EXPECT_EQ(renderer.samples(), 1U);
        const Rendering kept{renderer.image(), renderer.stats(), renderer.plan()};
        test::expect_clean(kept);
        EXPECT_GT(test::mean_of(kept.layer("direct")), 0.0);
        const std::vector<float>& indirect = kept.layer("indirect");
        EXPECT_GT(std::count(indirect.begin(), indirect.end(), 0.0F), 0);
    }
}

// An atlas has white beside black: what is averaged over neighbouring texels shows as a rim.
TEST(Progressive, TexturesGetSharperWithMoreSamplesThanExpected) {
    SceneBuilder builder;
    Texture texture;
    texture.width = texture.height = 64;
    texture.srgb = false;
    for (std::uint32_t i = 0; i < 64 * 64; ++i)
        for (int c = 0; c < 4; ++c) texture.rgba.push_back(i % 64 < 32 ? 0 : 255);
    builder.scene.textures.push_back(texture);
    const std::uint32_t material = builder.material(glm::vec3(1.0F));
    set_albedo_texture(builder.scene.materials[material], 0);
    // Only the black half is used, up to one texel before the white one.
    Mesh quad = test::quad_mesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    for (glm::vec2& uv : quad.uvs) uv.x = 0.02F + uv.x * 0.46F;
    builder.add(std::move(quad), material);
    builder.scene.environment = Environment{glm::vec3(1.0F)};
    const FlatScene flat = flatten(builder.scene);
    RenderSettings settings = test::small_settings(Algorithm::ais, 8, 8);
    settings.samples = 2;
    const auto rim = [&](std::uint32_t frames) {
        const Rendering rendering =
            test::render_flat(test::shared_executor(TestBackend::own_bvh), flat,
                              test::look_at({0, 0, 3.0}, {0, 0, 0}, 0.8), settings, frames);
        double sum = 0.0;
        for (const double value : test::channel_of(rendering, "albedo", 0)) sum += value;
        return sum;
    };
    const double expected = rim(2);
    EXPECT_GT(expected, 0.01) << "there is nothing to see";
    EXPECT_LT(rim(64), 0.5 * expected);
}

}  // namespace
}  // namespace weft::progressive_test
