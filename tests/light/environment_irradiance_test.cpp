// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/environment_irradiance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/testing/environment_images.h"
#include "tests/testing/render_fixture.h"

#define NATIVE_KERNELS "kernels/light/environment_image.h"
#define NATIVE_KERNELS_TOO "kernels/light/environment_irradiance.h"
#include "tests/testing/native_kernels.h"

// Irradiance by images of the environment, as previews look it up, against sums over all
// directions, and what previews make of it.
namespace weft::environment_irradiance_test {
namespace {

constexpr double pi = std::numbers::pi;

/// An image as kernels get it.
struct NativeImage {
    FlatEnvironment flat;
    std::vector<float> map;
    native::EnvironmentRecord record{};

    explicit NativeImage(const EnvironmentImage& of, const glm::dmat3& to_world = glm::dmat3(1.0))
        : flat(flatten_environment(of, to_world)), map(environment_irradiance(flat)) {
        std::memcpy(&record, flat.records.data(), sizeof(record));
    }

    [[nodiscard]] glm::dvec3 irradiance(const glm::dvec3& normal) const {
        const glm::vec3 n(normal);
        const native::float3 found =
            native::open_irradiance(&record, map.data(), native::f3(n.x, n.y, n.z));
        return {found.x, found.y, found.z};
    }
    /// By a sum over directions that are spread evenly.
    [[nodiscard]] glm::dvec3 summed(const glm::dvec3& normal) const {
        const native::EnvironmentImage image{&record, flat.texels.data(), flat.sums.data()};
        constexpr int rows = 600;
        glm::dvec3 sum(0.0);
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < 2 * rows; ++j) {
                const double height = 1.0 - 2.0 * (i + 0.5) / rows;
                const double turn = pi * (j + 0.5) / rows;
                const double across = std::sqrt(1.0 - height * height);
                const glm::dvec3 direction(across * std::cos(turn), height,
                                           across * std::sin(turn));
                const double cosine = glm::dot(direction, normal);
                if (!(cosine > 0.0)) continue;
                const glm::vec3 d(direction);
                const native::float3 light =
                    native::image_radiance(&image, native::f3(d.x, d.y, d.z));
                sum += cosine * glm::dvec3(light.x, light.y, light.z);
            }
        return sum * (4.0 * pi / (2.0 * rows * rows));
    }
};

std::vector<glm::dvec3> some_normals(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<glm::dvec3> normals{{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}};
    while (static_cast<int>(normals.size()) < count)
        normals.push_back(
            glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
    return normals;
}

double greatest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

TEST(EnvironmentIrradiance, IsPiTimesTheRadianceOfAnEvenImage) {
    const NativeImage made(test::constant_image({1.0F, 2.0F, 0.5F}));
    for (const glm::dvec3& normal : some_normals(1, 200)) {
        const glm::dvec3 found = made.irradiance(normal) / pi;
        EXPECT_NEAR(found.x, 1.0, 2e-3);
        EXPECT_NEAR(found.y, 2.0, 4e-3);
        EXPECT_NEAR(found.z, 0.5, 1e-3);
    }
}

TEST(EnvironmentIrradiance, IsTheSumOverAllDirections) {
    const auto value = [](const glm::dvec3& d) {
        return glm::vec3(0.2 + std::max(0.0, d.x), 0.1 + std::max(0.0, d.y * d.z),
                         d.x > 0.3 && d.y > 0.2 ? 3.0 : 0.0);
    };
    const glm::dmat3 turned(
        glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5))));
    for (const auto& [width, height, at_poles] :
         {std::tuple{1U, 1U, false}, std::tuple{5U, 4U, true}, std::tuple{16U, 8U, false},
          std::tuple{600U, 300U, false}})
        for (const glm::dmat3& to_world : {glm::dmat3(1.0), turned}) {
            const NativeImage made(test::image_of(width, height, at_poles, value), to_world);
            double most = 0.0;
            for (const glm::dvec3& normal : some_normals(2, 12))
                most = std::max(most, greatest(made.irradiance(normal)));
            for (const glm::dvec3& normal : some_normals(2, 12)) {
                const glm::dvec3 found = made.irradiance(normal);
                const glm::dvec3 sum = made.summed(normal);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], sum[c], 0.01 * most) << width;
            }
        }
}

TEST(EnvironmentIrradiance, OfASunIsThatOfADirectionalLight) {
    const EnvironmentImage sun = test::one_texel(1024, 512, 300, 120, glm::vec3(1e6F));
    const NativeImage made(sun);
    const glm::dvec3 towards = test::texel_direction(sun, 300, 120);
    const double facing = 4.0 * pi * made.flat.mean.x;
    for (const glm::dvec3& normal : some_normals(3, 500))
        EXPECT_NEAR(made.irradiance(normal).x, facing * std::max(0.0, glm::dot(normal, towards)),
                    0.02 * facing);
}

TEST(EnvironmentIrradiance, CorrectionsAreFinite) {
    const float huge = std::numeric_limits<float>::infinity();
    const native::float3 ratio =
        native::sampling_correction(native::f3(6.0F, 1.0F, huge), native::f3(2.0F, 0.0F, huge));
    EXPECT_EQ(ratio.x, 3.0F);
    EXPECT_EQ(ratio.y, 0.0F);
    EXPECT_EQ(ratio.z, 1.0F);
}

/// A floor under an image with a dim sky and a bright spot, and a roof over it where wanted.
Scene lit_floor(bool covered) {
    test::SceneBuilder builder;
    builder.add(test::quad_mesh({-1.0F, 0.0F, -1.0F}, {0.0F, 0.0F, 2.0F}, {2.0F, 0.0F, 0.0F}),
                builder.material(glm::vec3(0.5F)));
    if (covered)
        builder.add(
            test::quad_mesh({-90.0F, 0.1F, -90.0F}, {0.0F, 0.0F, 180.0F}, {180.0F, 0.0F, 0.0F}),
            builder.material(glm::vec3(0.0F)));
    EnvironmentImage image = test::image_of(64, 32, false, [](const glm::dvec3& d) {
        return glm::vec3(d.y > 0.0 ? 1.0F : 0.2F, 0.5F, d.y > 0.8 && d.x > 0.0 ? 300.0F : 0.0F);
    });
    builder.scene.environment =
        Environment{glm::vec3(2.0F), std::make_shared<EnvironmentImage>(std::move(image))};
    return builder.scene;
}

// Nine samples of the image find the floor free: its light is exact, whatever they are.
TEST(EnvironmentIrradiance, AnOpenFloorHasNoNoise) {
    const Scene scene = lit_floor(false);
    const NativeImage made(*scene.environment->image);
    const glm::dvec3 expected = 2.0 * made.irradiance({0, 1, 0}) * (0.5 / pi);
    const Camera camera = test::look_at({0.0, 1.0, 0.5}, {0.0, 0.0, 0.0}, 0.4);
    for (const test::TestBackend backend : test::backends())
        for (const std::uint32_t seed : {0U, 1U, 2U}) {
            RenderSettings how = test::small_settings(Algorithm::ais, 24, 24);
            how.seed = seed;
            how.indirect = false;
            const test::Rendering seen =
                test::render(test::shared_executor(backend), scene, camera, how, 1);
            for (std::uint32_t c = 0; c < 3; ++c)
                for (const double value : test::channel_of(seen, "", c))
                    EXPECT_NEAR(value, expected[static_cast<int>(c)],
                                0.005 * expected[static_cast<int>(c)]);
        }
}

TEST(EnvironmentIrradiance, WhatIsHiddenIsDark) {
    const Camera camera = test::look_at({0.0, 0.05, 0.9}, {0.0, 0.0, 0.0}, 0.2);
    RenderSettings how = test::small_settings(Algorithm::ais, 24, 24);
    how.indirect = false;
    const test::Rendering seen = test::render(test::shared_executor(test::TestBackend::own_bvh),
                                              lit_floor(true), camera, how, 1);
    const std::vector<double> values = test::channel_of(seen, "direct", 2);
    // A ray that leaves between floor and roof is all but level.
    for (const double value : values) EXPECT_LT(value, 0.01);
}

}  // namespace
}  // namespace weft::environment_irradiance_test
