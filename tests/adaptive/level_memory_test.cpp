// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/testing/render_fixture.h"
#include "tests/testing/room_scenes.h"

// Image sequences of ais: what an image takes over from those before it, and what it does not.
namespace weft::level_memory_test {
namespace {

using test::room_with_ball;
using test::TestBackend;

/// The camera of an image: it moves sidewards by about a third of a pixel.
Camera camera_at_image(int image) {
    return test::look_at({0.3 + 0.004 * image, 0.1, 0.95}, {-0.1, -0.1, 0.0}, 1.2);
}

RenderSettings settings() {
    RenderSettings small = test::small_settings(Algorithm::ais, 85, 67);
    small.sampling.vpls_per_set = 16;
    small.sampling.threshold = 8.0;
    return small;
}

Image image_of(Renderer& renderer, int frames = 1) {
    for (int frame = 0; frame < frames; ++frame) EXPECT_TRUE(renderer.render_frame({}));
    return renderer.image();
}

Image alone(TestBackend backend, int image, int frames = 1) {
    Renderer renderer(test::shared_executor(backend), room_with_ball(), camera_at_image(image),
                      settings());
    return image_of(renderer, frames);
}

const std::vector<float>& levels(const Image& image, const char* component) {
    return image.find(std::string(component) + ".level")->values;
}

TEST(LevelMemory, TheFirstImageOfASequenceIsThatOfANewRenderer) {
    for (const TestBackend backend : test::backends()) {
        Renderer renderer(test::shared_executor(backend), room_with_ball(), camera_at_image(7),
                          settings());
        image_of(renderer);
        for (const int image : {5, 3, 4}) {
            renderer.move_camera(camera_at_image(image));
            image_of(renderer);
        }
        renderer.set_camera(camera_at_image(0));
        EXPECT_EQ(test::differing_values(image_of(renderer), alone(backend, 0)), 0U)
            << test::backend_name(backend);
        renderer.set_camera(camera_at_image(1));
        EXPECT_EQ(test::differing_values(image_of(renderer), alone(backend, 1)), 0U)
            << test::backend_name(backend);
    }
}

TEST(LevelMemory, ASequenceIsTheSameEachTime) {
    std::vector<Image> first;
    for (int run = 0; run < 2; ++run) {
        Renderer renderer(test::shared_executor(TestBackend::own_bvh), room_with_ball(),
                          camera_at_image(0), settings());
        for (int number = 0; number < 4; ++number) {
            if (number > 0) renderer.move_camera(camera_at_image(number));
            const Image image = image_of(renderer);
            if (run == 0) {
                first.push_back(image);
            } else {
                EXPECT_EQ(test::differing_values(image, first[static_cast<std::size_t>(number)]),
                          0U)
                    << number;
            }
        }
    }
}

TEST(LevelMemory, AStillCameraChangesNothing) {
    const Image expected = alone(TestBackend::own_bvh, 0);
    Renderer renderer(test::shared_executor(TestBackend::own_bvh), room_with_ball(),
                      camera_at_image(0), settings());
    for (int image = 0; image < 7; ++image) {
        if (image > 0) renderer.move_camera(camera_at_image(0));
        EXPECT_EQ(test::differing_values(image_of(renderer), expected), 0U) << image;
    }
}

TEST(LevelMemory, FramesOfOneImageHoldNothing) {
    // set_camera after each would begin a sequence; without it frames add up as they always did.
    const Image expected = alone(TestBackend::own_bvh, 0, 3);
    Renderer renderer(test::shared_executor(TestBackend::own_bvh), room_with_ball(),
                      camera_at_image(0), settings());
    image_of(renderer, 2);
    renderer.set_camera(camera_at_image(0));
    EXPECT_EQ(test::differing_values(image_of(renderer, 3), expected), 0U);
    const std::vector<FrameStats>& stats = renderer.stats();
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t c = 0; c < stats[i].levels.size(); ++c)
            EXPECT_EQ(stats[i].levels[c].tiles, stats[2 + i].levels[c].tiles) << i;
}

/// Tiles whose level falls from one image to the next, over a sequence.
std::size_t falls(const char* component, bool with_memory) {
    RenderSettings larger = settings();
    larger.width = 160;
    larger.height = 128;
    Renderer renderer(test::shared_executor(TestBackend::embree), room_with_ball(),
                      camera_at_image(0), larger);
    std::vector<float> before;
    std::size_t count = 0;
    for (int number = 0; number < 24; ++number) {
        const Camera camera = camera_at_image(number);
        if (with_memory && number > 0) renderer.move_camera(camera);
        if (!with_memory) renderer.set_camera(camera);
        const Image image = image_of(renderer);
        const std::vector<float>& now = levels(image, component);
        for (std::uint32_t y = 0; y < image.height; y += TILE_EDGE)
            for (std::uint32_t x = 0; x < image.width; x += TILE_EDGE) {
                const std::size_t pixel = std::size_t{y} * image.width + x;
                if (!before.empty() && now[pixel] < before[pixel]) ++count;
            }
        before = now;
    }
    return count;
}

TEST(LevelMemory, LevelsFallLessOften) {
    const std::size_t without = falls("indirect", false);
    const std::size_t with = falls("indirect", true);
    RecordProperty("falls_without", static_cast<int>(without));
    RecordProperty("falls_with", static_cast<int>(with));
    EXPECT_GT(without, 20U) << "nothing to keep steady";
    EXPECT_LT(2 * with, without);
}

}  // namespace
}  // namespace weft::level_memory_test
