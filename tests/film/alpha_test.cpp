// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.h"
#include "film/film_sums_file.h"
#include "image/background.h"
#include "tests/testing/half_plane.h"
#include "tests/testing/media_builder.h"
#include "tests/testing/path_fixture.h"

// Alpha of beauty: where nothing is hit, at edges, and through media.
namespace weft::alpha_test {
namespace {

using test::coverage;
using test::front_camera;
using test::half_plane;
using test::Line;
using test::line_at;
using test::TestBackend;

constexpr std::uint32_t width = 64;
constexpr std::uint32_t height = 48;

/// A lamp on one side of a line, before an environment of radiance 0.25 or before nothing.
Scene lit_half(const Line& line, bool environment) {
    test::SceneBuilder builder;
    builder.add(half_plane(line, 0.0, width, height),
                builder.material({0.5F, 0.5F, 0.5F}, {2.0F, 2.0F, 2.0F}));
    if (environment) builder.scene.environment = Environment{glm::vec3(0.25F)};
    return builder.scene;
}

struct AlphaError {
    double mean = 0.0;   // over pixels that the line crosses
    double worst = 0.0;  // of all others
    double share = 0.0;  // largest difference of beauty from alpha times what the surface sends
};

AlphaError alpha_error(const Image& image, const Line& line) {
    const std::span<const float> alpha = alpha_of(image);
    const std::vector<float>& beauty = image.find("")->values;
    AlphaError error;
    double crossed = 0.0;
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const double exact = coverage(line, x, y);
            const auto found = static_cast<double>(alpha[y * width + x]);
            if (exact <= 1e-6 || exact >= 1.0 - 1e-6) {
                error.worst = std::max(error.worst, std::abs(found - std::round(exact)));
            } else {
                error.mean += found - exact;
                crossed += 1.0;
            }
            // The lamp's 2, and at most 0.125 that it reflects of the environment.
            const auto light = static_cast<double>(beauty[y * width + x]);
            const double most = found * 2.2;
            const double least = found * 1.999;
            error.share = std::max({error.share, light - most, least - light});
        }
    error.mean /= crossed;
    return error;
}

TEST(Alpha, IsWhatSurfacesCoverAndBeautyIsPremultiplied) {
    for (const double degrees : {20.0, 213.0}) {
        const Line line = line_at(degrees, width, height);
        for (const TestBackend backend : test::backends()) {
            SCOPED_TRACE(test::backend_name(backend));
            RenderSettings settings = test::small_settings(Algorithm::ais, width, height);
            settings.hides_environment = true;
            const AlphaError ais = alpha_error(
                test::render(backend, lit_half(line, true), front_camera(), settings).image, line);
            EXPECT_EQ(ais.worst, 0.0);
            // Steps of a fifth, on some 70 pixels along a lattice.
            EXPECT_LT(std::abs(ais.mean), 0.03);
            EXPECT_LT(ais.share, 1e-4);
            PathSettings path;
            path.width = width;
            path.height = height;
            path.samples = {0, 64};
            path.hides_environment = true;
            const AlphaError traced = alpha_error(
                test::path_image(backend, lit_half(line, true), front_camera(), path).image, line);
            EXPECT_EQ(traced.worst, 0.0);
            // About 70 pixels of 64 samples: a standard error of at most 0.0075.
            EXPECT_LT(std::abs(traced.mean), 5.0 * 0.0075);
            EXPECT_LT(traced.share, 1e-4);
        }
    }
}

TEST(Alpha, OneWhereTheEnvironmentIsSeenAndColoursStay) {
    const Line line = line_at(33.0, width, height);
    for (const Algorithm algorithm : {Algorithm::ais, Algorithm::igi}) {
        RenderSettings settings = test::small_settings(algorithm, width, height);
        const auto made = [&](bool environment) {
            return test::render(TestBackend::own_bvh, lit_half(line, environment), front_camera(),
                                settings)
                .image;
        };
        const Image seen = made(true);
        for (const float a : alpha_of(seen)) ASSERT_EQ(a, 1.0F);
        EXPECT_EQ(seen.find("")->values[(height - 1) * width], 0.25F);
        settings.hides_environment = true;
        const Image hidden = made(true);
        std::size_t covered = 0;
        for (std::size_t i = 0; i < alpha_of(seen).size(); ++i) {
            if (alpha_of(hidden)[i] < 1.0F) continue;
            ++covered;
            ASSERT_EQ(hidden.find("")->values[i], seen.find("")->values[i]) << "lit as before";
        }
        EXPECT_GT(covered, alpha_of(seen).size() / 4);
        // Without an environment nothing has to be asked for.
        settings.hides_environment = false;
        const Image bare = made(false);
        EXPECT_TRUE(std::ranges::equal(alpha_of(bare), alpha_of(hidden)));
    }
}

TEST(Alpha, AbsorbingMediaHideAsMuchAsTheyAbsorb) {
    // A slab between the camera and nothing: alpha is 1 - exp(-depth), the mean over channels.
    test::SceneBuilder builder;
    builder.add(test::quad_mesh({-50, -50, -30}, {0.1F, 0, 0}, {0, 0.1F, 0}),
                builder.material({0.5F, 0.5F, 0.5F}));
    builder.light(LightType::point, {0, 0, 9}, {1.0F, 1.0F, 1.0F});
    const glm::vec3 sigma(0.2F, 0.5F, 0.9F);
    builder.scene.media.push_back(test::medium_of(sigma, glm::vec3(0.0F)));
    test::add_boundary(builder.scene, test::cube_mesh(), glm::dmat4(1.0), 0);
    const Camera camera = test::look_at({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 0.01);
    double expected = 1.0;
    for (int c = 0; c < 3; ++c) expected -= std::exp(-2.0 * sigma[c]) / 3.0;
    for (const TestBackend backend : test::backends()) {
        const Image preview =
            test::render(backend, builder.scene, camera, test::small_settings(Algorithm::ais, 8, 8))
                .image;
        for (const float a : alpha_of(preview)) ASSERT_NEAR(a, expected, 1e-4);
        PathSettings path;
        path.width = 8;
        path.height = 8;
        path.samples = {0, 2};
        const Image traced = test::path_image(backend, builder.scene, camera, path).image;
        for (const float a : alpha_of(traced)) ASSERT_NEAR(a, expected, 1e-4);
    }
}

TEST(Alpha, ScatteringMediaHideWhatDoesNotPassThem) {
    test::SceneBuilder builder;
    builder.add(test::quad_mesh({-50, -50, -30}, {0.1F, 0, 0}, {0, 0.1F, 0}),
                builder.material({0.5F, 0.5F, 0.5F}));
    builder.light(LightType::point, {0, 0, 9}, {1.0F, 1.0F, 1.0F});
    builder.scene.media.push_back(test::medium_of(glm::vec3(0.4F), glm::vec3(0.8F)));
    test::add_boundary(builder.scene, test::cube_mesh(), glm::dmat4(1.0), 0);
    const Camera camera = test::look_at({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 0.01);
    PathSettings path;
    path.width = 16;
    path.height = 16;
    path.samples = {0, 64};
    const Image traced = test::path_image(TestBackend::own_bvh, builder.scene, camera, path).image;
    double mean = 0.0;
    for (const float a : alpha_of(traced)) mean += static_cast<double>(a) / 256.0;
    // 16384 samples of 0 or 1: five standard errors of at most 0.0039.
    EXPECT_NEAR(mean, 1.0 - std::exp(-0.8), 5.0 * 0.0039);
    const Image preview = test::render(TestBackend::own_bvh, builder.scene, camera,
                                       test::small_settings(Algorithm::ais, 8, 8))
                              .image;
    for (const float a : alpha_of(preview)) ASSERT_NEAR(a, 1.0 - std::exp(-0.8), 1e-4);
}

TEST(Alpha, SumsInPartsKeepIt) {
    const Line line = line_at(71.0, width, height);
    const Scene scene = lit_half(line, true);
    const FlatScene flat = flatten(scene);
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    PathSettings path;
    path.width = width;
    path.height = height;
    path.hides_environment = true;
    path.samples = {0, 8};
    const FilmSums all = test::path_sums(executor, flat, front_camera(), path);
    path.samples = {0, 3};
    FilmSums parts = test::path_sums(executor, flat, front_camera(), path);
    path.samples = {3, 8};
    add_sums(parts, test::path_sums(executor, flat, front_camera(), path));
    EXPECT_TRUE(std::ranges::equal(alpha_of(resolve_sums(all)), alpha_of(resolve_sums(parts))));
    // And through a file.
    Image image = resolve_sums(all);
    attach_sums(all, image);
    EXPECT_EQ(sums_of(image, "a.exr").words, all.words);
    // An image that shows the environment is another image.
    path.hides_environment = false;
    EXPECT_THROW(add_sums(parts, test::path_sums(executor, flat, front_camera(), path)), Error);
}

}  // namespace
}  // namespace weft::alpha_test
