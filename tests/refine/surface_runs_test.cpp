// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/surface_runs.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace weft::surface_runs_test {
namespace {

constexpr std::uint32_t width = 40;
constexpr std::uint32_t height = 24;

using Depth = std::function<float(float x, float y)>;
using Normal = std::function<std::array<float, 3>(float x, float y)>;

Image image_of(const Depth& depth, const Normal& normal) {
    constexpr std::size_t pixels = std::size_t{width} * height;
    Image image{width, height, {}, {}};
    image.layers = {{"depth", "Z", std::vector<float>(pixels), false, false},
                    {"normal", "XYZ", std::vector<float>(3 * pixels), false, false}};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t i = std::size_t{y} * width + x;
            const auto u = static_cast<float>(x);
            const auto v = static_cast<float>(y);
            image.layers[0].values[i] = depth(u, v);
            for (std::size_t c = 0; c < 3; ++c)
                image.layers[1].values[c * pixels + i] = normal(u, v)[c];
        }
    return image;
}

std::array<float, 3> facing(float, float) {
    return {0.0F, 0.0F, 1.0F};
}

void expect_whole(const SurfaceRuns& runs) {
    for (std::size_t i = 0; i < runs.rows.size(); ++i) {
        ASSERT_EQ(runs.rows[i].begin, 0U) << i;
        ASSERT_EQ(runs.rows[i].end, width) << i;
        ASSERT_EQ(runs.columns[i].begin, 0U) << i;
        ASSERT_EQ(runs.columns[i].end, height) << i;
    }
}

/// Expects all rows to be cut before a column and nowhere else.
void expect_cut(const SurfaceRuns& runs, std::uint32_t column) {
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t i = std::size_t{y} * width + x;
            ASSERT_EQ(runs.rows[i].begin, x < column ? 0 : column) << x;
            ASSERT_EQ(runs.rows[i].end, x < column ? column : width) << x;
            ASSERT_EQ(runs.columns[i].length(), height);
        }
}

TEST(SurfaceRuns, WithoutLayersThereAreNoEdges) {
    expect_whole(find_surface_runs({width, height, {}, {}}));
}

TEST(SurfaceRuns, OneSurfaceHasNone) {
    expect_whole(find_surface_runs(image_of([](float, float) { return 2.0F; }, facing)));
    // A floor up to near its horizon, whose depth grows by up to a seventh from row to row.
    expect_whole(
        find_surface_runs(image_of([](float, float y) { return 60.0F / (30.0F - y); }, facing)));
}

TEST(SurfaceRuns, ASphereHasNoneWithinIt) {
    const auto height_of = [](float x, float y) {
        return std::sqrt(900.0F - (x - 20.0F) * (x - 20.0F) - (y - 12.0F) * (y - 12.0F));
    };
    expect_whole(find_surface_runs(image_of(
        [&](float x, float y) { return 200.0F - height_of(x, y); },
        [&](float x, float y) {
            return std::array{(x - 20.0F) / 30.0F, (y - 12.0F) / 30.0F, height_of(x, y) / 30.0F};
        })));
}

TEST(SurfaceRuns, EndWhereTheDepthLeaps) {
    for (const float unit : {1e-20F, 1.0F, 1e20F})
        for (const float behind : {2.2F, 20.0F, 0.0F})
            expect_cut(
                find_surface_runs(image_of(
                    [&](float x, float) { return unit * (x < 17.0F ? 2.0F : behind); }, facing)),
                17);
}

TEST(SurfaceRuns, EndWhereTheNormalTurns) {
    expect_cut(
        find_surface_runs(image_of(
            [](float, float) { return 2.0F; },
            [](float x, float) {
                return x < 9.0F ? std::array{1.0F, 0.0F, 0.0F} : std::array{0.0F, 0.0F, 1.0F};
            })),
        9);
}

TEST(SurfaceRuns, EndWhereTheAlbedoIsTwiceAsLarge) {
    const auto with_albedo = [](float right) {
        constexpr std::size_t pixels = std::size_t{width} * height;
        Image image = image_of([](float, float) { return 2.0F; }, facing);
        image.layers.push_back(
            {"albedo", "RGB", std::vector<float>(3 * pixels, 0.2F), false, false});
        for (std::size_t i = 0; i < 3 * pixels; ++i)
            if (i % width >= 30) image.layers.back().values[i] = right;
        return find_surface_runs(image);
    };
    for (const float right : {0.0F, 0.09F, 0.5F, 1.0F}) expect_cut(with_albedo(right), 30);
    for (const float right : {0.12F, 0.2F, 0.38F}) expect_whole(with_albedo(right));
}

TEST(SurfaceRuns, APixelWithPartsOfTwoSurfacesIsARunOfItsOwn) {
    const SurfaceRuns runs = find_surface_runs(image_of(
        [](float x, float) { return x < 17.0F   ? 2.0F
                                    : x < 18.0F ? 3.0F
                                                : 4.0F; }, facing));
    EXPECT_EQ(runs.rows[16].end, 17U);
    EXPECT_EQ(runs.rows[17].begin, 17U);
    EXPECT_EQ(runs.rows[17].end, 18U);
    EXPECT_EQ(runs.rows[18].begin, 18U);
}

TEST(SurfaceRuns, AnyValuesGiveRunsThatCoverTheImage) {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const std::array values{std::nanf(""), infinite, -infinite, -1.0F, 0.0F, 3e38F};
    const auto value = [&](float x, float y) {
        return values[static_cast<std::size_t>(x + 5.0F * y) % values.size()];
    };
    const SurfaceRuns runs = find_surface_runs(image_of(value, [&](float x, float y) {
        return std::array{value(x, y), value(y, x), value(x + y, x)};
    }));
    for (std::size_t i = 0; i < runs.rows.size(); ++i) {
        const auto x = static_cast<std::uint32_t>(i % width);
        const auto y = static_cast<std::uint32_t>(i / width);
        ASSERT_TRUE(runs.rows[i].begin <= x && x < runs.rows[i].end && runs.rows[i].end <= width);
        ASSERT_TRUE(runs.columns[i].begin <= y && y < runs.columns[i].end &&
                    runs.columns[i].end <= height);
    }
}

}  // namespace
}  // namespace weft::surface_runs_test
