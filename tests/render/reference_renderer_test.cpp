// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/reference_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/error.h"
#include "tests/testing/bvh_meshes.h"
#include "tests/testing/furnished_room.h"
#include "tests/testing/path_fixture.h"

// References by virtual lights and paths: the light of path tracing, a variance that is that of
// their images, and the same bits in parts and everywhere.
namespace weft::reference_renderer_test {
namespace {

using test::SceneBuilder;
using test::TestBackend;

// Two regions that make lists of VPLs, one of them short.
constexpr std::uint32_t width = 40;
constexpr std::uint32_t height = 30;

/// A room with every kind of light, a textured screen, a smooth ball, and a panel close to a wall,
/// so that both bounds cut much off.
const FlatScene& room() {
    static const FlatScene flat = [] {
        SceneBuilder builder;
        test::furnish(builder);
        const std::uint32_t white = builder.material({0.7F, 0.7F, 0.6F});
        builder.add(test::quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 4), white);
        builder.add(test::quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}, 2), white);
        builder.add(test::quad_mesh({1, -1, -1}, {0, 0, 2}, {0, 2, 0}, 2), white);
        builder.add(test::quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, 2), white);
        builder.add(test::quad_mesh({0.2F, -0.5F, -0.95F}, {0.5F, 0, 0}, {0, 0.6F, 0}),
                    builder.material({0.3F, 0.3F, 0.3F}, {6.0F, 5.0F, 4.0F}));
        builder.light(LightType::directional, {}, {0.5F, 0.5F, 0.7F}, {-0.1, -0.2, -1.0});
        validate_scene(builder.scene);
        return flatten(builder.scene);
    }();
    return flat;
}

Camera camera() {
    return test::look_at({0.35, 0.1, 2.6}, {0.0, -0.05, 0.0}, 0.8);
}

PathSettings settings_of(SampleRange range, std::uint32_t seed = 0) {
    PathSettings settings = test::path_settings(width, height, 1, seed);
    settings.algorithm = Algorithm::reference;
    settings.samples = range;
    return settings;
}

/// The renderer itself, whatever would be chosen for the room, which is open to one side.
std::unique_ptr<ExactRenderer> renderer_of(Executor& executor, const PathSettings& settings,
                                           FilmSums before = {}) {
    const auto buffers = std::make_shared<SceneBuffers>(upload_scene(executor, room()));
    if (settings.algorithm == Algorithm::path)
        return make_exact_renderer(executor, room(), buffers, camera(), settings,
                                   std::move(before));
    auto renderer =
        std::make_unique<ReferenceRenderer>(executor, room(), buffers, camera(), settings);
    renderer->begin(std::move(before));
    return renderer;
}

FilmSums render(Executor& executor, const PathSettings& settings, FilmSums before = {}) {
    const auto renderer = renderer_of(executor, settings, std::move(before));
    while (renderer->render_frame({})) continue;
    for (const FrameStats& frame : renderer->stats())
        for (const NonfiniteStats& found : frame.nonfinite) EXPECT_EQ(found.count, 0U);
    return renderer->sums();
}

FilmSums render(SampleRange range, FilmSums before = {}) {
    return render(test::shared_executor(TestBackend::own_bvh), settings_of(range),
                  std::move(before));
}

TEST(ReferenceRenderer, IsChosenInRooms) {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.6F, 0.5F, 0.4F}));
    builder.add(test::quad_mesh({-0.3F, 0.98F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material({0.3F, 0.3F, 0.3F}, {12.0F, 10.0F, 8.0F}));
    validate_scene(builder.scene);
    const FlatScene flat = flatten(builder.scene);
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const auto renderer = make_exact_renderer(
        executor, flat, std::make_shared<SceneBuffers>(upload_scene(executor, flat)),
        test::look_at({0.0, 0.0, 0.9}, {0.0, 0.0, -1.0}, 1.2), settings_of({0, 1}), {});
    EXPECT_GT(renderer->plan().choices, 0U);
    EXPECT_TRUE(renderer->plan().compensation);
    EXPECT_EQ(renderer->plan().filter_radius, 0U);
}

TEST(ReferenceRenderer, LeavesOpenScenesToPaths) {
    SceneBuilder builder;
    builder.add(test::quad_mesh({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}),
                builder.material({0.6F, 0.5F, 0.4F}));
    builder.scene.environment = Environment{glm::vec3(0.5F)};
    builder.light(LightType::directional, {}, glm::vec3(2.0F), {0.4, -1.0, -0.3});
    validate_scene(builder.scene);
    const FlatScene flat = flatten(builder.scene);
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const auto renderer = make_exact_renderer(
        executor, flat, std::make_shared<SceneBuffers>(upload_scene(executor, flat)),
        test::look_at({0.0, 2.0, 5.0}, {0.0, 0.6, 0.0}, 0.8), settings_of({0, 2}), {});
    while (renderer->render_frame({})) continue;
    for (const FrameStats& frame : renderer->stats())
        for (const StageStats& stage : frame.stages) EXPECT_EQ(stage.stage, Stage::paths);
}

TEST(ReferenceRenderer, HasTheLightOfPathTracing) {
    // Every pixel and channel of both layers, by the standard errors that both images state; of the
    // reference they are those of 512 independent samples. Pixels share virtual lights, which
    // makes a failure of several at once likelier, but not that of any one.
    PathSettings paths = settings_of({0, 4096}, 5);
    paths.algorithm = Algorithm::path;
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    for (const bool indirect : {false, true}) {
        PathSettings own = settings_of({0, 512}, 7);
        own.indirect = paths.indirect = indirect;
        own.direct = paths.direct = !indirect;
        const Image a = resolve_sums(render(executor, own));
        const Image b = resolve_sums(render(executor, paths));
        const std::vector<float>& mean_a = a.find("")->values;
        const std::vector<float>& mean_b = b.find("")->values;
        const std::vector<float>& variance_a = a.find("variance")->values;
        const std::vector<float>& variance_b = b.find("variance")->values;
        const double limit = test::sidak_limit(mean_a.size());
        double errors = 0.0;
        double sum = 0.0;
        for (std::size_t i = 0; i < mean_a.size(); ++i) {
            const auto mean = static_cast<double>(mean_b[i]);
            const double error =
                std::sqrt(static_cast<double>(variance_a[i]) + static_cast<double>(variance_b[i]));
            EXPECT_NEAR(static_cast<double>(mean_a[i]), mean, limit * error + 1e-5 * mean)
                << "value " << i << (indirect ? " indirect" : " direct");
            errors += error;
            sum += mean;
        }
        // Otherwise anything would pass.
        EXPECT_LE(errors, 0.05 * sum) << (indirect ? "indirect" : "direct");
    }
}

TEST(ReferenceRenderer, StatesTheVarianceOfItsImages) {
    // Of 64 images of 8 samples: the variance of their pixels over the mean of what they state.
    // Each pixel tells it within 18 %, and those of an image share virtual lights.
    constexpr std::uint32_t images = 64;
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    std::vector<double> sum(std::size_t{3} * width * height);
    std::vector<double> squares(sum.size());
    double stated = 0.0;
    for (std::uint32_t seed = 0; seed < images; ++seed) {
        const Image image = resolve_sums(render(executor, settings_of({0, 8}, seed)));
        const std::vector<float>& values = image.find("")->values;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const auto value = static_cast<double>(values[i]);
            sum[i] += value;
            squares[i] += value * value;
            stated += static_cast<double>(image.find("variance")->values[i]) / images;
        }
    }
    double variance = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i)
        variance += (squares[i] - sum[i] * sum[i] / images) / (images - 1);
    EXPECT_NEAR(variance / stated, 1.0, 0.25);
}

TEST(ReferenceRenderer, PartsEqualTheWhole) {
    const FilmSums whole = render({0, 12});
    test::expect_same_sums(render({5, 12}, render({0, 5})), whole);
    FilmSums sum = render({7, 12});
    add_sums(sum, render({0, 3}));
    add_sums(sum, render({3, 7}));
    test::expect_same_sums(sum, whole);
    EXPECT_THROW((void)render({12, 14},
                              [] {
                                  PathSettings other = settings_of({0, 12}, 1);
                                  return render(test::shared_executor(TestBackend::own_bvh), other);
                              }()),
                 Error);
    PathSettings paths = settings_of({0, 12});
    paths.algorithm = Algorithm::path;
    EXPECT_THROW((void)render({12, 14}, render(test::shared_executor(TestBackend::own_bvh), paths)),
                 Error);
}

TEST(ReferenceRenderer, FramesEndedByTheUserAreWhole) {
    const auto renderer =
        renderer_of(test::shared_executor(TestBackend::own_bvh), settings_of({0, 4}));
    EXPECT_FALSE(renderer->render_frame([](Stage, double) { return false; }));
    EXPECT_EQ(renderer->samples(), 1U);
    test::expect_same_sums(render({1, 4}, renderer->sums()), render({0, 4}));
}

TEST(ReferenceRenderer, AnotherCameraBeginsAnew) {
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const auto renderer = renderer_of(executor, settings_of({0, 2}));
    renderer->set_camera(test::look_at({0.0, 0.2, 2.0}, {0.0, 0.0, 0.0}, 0.9));
    while (renderer->render_frame({})) continue;
    renderer->set_camera(camera());
    EXPECT_EQ(renderer->samples_left(), 2U);
    while (renderer->render_frame({})) continue;
    test::expect_same_sums(renderer->sums(), render({0, 2}));
}

TEST(ReferenceRenderer, ThreadsAndTheWidthOfPacketsDoNotMatter) {
    const FilmSums expected = render({3, 6});
    for (const std::uint32_t lanes : {1U, 4U, 8U, 16U}) {
        SCOPED_TRACE(lanes);
        test::expect_same_sums(
            render(*test::make_executor(TestBackend::own_bvh, lanes), settings_of({3, 6})),
            expected);
    }
    // OpenCL has the widths of packets from the same sources, and takes seconds to compile each.
    if (test::has_opencl())
        test::expect_same_sums(
            render(test::shared_executor(TestBackend::opencl), settings_of({3, 6})), expected);
    test::expect_same_sums(
        render(*test::make_executor(TestBackend::own_bvh, 0, 1), settings_of({3, 6})), expected);
}

}  // namespace
}  // namespace weft::reference_renderer_test
