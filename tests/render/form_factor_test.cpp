// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "tests/testing/closed_forms.h"
#include "tests/testing/render_fixture.h"

// Form factors of unit squares (Howell's catalogue, C-11 and C-14) by light samples: a square of
// radiance 1 lights another one that fills the image, so that the mean irradiance over pi is the
// form factor. A camera halfway sees the pixels' centres as a uniform grid on the square.
//
// The mean over pixels is compared with Lambert's formula at those very points, from 16 seeds by
// Student's t with 15 degrees of freedom at 5 standard errors: a correct renderer fails one such
// comparison in 6,000, and seeds are fixed. What the grid leaves of the integral is a second,
// deterministic comparison. Images do not depend on the packet width (backend_agreement_test).
namespace weft::form_factor_test {
namespace {

using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;
constexpr double parallel_form_factor = 0.1998248957;
constexpr double perpendicular_form_factor = 0.2000437761;
constexpr std::uint32_t pixels = 32;
constexpr std::uint32_t seeds = 16;

/// The receiver is the square [0, 1]^2 in z = 0, which faces up.
struct Setup {
    Mesh area_light;
    std::vector<glm::dvec3> corners;  // of the area light
};

Setup parallel() {
    return {test::quad_mesh({0, 0, 1}, {0, 1, 0}, {1, 0, 0}),
            {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}};
}

Setup perpendicular() {
    return {test::quad_mesh({0, 0, 0}, {0, 1, 0}, {0, 0, 1}),
            {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}};
}

double centre(std::uint32_t pixel, std::uint32_t count) {
    return (pixel + 0.5) / count;
}

/// Mean irradiance over pi at the centres of a grid of count x count cells.
double grid_form_factor(const Setup& setup, std::uint32_t count) {
    double sum = 0.0;
    for (std::uint32_t y = 0; y < count; ++y)
        for (std::uint32_t x = 0; x < count; ++x)
            sum += test::polygon_irradiance(setup.corners, {centre(x, count), centre(y, count), 0},
                                            {0, 0, 1});
    return sum / (pi * count * count);
}

double rendered_form_factor(Executor& executor, const FlatScene& flat, std::uint32_t seed) {
    RenderSettings settings = test::unbounded(test::small_settings(Algorithm::ir, pixels, pixels));
    settings.sampling.samples_per_light = 1024;
    settings.sampling.max_samples_per_set = 1024;
    settings.indirect = false;
    settings.seed = seed;
    const test::Rendering rendering = test::render_flat(
        executor, flat, test::look_at({0.5, 0.5, 0.5}, {0.5, 0.5, 0.0}, pi / 2.0), settings);
    test::expect_clean(rendering);
    double sum = 0.0;
    for (std::uint32_t y = 0; y < pixels; ++y)
        for (std::uint32_t x = 0; x < pixels; ++x) sum += rendering.irradiance("direct", x, y);
    return sum / (pi * pixels * pixels);
}

void expect_form_factor(Executor& executor, const Setup& setup) {
    SceneBuilder builder;
    builder.add(test::quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                builder.material(glm::vec3(1.0F)));
    builder.add(setup.area_light, builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
    validate_scene(builder.scene);
    const FlatScene flat = flatten(builder.scene);
    std::vector<double> values;
    for (std::uint32_t seed = 0; seed < seeds; ++seed)
        values.push_back(rendered_form_factor(executor, flat, seed));
    const auto [mean, error] = test::estimate(values);
    const double expected = grid_form_factor(setup, pixels);
    EXPECT_LE(error, 2e-3 * expected);  // or the next line would accept anything
    EXPECT_NEAR(mean, expected, 5.0 * error + 2e-6 * expected);
}

TEST(FormFactor, ParallelSquares) {
    for (const TestBackend backend : test::light_backends())
        expect_form_factor(test::shared_executor(backend), parallel());
}

TEST(FormFactor, PerpendicularSquaresWithACommonEdge) {
    for (const TestBackend backend : test::light_backends())
        expect_form_factor(test::shared_executor(backend), perpendicular());
}

// The midpoint rule is off by O(1/n^2) for a smooth integrand, and by O(log n / n^2) beside the
// edge where the irradiance jumps; both are far below these bounds at n = 256.
TEST(FormFactor, LambertsFormulaIntegratesToThePublishedValues) {
    const double across = grid_form_factor(parallel(), 256);
    const double beside = grid_form_factor(perpendicular(), 256);
    EXPECT_NEAR(across, parallel_form_factor, 1e-6);
    EXPECT_NEAR(beside, perpendicular_form_factor, 1e-4);
    EXPECT_NEAR(parallel_form_factor + 4.0 * perpendicular_form_factor, 1.0, 1e-9);
}

}  // namespace
}  // namespace weft::form_factor_test
