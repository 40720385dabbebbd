// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scene/flat_environment.h"
#include "selftest/chi_square.h"
#include "tests/testing/environment_images.h"

#define NATIVE_KERNELS "kernels/path/path_lights.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

// Images of the environment as kernels look them up and sample them, against a reference
// implementation that adds up the tents of all texels (tests/testing/environment_images.h). Means
// of 200,000 samples with fixed seeds; each may be off by 4.9 of its own standard errors, which one
// comparison of a million is, and by the rounding of floats. That devices compute the same bits is
// tested in environment_image_opencl_test.cpp.
namespace weft::environment_image_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int samples = 200'000;
constexpr double limit = 4.9;

/// An image as kernels get it.
struct NativeImage {
    FlatEnvironment flat;
    native::EnvironmentRecord record{};
    native::EnvironmentImage image{};

    explicit NativeImage(const EnvironmentImage& of, const glm::dmat3& to_world = glm::dmat3(1.0))
        : flat(flatten_environment(of, to_world)) {
        static_assert(sizeof(record) == sizeof(shared::EnvironmentRecord));
        std::memcpy(&record, flat.records.data(), sizeof(record));
        image = {&record, flat.texels.data(), flat.sums.data()};
    }
    NativeImage(const NativeImage&) = delete;
    NativeImage& operator=(const NativeImage&) = delete;

    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& direction) const {
        const native::float3 found = native::image_radiance(&image, single(direction));
        return {found.x, found.y, found.z};
    }
    [[nodiscard]] double pdf(const glm::dvec3& direction) const {
        return native::pdf_at_place(&image, native::image_place(&image, single(direction)));
    }
    static native::float3 single(const glm::dvec3& v) {
        const glm::vec3 f(v);
        return native::f3(f.x, f.y, f.z);
    }
};

glm::dvec3 wide(const native::float3& v) {
    return {v.x, v.y, v.z};
}

/// Small images with texels of all brightnesses, of even, odd and least sizes.
std::vector<EnvironmentImage> rough_images() {
    std::vector<EnvironmentImage> images;
    std::uint32_t state = 7;
    const auto value = [&](const glm::dvec3&) {
        glm::vec3 v;
        for (int c = 0; c < 3; ++c) {
            state = state * 1664525U + 1013904223U;
            v[c] = static_cast<float>(state >> 8) * 0x1p-24F;
        }
        return v;
    };
    for (const auto& [width, height] : {std::pair{1U, 1U}, std::pair{2U, 1U}, std::pair{3U, 2U},
                                        std::pair{5U, 4U}, std::pair{8U, 4U}, std::pair{16U, 7U}})
        for (const bool rows_at_poles : {false, true})
            if (!rows_at_poles || height > 1)
                images.push_back(test::image_of(width, height, rows_at_poles, value));
    return images;
}

TEST(EnvironmentImage, LooksUpTheTentsOfItsTexels) {
    for (const EnvironmentImage& image : rough_images()) {
        const NativeImage made(image);
        for (int i = 0; i < 2000; ++i) {
            const double u = std::fmod(0.5 + i * 0.754877666, 1.0);
            const double v = i < 8 ? i / 7.0 : std::fmod(0.5 + i * 0.569840291, 1.0);
            const glm::dvec3 direction = test::direction_at(u, v);
            // A camera's directions are of any length.
            const glm::dvec3 found = made.radiance(direction * (0.5 + u));
            const glm::dvec3 expected = test::radiance_from(image, direction);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(found[c], expected[c], 2e-5)
                    << image.width << " x " << image.height << " at " << u << ' ' << v;
        }
    }
}

TEST(EnvironmentImage, HasItsMiddleAtXAndItsTopAtY) {
    // u = 1/2 + atan2(z, x) / 2 pi: columns go from -x over -z, x and z.
    const auto seen = [](std::uint32_t column, std::uint32_t row, const glm::dvec3& direction,
                         const glm::dmat3& to_world = glm::dmat3(1.0)) {
        return NativeImage(test::one_texel(9, 5, column, row, glm::vec3(2.0F)), to_world)
            .radiance(direction)
            .x;
    };
    EXPECT_NEAR(seen(4, 2, {1, 0, 0}), 2.0, 1e-5);
    EXPECT_EQ(seen(4, 2, {-1, 0, 0}), 0.0);
    // The quarter from the middle to the right is +z: between the columns 6 and 7 of 9.
    EXPECT_NEAR(seen(6, 2, {0, 0, 1}) + seen(7, 2, {0, 0, 1}), 2.0, 1e-5);
    EXPECT_NEAR(seen(1, 2, {0, 0, -1}) + seen(2, 2, {0, 0, -1}), 2.0, 1e-5);
    // -x is the edge of the image, half of each side.
    EXPECT_NEAR(seen(0, 2, {-1, 0, 0}), 1.0, 1e-5);
    EXPECT_NEAR(seen(8, 2, {-1, 0, 0}), 1.0, 1e-5);
    EXPECT_NEAR(seen(4, 0, test::direction_at(0.5, 0.1)), 2.0, 1e-5);
    EXPECT_NEAR(seen(4, 4, test::direction_at(0.5, 0.9)), 2.0, 1e-5);
    // Turned by a quarter about +y, counter-clockwise seen from above: what was at x is at -z.
    const glm::dmat3 quarter{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    EXPECT_NEAR(seen(4, 2, {0, 0, -1}, quarter), 2.0, 1e-5);
    EXPECT_EQ(seen(4, 2, {1, 0, 0}, quarter), 0.0);
    // Mirrored.
    const glm::dmat3 mirror{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    EXPECT_NEAR(seen(6, 2, {0, 0, -1}, mirror) + seen(7, 2, {0, 0, -1}, mirror), 2.0, 1e-5);
}

TEST(EnvironmentImage, OverAPoleComesTheOtherSide) {
    // Near the pole each way across is smooth: the values a little to both sides of it are alike.
    const EnvironmentImage image = rough_images()[6];
    ASSERT_EQ(image.width, 8U);
    ASSERT_FALSE(image.rows_at_poles);
    const NativeImage made(image);
    for (const double u : {0.03, 0.2, 0.4})
        for (const double pole : {0.0, 1.0}) {
            const double step = pole == 0.0 ? 1e-4 : -1e-4;
            const double here = made.radiance(test::direction_at(u, pole + step)).x;
            const double across = made.radiance(test::direction_at(u + 0.5, pole + step)).x;
            EXPECT_NEAR(here, across, 2e-3) << u;
        }
}

std::vector<EnvironmentImage> bright_images() {
    std::vector<EnvironmentImage> images;
    images.push_back(test::constant_image({3.0F, 2.0F, 1.0F}));
    for (const bool rows_at_poles : {false, true})
        images.push_back(test::image_of(8, 5, rows_at_poles, [](const glm::dvec3& d) {
            return glm::vec3(3.0F, 2.0F, 1.0F) * static_cast<float>(1.0 + d.y);
        }));
    images.push_back(test::one_texel(8, 4, 5, 1, {3.0F, 2.0F, 1.0F}));
    images.push_back(test::one_texel(8, 4, 5, 0, {3.0F, 2.0F, 1.0F}));  // at the pole
    images.push_back(test::one_texel(7, 3, 6, 2, {3.0F, 2.0F, 1.0F}));
    images.push_back(test::sunny_sky());
    return images;
}

std::uint32_t steps_for(const EnvironmentImage& image) {
    return image.width > 16 ? 4 : 32;
}

TEST(EnvironmentImage, ItsMeanIsTheIntegralOfItsRadiance) {
    for (const EnvironmentImage& image : bright_images()) {
        const glm::dvec3 expected =
            test::integral_over(
                image, [](const glm::dvec3&) { return 1.0; }, steps_for(image)) /
            (4.0 * pi);
        const FlatEnvironment flat = flatten_environment(image, glm::dmat3(1.0));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(flat.mean[c], expected[c], 2e-4 * expected[c]);
    }
    // In closed form: of a constant, and of one row of a linear image's three, whose tent reaches
    // from pole to pole: half the integral of (1 - |2 v - 1|) sin(pi v) pi dv = 2 / pi.
    const FlatEnvironment constant =
        flatten_environment(test::constant_image({3.0F, 2.0F, 1.0F}), glm::dmat3(1.0));
    EXPECT_NEAR(constant.mean.x, 3.0, 1e-12);
    EXPECT_NEAR(constant.mean.z, 1.0, 1e-12);
    EXPECT_EQ(constant.brightest, 3.0F);
    EXPECT_NEAR(glm::length(constant.trend), 0.0, 1e-12);
    const EnvironmentImage belt = test::image_of(6, 3, true, [](const glm::dvec3& d) {
        return glm::vec3(std::abs(d.y) < 0.5 ? 1.0F : 0.0F);
    });
    EXPECT_NEAR(flatten_environment(belt, glm::dmat3(1.0)).mean.x, 2.0 / pi, 1e-12);
}

TEST(EnvironmentImage, ProbabilitiesSumToOne) {
    for (const EnvironmentImage& image : bright_images()) {
        const NativeImage made(image);
        const native::EnvironmentRecord& record = made.record;
        double sum = 0.0;
        for (std::uint32_t row = 0; row < record.rows; ++row)
            for (std::uint32_t column = 0; column < record.columns; ++column) {
                const double height = 1.0 - 2.0 * (row + 0.5) / record.rows;
                const double turn = 2.0 * pi * ((column + 0.5) / record.columns - 0.5);
                const double across = std::sqrt(1.0 - height * height);
                sum += made.pdf({across * std::cos(turn), height, across * std::sin(turn)});
            }
        EXPECT_NEAR(sum * 4.0 * pi / (double(record.rows) * record.columns), 1.0, 1e-6);
    }
}

TEST(EnvironmentImage, AllThatShinesMayBeChosen) {
    std::vector<EnvironmentImage> images = bright_images();
    images.push_back(test::one_texel(701, 600, 350, 0, glm::vec3(1.0F)));
    images.push_back(test::one_texel(2048, 1024, 700, 400, glm::vec3(1.0F)));
    for (const EnvironmentImage& image : images) {
        const NativeImage made(image);
        int shining = 0;
        for (int i = 0; i < 100'000; ++i) {
            // All over the image, and about one of the texels.
            const double spread = i % 2 == 0 ? 1.0 : 4.0 / image.width;
            const bool wide_image = image.width > 100;
            const double u0 = wide_image ? (image.width == 701 ? 350.5 : 700.5) / image.width : 0.5;
            const double v0 = wide_image ? (image.width == 701 ? 0.5 : 400.5) / image.height : 0.5;
            const double u = u0 + spread * (std::fmod(i * 0.754877666, 1.0) - 0.5);
            const double v =
                std::clamp(v0 + spread * (std::fmod(i * 0.569840291, 1.0) - 0.5), 0.0, 1.0);
            const glm::dvec3 direction = test::direction_at(u, v);
            if (!(made.radiance(direction).x > 1e-4)) continue;
            ++shining;
            ASSERT_GT(made.pdf(direction), 0.0) << image.width << " at " << u << ' ' << v;
        }
        EXPECT_GT(shining, 100);
    }
}

TEST(EnvironmentImage, SamplesHaveTheirPdfAndRadiance) {
    for (const EnvironmentImage& image : bright_images()) {
        const NativeImage made(image, glm::dmat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0}));
        native::Random random = native::make_random(3, 4, 5);
        int elsewhere = 0;
        const double brightest =
            double(*std::max_element(image.radiance.begin(), image.radiance.end()));
        for (int i = 0; i < 20'000; ++i) {
            const float u = native::next_random(&random);
            const float v = native::next_random(&random);
            const native::EnvironmentSample sample = native::sample_image(&made.image, u, v);
            const glm::dvec3 direction = wide(sample.direction);
            ASSERT_NEAR(glm::length(direction), 1.0, 1e-6);
            ASSERT_GT(sample.pdf, 0.0F);
            // A direction has lost some of its place on the image to rounding: up to four units of
            // 2^-24 of either side. From texel to texel a channel changes by the brightest at most.
            const double texels = 4.0 * 0x1p-24 * (image.width + image.height);
            ASSERT_LT(glm::length(wide(sample.radiance) - made.radiance(direction)),
                      texels * std::sqrt(3.0) * brightest);
            const double pdf = made.pdf(direction);
            elsewhere += std::abs(pdf - double(sample.pdf)) > 1e-4 * double(sample.pdf) ? 1 : 0;
        }
        // On the edge of a cell rounding may take a direction into the next one.
        EXPECT_LE(elsewhere, 20) << image.width;
    }
}

TEST(EnvironmentImage, SamplesFallAsTheirPdfSays) {
    // Chi-square over 8192 bins of the sphere; the normal variable of a correct sampler exceeds 4.9
    // once in a million times.
    for (const EnvironmentImage& image :
         {test::constant_image({1.0F, 1.0F, 1.0F}), test::sunny_sky(),
          test::image_of(32, 16, false, [](const glm::dvec3& d) {
              return glm::vec3(static_cast<float>(1.1 + std::sin(3.0 * d.x) * d.y));
          })}) {
        const NativeImage made(image);
        constexpr std::size_t rows = selftest::Histogram::rows;
        constexpr std::size_t columns = selftest::Histogram::columns;
        // Bins of few points are put together.
        constexpr int points = 1'000'000;
        constexpr int finer = 8;
        std::vector<double> probabilities(1, 0.0);
        std::vector<std::size_t> bin_of(rows * columns, 0);
        for (std::size_t i = 0; i < rows * columns; ++i) {
            double probability = 0.0;
            for (int k = 0; k < finer * finer; ++k) {
                const double height =
                    1.0 - 2.0 * (double(i / columns) + (k / finer + 0.5) / finer) / rows;
                const double turn =
                    2.0 * pi * ((double(i % columns) + (k % finer + 0.5) / finer) / columns - 0.5);
                const double across = std::sqrt(1.0 - height * height);
                probability +=
                    made.pdf({across * std::cos(turn), height, across * std::sin(turn)}) * 4.0 *
                    pi / (double(rows * columns) * finer * finer);
            }
            if (probability * points < 20.0) {
                probabilities[0] += probability;
            } else {
                bin_of[i] = probabilities.size();
                probabilities.push_back(probability);
            }
        }
        if (probabilities[0] == 0.0) probabilities[0] = 1e-9;
        selftest::Histogram histogram(probabilities.size());
        native::Random random = native::make_random(6, 7, 8);
        for (int i = 0; i < points; ++i) {
            const float u = native::next_random(&random);
            const float v = native::next_random(&random);
            const glm::dvec3 d = wide(native::sample_image(&made.image, u, v).direction);
            const auto row = std::min(static_cast<std::size_t>((0.5 - 0.5 * d.y) * rows), rows - 1);
            const auto column =
                std::min(static_cast<std::size_t>(selftest::turn(d.x, d.z) * columns), columns - 1);
            histogram.add(bin_of[row * columns + column]);
        }
        EXPECT_LT(std::abs(histogram.normal(probabilities)), 4.9) << image.width;
    }
}

/// A mean with its standard error.
struct Mean {
    double value = 0.0;
    double error = 0.0;
};

Mean mean_of(const std::function<double(native::Random* random)>& sample) {
    native::Random random = native::make_random(21, 22, 23);
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < samples; ++i) {
        const double x = sample(&random);
        sum += x;
        squares += x * x;
    }
    const double mean = sum / samples;
    return {mean, std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples)};
}

/// `off` is what the expected value is off by, relative.
void expect_mean(const Mean& mean, double expected, double off, const std::string& what) {
    EXPECT_NEAR(mean.value, expected, limit * mean.error + off * expected) << what;
    EXPECT_LT(mean.error, 0.05 * expected) << what;
}

native::RenderParams image_params() {
    native::RenderParams params{};
    params.features = FEATURE_ENVIRONMENT | FEATURE_IMAGE_ENVIRONMENT;
    params.scene.extent = 2.0F;
    params.scene.bounding_sphere = native::f4(0, 0, 0, 2.0F);
    params.scene.environment = native::f4(2.0F, 2.0F, 2.0F, 0.0F);  // the factor of the image
    return params;
}

TEST(EnvironmentImage, LightsSurfacesAlikeByItsSamplesByScatteredRaysAndByBoth) {
    const native::RenderParams params = image_params();
    for (const EnvironmentImage& image : bright_images()) {
        const NativeImage made(image);
        for (const glm::dvec3& up :
             {glm::dvec3(0, 1, 0), glm::normalize(glm::dvec3(0.6, -0.3, 1))}) {
            const std::uint32_t steps = steps_for(image);
            const double expected = 2.0 * test::irradiance_by(image, up, steps).z;
            // The texel at one pole is none of the light of a floor below the other one.
            if (expected < 0.05) continue;
            native::LitPoint lit{};
            lit.normal = lit.shading = NativeImage::single(up);
            native::LightRecord light{};
            light.kind = EMITTER_ENVIRONMENT;
            const native::Geometry geometry{};
            const auto sampled = [&](native::Random* random) {
                const float u = native::next_random(random);
                const float v = native::next_random(random);
                return native::light_at_surface(&params, &geometry, light, nullptr, &made.image,
                                                &lit, lit.position, 0.5F, u, v);
            };
            // By radiance alone, that a ray by the cosine finds, times pi.
            const auto scattered = [&](native::Random* random, float* pdf, float* other) {
                const float u = native::next_random(random);
                const float v = native::next_random(random);
                const native::float3 local = native::cosine_direction(u, v);
                const native::float3 direction = native::to_world(local, lit.shading);
                *pdf = native::cosine_pdf(local.z);
                const native::float3 radiance =
                    native::environment_met(&params, &made.image, direction, other);
                *other *= 0.5F;
                return pi * double(radiance.z);
            };
            const std::string what = std::to_string(image.width) + " x " +
                                     std::to_string(image.height) + " up " + std::to_string(up.y);
            const double off = 3e-4;
            // The light is chosen with the probability 1/2, so that its samples count double.
            const Mean by_samples = mean_of([&](native::Random* random) {
                const native::LightSample sample = sampled(random);
                EXPECT_EQ(sample.distant, sample.pdf > 0.0F ? 1 : 0);
                return sample.pdf > 0.0F
                           ? 0.5 * double(sample.power.z) * double(sample.in.z) / double(sample.pdf)
                           : 0.0;
            });
            expect_mean(by_samples, expected, off, what + " by samples");
            const Mean by_rays = mean_of([&](native::Random* random) {
                float pdf, other;
                return scattered(random, &pdf, &other);
            });
            expect_mean(by_rays, expected, off, what + " by rays");
            const Mean by_both = mean_of([&](native::Random* random) {
                const native::LightSample sample = sampled(random);
                // As if it had been chosen always: half of the chance is another light's.
                const float chance = native::next_random(random);
                double sum = 0.0;
                if (sample.pdf > 0.0F && chance < 0.5F)
                    sum += double(
                        native::weighted_irradiance(&sample, native::cosine_pdf(sample.in.z)).z);
                float pdf, other;
                const double ray = scattered(random, &pdf, &other);
                return sum +
                       ray * double(other > 0.0F ? native::power_heuristic(pdf, other) : 1.0F);
            });
            expect_mean(by_both, expected, off, what + " by both");
        }
    }
}

TEST(EnvironmentImage, EmitsItsPower) {
    const native::RenderParams params = image_params();
    const native::Geometry geometry{};
    for (const EnvironmentImage& image : bright_images()) {
        const NativeImage made(image);
        native::LightRecord light{};
        light.kind = EMITTER_ENVIRONMENT;
        light.probability = 0.25F;
        light.power = params.scene.environment;
        // Into the disk of the scene's sphere, from all directions.
        const double expected = 4.0 * 2.0 * made.flat.mean.z * 4.0 * pi * pi * 4.0;
        expect_mean(mean_of([&](native::Random* random) {
                        native::EmissionNumbers numbers{};
                        numbers.u = native::next_random(random);
                        numbers.v = native::next_random(random);
                        numbers.s = native::next_random(random);
                        numbers.t = native::next_random(random);
                        const native::EmittedRay ray = native::emit_light(
                            &params, &geometry, light, nullptr, &made.image, &numbers);
                        // It travels away from where it shines.
                        const glm::dvec3 from = -wide(ray.direction);
                        EXPECT_EQ(ray.flux.z > 0.0F, made.radiance(from).z > 0.0);
                        return double(ray.flux.z);
                    }),
                    expected, 1e-4, std::to_string(image.width));
    }
}

TEST(EnvironmentImage, ShinesOnPlacesInMedia) {
    const native::RenderParams params = image_params();
    const native::Geometry geometry{};
    for (const EnvironmentImage& image : bright_images()) {
        const NativeImage made(image);
        native::LightRecord light{};
        light.kind = EMITTER_ENVIRONMENT;
        expect_mean(mean_of([&](native::Random* random) {
                        const float u = native::next_random(random);
                        const float v = native::next_random(random);
                        const native::ChosenPoint chosen = native::point_on_light(
                            &params, &geometry, light, nullptr, &made.image, 0.5F, u, v);
                        const native::PlaceLight found =
                            native::light_at_place(&params, &chosen, native::f3(1, 2, 3));
                        EXPECT_EQ(found.distance, RAY_INFINITY);
                        EXPECT_NEAR(double(found.pdf),
                                    0.5 * double(native::sample_image(&made.image, u, v).pdf),
                                    1e-6 * double(found.pdf));
                        return 0.5 * double(found.irradiance.z);
                    }),
                    2.0 * 4.0 * pi * made.flat.mean.z, 1e-4, std::to_string(image.width));
    }
}

}  // namespace
}  // namespace weft::environment_image_test
