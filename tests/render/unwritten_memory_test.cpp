// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tests/testing/counting_executor.h"
#include "tests/testing/render_fixture.h"

// Nothing reads what nothing has written: buffers hold patterns of their own before their first
// use, and neither whole frames nor frames that end early know them.
namespace weft::unwritten_memory_test {
namespace {

using test::TestBackend;

/// An executor whose buffers are full of one byte at first, and whose launches are quarters.
class PatternedExecutor : public test::CountingExecutor {
  public:
    PatternedExecutor(std::unique_ptr<Executor> inner, std::byte pattern)
        : CountingExecutor(std::move(inner)), pattern_(pattern) {}

    [[nodiscard]] std::unique_ptr<Buffer> allocate(std::size_t bytes,
                                                   std::string_view what) override {
        std::unique_ptr<Buffer> buffer = CountingExecutor::allocate(bytes, what);
        with_mapped(*buffer, Access::write,
                    [&](std::span<std::byte> all) { std::fill(all.begin(), all.end(), pattern_); });
        return buffer;
    }
    bool run(const Launch& launch, const std::function<bool(double done)>& keep_going) override {
        return test::run_in_quarters(inner(), launch, keep_going);
    }

  private:
    std::byte pattern_;
};

// Zero; a large number as float and as index; a NaN.
constexpr std::byte patterns[] = {std::byte{0x00}, std::byte{0x47}, std::byte{0xFF}};

FlatScene lit_room() {
    test::SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.7F, 0.6F, 0.5F}));
    builder.add(test::quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0, 0}, {0, 0, 0.4F}),
                builder.material(glm::vec3(0.5F), {8.0F, 9.0F, 7.0F}));
    builder.add(test::icosphere(2, false), builder.material({0.4F, 0.5F, 0.8F}),
                test::placement(0.3, {-0.2, -0.5, -0.3}));
    return flatten(builder.scene);
}

Camera camera() {
    return test::look_at({0.2, 0.2, 0.9}, {-0.1, -0.2, 0.0}, 1.2);
}

RenderSettings settings(Algorithm algorithm) {
    RenderSettings small = test::small_settings(algorithm, 45, 38);
    small.sampling.vpls_per_set = 8;
    small.sampling.threshold = 2.0;
    return small;
}

std::string named(TestBackend backend, Algorithm algorithm, std::byte pattern) {
    return std::string(test::backend_name(backend)) + ", algorithm " +
           std::to_string(static_cast<int>(algorithm)) + ", pattern " +
           std::to_string(std::to_integer<int>(pattern));
}

TEST(UnwrittenMemory, WholeFramesDoNotKnowIt) {
    const FlatScene scene = lit_room();
    for (const TestBackend backend : test::backends())
        for (const Algorithm algorithm :
             {Algorithm::ais, Algorithm::amax, Algorithm::igi, Algorithm::path}) {
            const test::Rendering expected = test::render_flat(
                test::shared_executor(backend), scene, camera(), settings(algorithm), 2);
            for (const std::byte pattern : patterns) {
                PatternedExecutor executor(test::make_executor(backend), pattern);
                const test::Rendering other =
                    test::render_flat(executor, scene, camera(), settings(algorithm), 2);
                EXPECT_EQ(test::differing_values(expected.image, other.image), 0U)
                    << named(backend, algorithm, pattern);
            }
        }
}

/// The image of a frame that goes on for `calls` times.
Image interrupted(Executor& executor, const FlatScene& scene, const RenderSettings& how, int calls,
                  bool& complete) {
    Renderer renderer(executor, scene, camera(), how);
    complete = renderer.render_frame([&](Stage, double) { return calls-- > 0; });
    return renderer.image();
}

TEST(UnwrittenMemory, FramesThatEndAnywhereDoNotKnowIt) {
    const FlatScene scene = lit_room();
    RenderSettings small = settings(Algorithm::ais);
    // Large enough for tiles of one surface, whose samples are found without asking for each.
    RenderSettings large = small;
    large.width = 104;
    large.height = 96;
    for (const RenderSettings& how : {small, large})
        for (const TestBackend backend : {TestBackend::own_bvh, TestBackend::embree}) {
            const std::string where = std::string(test::backend_name(backend)) + ", " +
                                      std::to_string(how.width) + " pixels wide";
            bool complete = false;
            int ends = 0;
            for (; !complete; ++ends) {
                ASSERT_LT(ends, 1000) << "a frame asks less often";
                Image images[std::size(patterns)];
                for (std::size_t i = 0; i < std::size(patterns); ++i) {
                    PatternedExecutor executor(test::make_executor(backend), patterns[i]);
                    images[i] = interrupted(executor, scene, how, ends, complete);
                }
                for (const Image& image : images)
                    ASSERT_EQ(test::differing_values(images[0], image), 0U)
                        << where << ", after " << ends << " calls";
            }
            EXPECT_GT(ends, 5) << where;
        }
}

}  // namespace
}  // namespace weft::unwritten_memory_test
