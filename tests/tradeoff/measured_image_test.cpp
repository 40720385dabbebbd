// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/measured_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "plan/algorithm.h"
#include "tests/testing/closed_forms.h"
#include "tests/testing/render_fixture.h"
#include "tradeoff/error_values.h"
#include "tradeoff/measure_points.h"

namespace weft::measured_image_test {
namespace {

using test::SceneBuilder;
using test::TestBackend;

constexpr FilmSize size{24, 16};

/// An image of one value.
Image constant_image(float value) {
    Layer layer{"", "RGB", std::vector<float>(std::size_t{3} * size.width * size.height, value)};
    return {.width = size.width, .height = size.height, .layers = {layer}, .metadata = {}};
}

double error_of(const std::vector<double>& errors, ErrorMeasure measure) {
    return errors.at(static_cast<std::size_t>(measure));
}

/// A scene, and what measures its images.
class Setting {
  public:
    Setting(const Scene& scene, const Camera& camera) : flat_(flatten(scene)), camera_(camera) {}

    [[nodiscard]] MeasuredImage make(const Preset& preset, std::uint32_t seed,
                                     bool first_alone = false,
                                     std::function<bool()> keep_going = {}) const {
        return measure_image({test::shared_executor(TestBackend::own_bvh), flat_, camera_, size,
                              std::move(keep_going), std::span(&denoiser_, 1)},
                             preset, seed, first_alone);
    }
    [[nodiscard]] const FlatScene& flat() const { return flat_; }
    [[nodiscard]] const Camera& camera() const { return camera_; }

  private:
    FlatScene flat_;
    Camera camera_;
    ImageDenoiser denoiser_{Denoiser::statistical};
};

/// A room with an area light: noise, shadows and light by way of walls.
Setting room() {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.6F)));
    builder.add(test::quad_mesh({-0.3F, 0.95F, 0.3F}, {0.6F, 0, 0}, {0, 0, -0.6F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    builder.add(test::quad_mesh({-0.3F, 0.95F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    return {builder.scene, test::look_at({0.1, 0.0, 0.9}, {0.0, -0.2, -1.0}, 0.9)};
}

/// The inside of a sphere that emits and reflects: radiance e / (1 - rho) wherever one looks.
constexpr float furnace_radiance = 2.0F;
Setting furnace() {
    SceneBuilder builder;
    builder.add(test::icosphere(2, true), builder.material(glm::vec3(0.5F), glm::vec3(1.0F)));
    return {builder.scene, test::look_at({0.1, 0.2, 0.3}, {0.0, 0.0, -1.0}, 0.9)};
}

/// Nothing but surroundings that are as bright everywhere: every image of it is exact.
constexpr float sky_radiance = 0.5F;
Setting sky() {
    SceneBuilder builder;
    builder.scene.environment = Environment{glm::vec3(sky_radiance)};
    return {builder.scene, test::look_at({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, 0.8)};
}

Preset preset_of(Algorithm algorithm, std::uint32_t samples) {
    Preset preset;
    preset.algorithm = algorithm;
    preset.samples = samples;
    return preset;
}

constexpr Algorithm some_algorithms[] = {Algorithm::ais, Algorithm::igi, Algorithm::path};

TEST(MeasuredImage, IsItsBeautyAloneAndWhatItTook) {
    const Setting setting = room();
    for (const Algorithm algorithm : some_algorithms) {
        const MeasuredImage made = setting.make(preset_of(algorithm, 3), 1);
        EXPECT_EQ(made.image.width, size.width);
        EXPECT_EQ(made.image.height, size.height);
        ASSERT_EQ(made.image.layers.size(), 1U);
        EXPECT_EQ(made.image.layers[0].name, "");
        EXPECT_EQ(made.image.layers[0].channels, "RGB");
        EXPECT_EQ(made.frames, 3U);
        EXPECT_GT(made.ms, 0.0);
        // A ray for each pixel and sample is the least that an image takes.
        EXPECT_GE(made.rays, std::uint64_t{3} * size.width * size.height);
    }
}

TEST(MeasuredImage, IsThatOfTheRendererWithTheSameSeed) {
    const Setting setting = room();
    for (const Algorithm algorithm : {Algorithm::ais, Algorithm::igi}) {
        const Preset preset = preset_of(algorithm, 2);
        RenderSettings settings;
        settings.algorithm = algorithm;
        settings.width = size.width;
        settings.height = size.height;
        settings.seed = 5;
        settings.samples = 2;
        Renderer renderer(test::shared_executor(TestBackend::own_bvh), setting.flat(),
                          setting.camera(), settings);
        while (renderer.samples() < 2) (void)renderer.render_frame({});
        const auto values = [&](std::uint32_t seed) {
            return setting.make(preset, seed).image.layers.at(0).values;
        };
        EXPECT_EQ(values(5), renderer.image().find("")->values);
        EXPECT_EQ(values(5), values(5));
        EXPECT_NE(values(5), values(6));
    }
    const Preset paths = preset_of(Algorithm::path, 2);
    EXPECT_EQ(setting.make(paths, 5).image.layers[0].values,
              setting.make(paths, 5).image.layers[0].values);
    EXPECT_NE(setting.make(paths, 5).image.layers[0].values,
              setting.make(paths, 6).image.layers[0].values);
}

TEST(MeasuredImage, IsDenoisedWhereThePresetSaysSo) {
    const Setting setting = room();
    Preset preset = preset_of(Algorithm::path, 8);
    const MeasuredImage noisy = setting.make(preset, 1);
    preset.denoiser = Denoiser::statistical;
    const MeasuredImage clean = setting.make(preset, 1);
    EXPECT_EQ(clean.rays, noisy.rays);
    ASSERT_EQ(clean.image.layers.size(), 1U);
    EXPECT_NE(clean.image.layers[0].values, noisy.image.layers[0].values);
    const Image reference = setting.make(preset_of(Algorithm::path, 4096), 2).image;
    const auto relmse = [&](const MeasuredImage& made) {
        return error_of(error_values(reference, made.image), ErrorMeasure::relmse);
    };
    EXPECT_LT(relmse(clean), 0.5 * relmse(noisy));
}

TEST(MeasuredImage, StopsAfterTheFirstFrameAndWhereItIsToldTo) {
    const Setting setting = room();
    const MeasuredImage first = setting.make(preset_of(Algorithm::ais, 3), 1, true);
    EXPECT_EQ(first.frames, 1U);
    EXPECT_LT(first.rays, setting.make(preset_of(Algorithm::ais, 3), 1).rays);
    for (const Algorithm algorithm : some_algorithms) {
        // Within some frame after the first.
        int asked = 0;
        const MeasuredImage ended = setting.make(preset_of(algorithm, 100000), 1, false,
                                                 [&asked] { return ++asked < 400; });
        EXPECT_GE(asked, 400);
        EXPECT_GE(ended.frames, 1U);
        EXPECT_LT(ended.frames, 100000U);
        for (const float value : ended.image.layers.at(0).values) ASSERT_TRUE(std::isfinite(value));
    }
}

TEST(MeasuredImage, ErrorsOfAnExactImageAreClosedForms) {
    const Setting setting = sky();
    for (const Algorithm algorithm : some_algorithms) {
        const Image image = setting.make(preset_of(algorithm, 2), 1).image;
        EXPECT_EQ(error_values(constant_image(sky_radiance), image),
                  std::vector<double>(error_measures, 0.0));
        for (const float ratio : {0.8F, 1.25F, 4.0F}) {
            const std::vector<double> errors =
                error_values(constant_image(ratio * sky_radiance), image);
            const double bias = 1.0 / double{ratio} - 1.0;
            // Values are floats, each within half a unit of 2^-24.
            EXPECT_NEAR(error_of(errors, ErrorMeasure::bias), std::abs(bias), 1e-6);
            EXPECT_NEAR(error_of(errors, ErrorMeasure::relmse), bias * bias / 1.01, 1e-6);
            EXPECT_GT(error_of(errors, ErrorMeasure::hdrflip), 0.0);
            EXPECT_LE(error_of(errors, ErrorMeasure::hdrflip), 1.0);
        }
    }
}

/// Measures `candidates` on a setting against a reference of one value.
std::vector<TradeoffPoint> measured(const Setting& setting,
                                    const std::vector<Candidate>& candidates,
                                    std::uint32_t repetitions, float reference) {
    const Image expected = constant_image(reference);
    const Measuring measuring{
        .make = [&](const Preset& preset, std::uint32_t seed,
                    bool first_alone) { return setting.make(preset, seed, first_alone); },
        .judge = [&](const Image& image) { return error_values(expected, image); },
        .report = [](double, const std::string&) {}};
    std::vector<std::string> skipped;
    // No time is too long, so that a slow machine tests the same.
    const MeasurePlan plan{.repetitions = repetitions, .seed = 100, .slow_ms = 1e9};
    std::vector<TradeoffPoint> points = measure_points(candidates, plan, measuring, skipped);
    EXPECT_TRUE(skipped.empty());
    return points;
}

TEST(MeasuredImage, WhatDoesNotScatterHasIntervalsWithoutWidth) {
    std::vector<Candidate> candidates;
    for (const Algorithm algorithm : some_algorithms)
        candidates.push_back({std::string(to_string(algorithm)), "", preset_of(algorithm, 1)});
    const auto points = measured(sky(), candidates, 3, 0.8F * sky_radiance);
    ASSERT_EQ(points.size(), candidates.size());
    for (const TradeoffPoint& point : points) {
        for (const Interval& error : point.errors) {
            EXPECT_LE(error.low, error.median);
            EXPECT_GE(error.high, error.median);
            // Rounding of sums of three logarithms.
            EXPECT_NEAR(error.high - error.low, 0.0, 1e-12 * error.median) << point.name;
        }
        EXPECT_NEAR(point.errors.at(static_cast<std::size_t>(ErrorMeasure::bias)).median, 0.25,
                    1e-6);
        EXPECT_LE(point.ms.low, point.ms.median);
        EXPECT_GE(point.ms.high, point.ms.median);
        EXPECT_GT(point.ms.low, 0.0);
    }
}

// Samples of a pixel are independent: sixteen times as many leave a sixteenth of the variance.
TEST(MeasuredImage, NoiseFallsAsSamplesRise) {
    constexpr std::uint32_t repetitions = 24;
    const auto points = measured(furnace(),
                                 {{"few", "path", preset_of(Algorithm::path, 4)},
                                  {"many", "path", preset_of(Algorithm::path, 64)}},
                                 repetitions, furnace_radiance);
    ASSERT_EQ(points.size(), 2U);
    const auto mean_relmse = [&](const std::string& name) {
        std::vector<double> values;
        for (const TradeoffPoint& point : points)
            if (point.name == name)
                for (const std::vector<double>& run : point.runs_errors)
                    values.push_back(error_of(run, ErrorMeasure::relmse));
        EXPECT_EQ(values.size(), repetitions);
        return test::estimate(values);
    };
    const test::Estimate few = mean_relmse("few");
    const test::Estimate many = mean_relmse("many");
    ASSERT_GT(many.mean, 0.0);
    const double difference = few.mean - 16.0 * many.mean;
    // By t of 23 degrees of freedom and more, with a fixed seed: one seed in ten thousand fails.
    const double limit = test::student_limit(repetitions, 1, 1e-4);
    EXPECT_LE(std::abs(difference), limit * std::hypot(few.error, 16.0 * many.error))
        << few.mean << " " << many.mean;
    // The limit above means something: an error of a fifth would be noticed.
    EXPECT_LT(limit * std::hypot(few.error, 16.0 * many.error), 0.2 * few.mean);
}

}  // namespace
}  // namespace weft::measured_image_test
