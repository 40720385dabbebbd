// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "metrics/numeric.h"
#include "tests/testing/render_fixture.h"

namespace weft::flicker_test {
namespace {

constexpr std::uint32_t width = 24;
constexpr std::uint32_t height = 16;
constexpr std::size_t pixels = std::size_t{width} * height;

void fill(Image& image, const char* name, const char* channels, std::initializer_list<float> of) {
    Layer layer{name, channels, {}};
    for (const float value : of) layer.values.insert(layer.values.end(), pixels, value);
    image.layers.push_back(std::move(layer));
}

/// A grey wall at depth 2 that fills the image and sends `radiance`.
Image wall(float radiance) {
    Image image;
    image.width = width;
    image.height = height;
    fill(image, "", "RGB", {radiance, radiance, radiance});
    fill(image, "emission", "RGB", {0.0F, 0.0F, 0.0F});
    fill(image, "albedo", "RGB", {0.5F, 0.5F, 0.5F});
    fill(image, "normal", "XYZ", {0.0F, 0.0F, 1.0F});
    fill(image, "depth", "Z", {2.0F});
    return image;
}

float& at(Image& image, const char* layer, std::size_t pixel, std::size_t channel = 0) {
    for (Layer& one : image.layers)
        if (one.name == layer) return one.values[channel * pixels + pixel];
    throw std::out_of_range(layer);
}

/// Looks along -z from x, in units of the wall's pixels.
Camera camera_at_pixel(double x) {
    Camera camera;
    camera.fov = 2.0 * std::atan(0.5);  // the wall's visible part is 2 high
    camera.to_world[3] = glm::dvec4(x * 2.0 / height, 0.0, 0.0, 1.0);
    return camera;
}

TEST(Flicker, FindsPixelsAgainWhereTheCameraMoves) {
    const Image image = wall(1.0F);
    for (const int shift : {0, 1, 5, -3, 24}) {
        const Camera before = camera_at_pixel(0.0);
        // A little less than whole pixels: the point stays off the pixel's border.
        const Camera now = camera_at_pixel(shift + 0.1);
        const auto matches = matching_pixels({image, before}, {image, now});
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) {
                const std::int64_t then = std::int64_t{x} + shift;
                const bool inside = then >= 0 && then < std::int64_t{width};
                EXPECT_EQ(matches[y * width + x],
                          inside ? y * width + static_cast<std::uint32_t>(then) : no_pixel)
                    << x << ' ' << y << " by " << shift;
            }
    }
}

TEST(Flicker, OtherSurfacesAreNoMatch) {
    const Camera camera = camera_at_pixel(0.0);
    const Image now = wall(1.0F);
    // A pixel's footprint is 1/8.
    Image before = wall(1.0F);
    at(before, "normal", 1, 2) = 0.85F;
    at(before, "normal", 2, 2) = 0.95F;
    at(before, "depth", 3) = 2.3F;
    at(before, "depth", 4) = 2.2F;
    at(before, "depth", 5) = 0.0F;
    at(before, "albedo", 6, 1) = 0.51F;
    at(before, "albedo", 7, 1) = 0.504F;
    const auto matches = matching_pixels({before, camera}, {now, camera});
    for (const std::uint32_t other : {1U, 3U, 5U, 6U}) EXPECT_EQ(matches[other], no_pixel) << other;
    for (const std::uint32_t same : {0U, 2U, 4U, 7U, 8U}) EXPECT_EQ(matches[same], same);
    Image area_light = wall(1.0F);
    at(area_light, "emission", 9, 2) = 0.1F;
    at(area_light, "depth", 10) = 0.0F;
    const auto of_area_light = matching_pixels({now, camera}, {area_light, camera});
    EXPECT_EQ(of_area_light[9], no_pixel);
    EXPECT_EQ(of_area_light[10], no_pixel);
    EXPECT_EQ(of_area_light[11], 11U);
}

TEST(Flicker, MatchesAreNearInARenderedScene) {
    test::SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.7F, 0.6F, 0.5F}));
    builder.add(test::quad_mesh({-0.3F, 0.9F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material(glm::vec3(0.5F), {5.0F, 6.0F, 7.0F}));
    const FlatScene flat = flatten(builder.scene);
    RenderSettings settings = test::small_settings(Algorithm::ir, 61, 43);
    settings.indirect = false;
    for (const bool mirrored : {false, true})
        for (const FovAxis axis : {FovAxis::x, FovAxis::y, FovAxis::diagonal}) {
            Camera first = test::look_at({0.3, 0.1, 0.9}, {-0.1, -0.1, 0.0}, 1.1);
            first.fov_axis = axis;
            first.mirror_x = mirrored;
            Camera second = test::look_at({0.35, 0.13, 0.85}, {-0.05, -0.1, 0.0}, 1.1);
            second.fov_axis = axis;
            second.mirror_x = mirrored;
            Executor& executor = test::shared_executor(test::TestBackend::embree);
            const Image before = test::render_flat(executor, flat, first, settings).image;
            const Image now = test::render_flat(executor, flat, second, settings).image;
            const auto matches = matching_pixels({before, first}, {now, second});
            // Direct light of a diffuse surface is the same from everywhere, but for where in its
            // pixels a place is. Pixels at the same place on the screen show other places.
            double matched = 0.0;
            double unmoved = 0.0;
            double found = 0.0;
            for (std::uint32_t pixel = 0; pixel < matches.size(); ++pixel) {
                if (matches[pixel] == no_pixel || matches[pixel] == pixel) continue;
                const auto difference = [&](std::size_t then) {
                    const auto a = static_cast<double>(now.find("direct")->values[pixel]);
                    const auto b = static_cast<double>(before.find("direct")->values[then]);
                    return std::abs(a - b) / std::max(a, b);
                };
                matched += difference(matches[pixel]);
                unmoved += difference(pixel);
                found += 1.0;
            }
            EXPECT_GT(found, static_cast<double>(matches.size()) / 2.0);
            EXPECT_LT(matched / found, 0.03);
            EXPECT_GT(unmoved, 2.0 * matched) << "the test cannot tell";
        }
}

TEST(Flicker, ExcessIsInUnitsOfPu21) {
    const Camera camera = camera_at_pixel(0.0);
    const Image still = wall(1.0F);
    const auto matches = matching_pixels({still, camera}, {still, camera});
    const double change = pu21_encode(110.0) - pu21_encode(100.0);
    EXPECT_NEAR(change, 6.2, 0.2) << "a tenth more light at 100 cd/m^2";
    // The test brightens and the reference does not; the other way round; both; neither.
    const auto excess = [&](float test, float reference) {
        const auto values =
            excess_change(still, wall(test), still, wall(reference), matches, 100.0);
        for (const float value : values) EXPECT_EQ(value, values.front());
        return static_cast<double>(values.front());
    };
    EXPECT_NEAR(excess(1.1F, 1.0F), change, 1e-4);
    EXPECT_NEAR(excess(1.0F, 1.1F), -change, 1e-4);
    EXPECT_NEAR(excess(1.1F, 1.1F), 0.0, 1e-4);
    EXPECT_NEAR(excess(1.0F, 1.0F), 0.0, 1e-4);
    EXPECT_NEAR(excess(0.9F, 1.0F), pu21_encode(100.0) - pu21_encode(90.0), 1e-4);
}

TEST(Flicker, WhatHasNoMatchDoesNotCount) {
    const Image still = wall(1.0F);
    std::vector<std::uint32_t> matches(pixels, no_pixel);
    matches[3] = 3;
    const auto values = excess_change(still, wall(2.0F), still, still, matches, 100.0);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        EXPECT_EQ(values[pixel] != 0.0F, pixel == 3) << pixel;
    Image small = wall(1.0F);
    small.height = height / 2;
    EXPECT_THROW(static_cast<void>(excess_change(small, still, still, still, matches, 100.0)),
                 std::invalid_argument);
}

}  // namespace
}  // namespace weft::flicker_test
