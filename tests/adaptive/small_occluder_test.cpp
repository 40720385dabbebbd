// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/testing/render_fixture.h"

// Shadows narrower than the distance of the samples that undersampling starts from must not get
// lost: what a shadow takes from the floor's light, summed over each connected shadow, is compared
// with full sampling of the same seed.
//
// The floor is looked at from straight above, so that pixels are squares of known size, and most
// occluders float above the camera: nothing in the image but the shadow betrays them.
namespace weft::small_occluder_test {
namespace {

using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr std::uint32_t usual_edge = 96;
constexpr double pixel = 2.0 / usual_edge;  // on the floor
constexpr double camera_height = 2.0;
constexpr double occluder_height = 2.5;
constexpr double area_light_height = 5.0;  // shadows are twice as wide as what casts them

/// Where the middle of that pixel lies.
double middle(double at, std::uint32_t edge = usual_edge) {
    return (at + 0.5 - 0.5 * edge) * pixel;
}

/// A square area light above the middle of a floor.
SceneBuilder floor_and_area_light(double area_light_edge) {
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1.5F, 0, -1.5F}, {0, 0, 3}, {3, 0, 0}),
                builder.material({0.5F, 0.5F, 0.5F}));
    const auto s = static_cast<float>(area_light_edge);
    const float radiance = 60.0F / (s * s);
    builder.add(test::quad_mesh({-0.5F * s, static_cast<float>(area_light_height), -0.5F * s},
                                {s, 0, 0}, {0, 0, s}),
                builder.material({0, 0, 0}, {radiance, radiance, radiance}));
    return builder;
}

/// A flat bar at a height, by the middle of its shadow's place on the floor for a small area light,
/// the bar's own length and width, and its direction.
void add_bar(SceneBuilder& builder, double height, const glm::dvec2& shadow, double length,
             double width, double angle = 0.0) {
    const double share = (area_light_height - height) / area_light_height;
    const glm::dvec2 along = length * glm::dvec2(std::sin(angle), std::cos(angle));
    const glm::dvec2 across = width * glm::dvec2(std::cos(angle), -std::sin(angle));
    const glm::dvec2 corner = share * shadow - 0.5 * along - 0.5 * across;
    builder.add(test::quad_mesh(glm::vec3(corner.x, height, corner.y),
                                glm::vec3(across.x, 0, across.y), glm::vec3(along.x, 0, along.y)),
                builder.material({0.1F, 0.3F, 0.1F}));
}

/// How images are made.
struct How {
    std::vector<std::uint32_t> seeds = {1, 2};
    std::uint32_t edge = usual_edge;
    std::uint32_t frames = 1;
    TestBackend backend = TestBackend::own_bvh;
    /// Whether occluders hide about one of the 36 points on the area light that a footprint looks
    /// at. About two thirds of such a shadow are found, since its rim is not where each point's
    /// shadow is: a pixel misses up to three hidden points, else one, within a tenth, because
    /// points do not count alike.
    bool faint = false;
};

/// `threshold` 0: the standard one.
Rendering make_image(const Scene& scene, Algorithm algorithm, double threshold, std::uint32_t seed,
                     const How& how) {
    RenderSettings settings = test::small_settings(algorithm, how.edge, how.edge);
    if (threshold > 0.0) settings.sampling.threshold = threshold;
    settings.indirect = false;
    settings.seed = seed;
    const Camera camera = test::look_at({0, camera_height, 0}, {0, 0, 0},
                                        2.0 * std::atan(0.5 * how.edge * pixel / camera_height));
    return test::render(how.backend, scene, camera, settings, how.frames);
}

/// The shadows of an image with full sampling, and the same pixels of another.
class Shadows {
  public:
    /// `open`: without the occluder.
    Shadows(const Rendering& open, const Rendering& full)
        : edge_(full.image.width), open_(open), full_(full) {
        seen_.assign(std::size_t{edge_} * edge_, false);
        for (std::uint32_t y = 0; y < edge_; ++y)
            for (std::uint32_t x = 0; x < edge_; ++x)
                if (is_shadow(x, y) && !seen_[y * edge_ + x]) collect(x, y);
    }

    [[nodiscard]] std::size_t count() const { return shadows_.size(); }
    /// Pixels of all shadows.
    [[nodiscard]] std::size_t size() const {
        std::size_t sum = 0;
        for (const auto& shadow : shadows_) sum += shadow.size();
        return sum;
    }

    /// The least share of a shadow that `other` has.
    [[nodiscard]] double least_share(const Rendering& other) const {
        double least = 1e300;
        for (const auto& shadow : shadows_) {
            double expected = 0.0;
            double found = 0.0;
            for (const std::uint32_t at : shadow) {
                expected += light(open_, at) - light(full_, at);
                found += light(open_, at) - light(other, at);
            }
            least = std::min(least, found / expected);
        }
        return least;
    }

    /// The share that `other` has of all shadows together.
    [[nodiscard]] double whole_share(const Rendering& other) const {
        double expected = 0.0;
        double found = 0.0;
        for (const auto& shadow : shadows_)
            for (const std::uint32_t at : shadow) {
                expected += light(open_, at) - light(full_, at);
                found += light(open_, at) - light(other, at);
            }
        return found / expected;
    }

    /// By how much a pixel of a shadow is lit too much at most, of its light without the occluder.
    [[nodiscard]] double most_light(const Rendering& other) const {
        double most = 0.0;
        for (const auto& shadow : shadows_)
            for (const std::uint32_t at : shadow)
                most = std::max(most, (light(other, at) - light(full_, at)) / light(open_, at));
        return most;
    }

  private:
    [[nodiscard]] double light(const Rendering& rendering, std::uint32_t at) const {
        return static_cast<double>(rendering.at("direct", at % edge_, at / edge_));
    }
    [[nodiscard]] bool is_shadow(std::uint32_t x, std::uint32_t y) const {
        // Pixels that show the occluder itself have no light to lose.
        if (open_.at("albedo", x, y) != full_.at("albedo", x, y)) return false;
        const std::uint32_t at = y * edge_ + x;
        return light(full_, at) < 0.998 * light(open_, at);
    }
    void collect(std::uint32_t x, std::uint32_t y) {
        std::vector<std::uint32_t> shadow{y * edge_ + x};
        seen_[y * edge_ + x] = true;
        for (std::size_t i = 0; i < shadow.size(); ++i) {
            const std::uint32_t row = shadow[i] / edge_;
            const std::uint32_t column = shadow[i] % edge_;
            for (std::uint32_t v = row - std::min(row, 1U); v <= std::min(row + 1, edge_ - 1); ++v)
                for (std::uint32_t u = column - std::min(column, 1U);
                     u <= std::min(column + 1, edge_ - 1); ++u)
                    if (is_shadow(u, v) && !seen_[v * edge_ + u]) {
                        seen_[v * edge_ + u] = true;
                        shadow.push_back(v * edge_ + u);
                    }
        }
        shadows_.push_back(std::move(shadow));
    }

    std::uint32_t edge_;
    const Rendering& open_;
    const Rendering& full_;
    std::vector<bool> seen_;
    std::vector<std::vector<std::uint32_t>> shadows_;
};

/// That adaptive sampling loses none of the shadows of these occluders; at least `shadows` of them,
/// of `pixels` all together, must be there with full sampling.
void expect_no_loss(const Scene& open_scene, const Scene& scene, std::size_t shadows,
                    std::size_t pixels, const How& how = {}) {
    for (const std::uint32_t seed : how.seeds) {
        const Rendering open = make_image(open_scene, Algorithm::amax, 0.0, seed, how);
        const Rendering full = make_image(scene, Algorithm::amax, 0.0, seed, how);
        const Shadows found(open, full);
        EXPECT_GE(found.count(), shadows) << "seed " << seed;
        EXPECT_GE(found.size(), pixels) << "seed " << seed;
        for (const double threshold : {0.0, 1e9}) {
            const Rendering adaptive = make_image(scene, Algorithm::ais, threshold, seed, how);
            SCOPED_TRACE("seed " + std::to_string(seed) + " threshold " +
                         std::to_string(threshold));
            if (how.faint)
                EXPECT_GE(found.whole_share(adaptive), 0.6);
            else
                EXPECT_GE(found.least_share(adaptive), 0.99);
            EXPECT_LE(found.most_light(adaptive), how.faint ? 3.1 / 36.0 : 1.1 / 36.0);
            EXPECT_LT(adaptive.stats.back().rays, full.stats.back().rays);
        }
    }
}

constexpr double narrow_area_light = 0.2 * pixel;  // its penumbrae are as wide
constexpr double bar_width = 0.4 * pixel;          // casts 0.8 pixels and the penumbra

TEST(SmallOccluder, ABarOnePixelWideInEveryColumnAndRow) {
    const Scene open = floor_and_area_light(narrow_area_light).scene;
    for (int at = 40; at < 48; ++at)
        for (const double angle : {0.0, 0.5 * std::numbers::pi}) {
            SCOPED_TRACE("pixel " + std::to_string(at) + " angle " + std::to_string(angle));
            SceneBuilder builder = floor_and_area_light(narrow_area_light);
            const glm::dvec2 shadow = angle == 0.0 ? glm::dvec2(middle(at), middle(50))
                                                   : glm::dvec2(middle(50), middle(at));
            add_bar(builder, occluder_height, shadow, 0.5, bar_width, angle);
            expect_no_loss(open, builder.scene, 1, 100, {.seeds = {3}});
        }
}

TEST(SmallOccluder, ASlantedBar) {
    const Scene open = floor_and_area_light(narrow_area_light).scene;
    for (const double angle : {0.05, 0.4, 0.8, 2.0}) {
        SCOPED_TRACE(angle);
        SceneBuilder builder = floor_and_area_light(narrow_area_light);
        add_bar(builder, occluder_height, {0.1, -0.07}, 0.6, bar_width, angle);
        expect_no_loss(open, builder.scene, 1, 60);
    }
}

TEST(SmallOccluder, AGrid) {
    // Bars a little more than two tiles apart, so that they meet every column and row of tiles.
    SceneBuilder builder = floor_and_area_light(narrow_area_light);
    for (int i = 0; i < 5; ++i) {
        add_bar(builder, occluder_height, {middle(10 + 17 * i), 0.0}, 1.2, bar_width);
        add_bar(builder, occluder_height, {0.0, middle(10 + 17 * i)}, 1.2, bar_width,
                0.5 * std::numbers::pi);
    }
    expect_no_loss(floor_and_area_light(narrow_area_light).scene, builder.scene, 1, 2000);
}

TEST(SmallOccluder, AGridOnEveryBackendAndOverSeveralFrames) {
    SceneBuilder builder = floor_and_area_light(narrow_area_light);
    for (int i = 0; i < 4; ++i) {
        add_bar(builder, occluder_height, {middle(9 + 22 * i), 0.0}, 1.2, bar_width, 0.02);
        add_bar(builder, occluder_height, {0.0, middle(12 + 22 * i)}, 1.2, bar_width, 1.5);
    }
    for (const TestBackend backend : test::backends()) {
        SCOPED_TRACE(test::backend_name(backend));
        expect_no_loss(floor_and_area_light(narrow_area_light).scene, builder.scene, 1, 1000,
                       {.seeds = {7}, .frames = 3, .backend = backend});
    }
}

TEST(SmallOccluder, PinsOnEveryPixelOfATile) {
    // Far enough apart that each shadow, filtered to 3 x 3 pixels, stands in tiles of its own.
    const Scene open = floor_and_area_light(narrow_area_light).scene;
    for (int first = 0; first < 8; ++first) {
        SceneBuilder builder = floor_and_area_light(narrow_area_light);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                add_bar(builder, occluder_height,
                        {middle(8 + 25 * column + first), middle(8 + 25 * row + (3 * first) % 8)},
                        bar_width, bar_width);
        SCOPED_TRACE(first);
        expect_no_loss(open, builder.scene, 9, 9 * 9, {.seeds = {5}});
    }
}

TEST(SmallOccluder, ABarBesideTheFloorInTheImage) {
    // Near the floor and seen, under an area light of ordinary size.
    const Scene open = floor_and_area_light(0.5).scene;
    for (const double angle : {0.0, 0.3}) {
        SCOPED_TRACE(angle);
        SceneBuilder builder = floor_and_area_light(0.5);
        const double height = 0.2;
        add_bar(builder, height, {0.5, 0.4}, 0.7, 0.8 * pixel, angle);
        expect_no_loss(open, builder.scene, 1, 50);
    }
}

TEST(SmallOccluder, AFaintSoftShadow) {
    // Pins far above the floor that hide a few hundredths of a wide area light at most: most first
    // looks see it.
    SceneBuilder builder = floor_and_area_light(0.4);
    add_bar(builder, occluder_height, {0.4, 0.3}, 0.04, 0.04);
    add_bar(builder, 3.0, {-0.5, -0.4}, 0.03, 0.03, 0.4);
    expect_no_loss(floor_and_area_light(0.4).scene, builder.scene, 1, 300,
                   {.seeds = {1, 2, 3, 4}, .faint = true});
}

TEST(SmallOccluder, AtTheBorderOfImagesThatEndWithinATile) {
    // At the border the discontinuity buffer reaches two pixels inwards.
    const Scene open = floor_and_area_light(narrow_area_light).scene;
    for (const std::uint32_t edge : {89U, 90U, 96U})
        for (std::uint32_t from_end = 1; from_end <= 4; ++from_end) {
            SCOPED_TRACE(std::to_string(edge) + " - " + std::to_string(from_end));
            SceneBuilder builder = floor_and_area_light(narrow_area_light);
            const double at = middle(edge - from_end, edge);
            add_bar(builder, occluder_height, {at, 0.0}, 0.4, bar_width);
            add_bar(builder, occluder_height, {0.0, at}, 0.4, bar_width, 0.5 * std::numbers::pi);
            expect_no_loss(open, builder.scene, 2, 150, {.seeds = {4}, .edge = edge});
        }
}

}  // namespace
}  // namespace weft::small_occluder_test
