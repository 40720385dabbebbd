// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/testing/bvh_meshes.h"
#include "tests/testing/render_fixture.h"

// Interleaved sampling against its brute-force reference: `ir` makes the same sample sets as `igi`,
// and every pixel uses all of them. And the discontinuity filter against what it must not mix.
namespace weft::brute_force_test {
namespace {

using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

/// The room [-1,1]^3 with an area light under its ceiling and light from a gap in one wall.
SceneBuilder room_scene() {
    SceneBuilder builder;
    const std::uint32_t white = builder.material({0.7F, 0.6F, 0.5F});
    const std::uint32_t red = builder.material({0.6F, 0.2F, 0.2F});
    builder.add(test::quad_mesh({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}), white);
    builder.add(test::quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), white);
    builder.add(test::quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), white);
    builder.add(test::quad_mesh({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}), red);
    builder.add(test::quad_mesh({1, -1, -1}, {0, 0, 2}, {0, 2, 0}), white);
    builder.add(test::quad_mesh({-0.3F, 0.95F, -0.3F}, {0.6F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.6F}),
                builder.material(glm::vec3(0.5F), {5.0F, 6.0F, 7.0F}));
    builder.scene.environment = Environment{{0.3F, 0.2F, 0.1F}};
    return builder;
}

RenderSettings settings_of(Algorithm algorithm, std::uint32_t width, std::uint32_t height) {
    return test::unbounded(test::small_settings(algorithm, width, height));
}

/// So narrow that all pixels see nearly one point.
Camera camera_on_one_point() {
    return test::look_at({0.2, 0.3, 0.6}, {0.1, -1.0, -0.3}, 1e-5);
}

// Nothing is left to chance: the sets are those of the seeds. Rounding moves the mean by 1e-6, a
// hundredth of what is allowed. Where a block had an average set in the place of the one that is
// farthest off, its mean would move by a ninth of the spread: a hundred times what is allowed.
TEST(BruteForce, EveryBlockOfNineUnfilteredPixelsAveragesToTheReference) {
    const FlatScene flat = flatten(room_scene().scene);
    for (const TestBackend backend : test::backends())
        for (const std::uint32_t seed : {0U, 1U, 2U}) {
            Executor& executor = test::shared_executor(backend);
            RenderSettings settings = settings_of(Algorithm::igi, 12, 9);
            settings.seed = seed;
            settings.sampling.filter_radius = 0;
            const Rendering igi =
                test::render_flat(executor, flat, camera_on_one_point(), settings);
            settings.algorithm = Algorithm::ir;
            const Rendering ir = test::render_flat(executor, flat, camera_on_one_point(), settings);
            test::expect_clean(igi);
            test::expect_clean(ir);
            for (const char* layer : {"direct", "indirect"}) {
                for (std::uint32_t y0 = 0; y0 + 3 <= 9; ++y0)
                    for (std::uint32_t x0 = 0; x0 + 3 <= 12; ++x0) {
                        const double reference = static_cast<double>(ir.at(layer, x0 + 1, y0 + 1));
                        ASSERT_GT(reference, 0.0);
                        double mean = 0.0;
                        double spread = 0.0;
                        for (std::uint32_t i = 0; i < 9; ++i) {
                            const double value =
                                static_cast<double>(igi.at(layer, x0 + i % 3, y0 + i / 3));
                            mean += value / 9;
                            spread = std::max(spread, std::abs(value - reference));
                        }
                        EXPECT_NEAR(mean, reference, 1e-4 * reference) << layer;
                        // The nine sets are different ones, or the comparison says nothing.
                        EXPECT_GT(spread, 0.1 * reference) << layer;
                    }
            }
        }
}

TEST(BruteForce, TheFilterMeetsEverySetOnceAtBordersToo) {
    const FlatScene flat = flatten(room_scene().scene);
    using Size = std::pair<std::uint32_t, std::uint32_t>;
    for (const TestBackend backend : test::backends())
        for (const auto& [width, height] : {Size{3, 3}, Size{7, 5}, Size{20, 11}, Size{4, 70}}) {
            Executor& executor = test::shared_executor(backend);
            const Rendering igi = test::render_flat(executor, flat, camera_on_one_point(),
                                                    settings_of(Algorithm::igi, width, height));
            const Rendering ir = test::render_flat(executor, flat, camera_on_one_point(),
                                                   settings_of(Algorithm::ir, width, height));
            for (const char* layer : {"direct", "indirect"}) {
                const std::vector<float>& expected = ir.layer(layer);
                double worst = 0.0;
                for (std::size_t i = 0; i < expected.size(); ++i)
                    worst = std::max(worst, std::abs(static_cast<double>(igi.layer(layer)[i]) /
                                                         static_cast<double>(expected[i]) -
                                                     1.0));
                EXPECT_LE(worst, 1e-4) << layer << ' ' << width << 'x' << height;
            }
        }
}

TEST(BruteForce, AWholeImageIsNearItsReference) {
    // Interleaving with the filter replaces all VPLs by those of nine neighbours. What that changes
    // depends on a pixel's size against the distance of VPLs: finer images come nearer.
    const FlatScene flat = flatten(room_scene().scene);
    const Camera camera = test::look_at({0.0, 0.0, 3.2}, {0.0, 0.0, 0.0}, 0.75);
    double coarse = 1.0;
    for (const std::uint32_t height : {50U, 200U}) {
        // The standard bound, for corners would be dominated by single VPLs without.
        RenderSettings settings = test::small_settings(Algorithm::igi, height * 3 / 2, height);
        settings.sampling.vpls_per_set = 16;
        Executor& executor = test::shared_executor(TestBackend::own_bvh);
        const Rendering igi = test::render_flat(executor, flat, camera, settings);
        settings.algorithm = Algorithm::ir;
        const Rendering ir = test::render_flat(executor, flat, camera, settings);
        for (const char* layer : {"direct", "indirect"})
            EXPECT_NEAR(test::mean_of(igi.layer(layer)) / test::mean_of(ir.layer(layer)), 1.0, 0.02)
                << layer;
        for (const char* layer : {"albedo", "normal", "depth", "emission"})
            EXPECT_EQ(ir.layer(layer), igi.layer(layer)) << layer;
        const double error = test::relative_mse(ir.layer("indirect"), igi.layer("indirect"));
        EXPECT_LE(error, 0.25 * coarse);
        coarse = error;
    }
}

TEST(BruteForce, TextureAndVertexColoursNeverPassThroughTheFilter) {
    // An open plane under a constant environment: its irradiance is the same everywhere, and stays
    // so when the reflectance changes from pixel to pixel.
    SceneBuilder builder;
    Mesh plane = test::quad_mesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 40);
    test::Uniform uniform(4);
    for (std::size_t i = 0; i < plane.positions.size(); ++i)
        plane.colours.emplace_back(uniform(0.1F, 1.0F), uniform(0.1F, 1.0F), uniform(0.1F, 1.0F));
    Texture texture;
    texture.width = texture.height = 32;
    texture.nearest = true;
    for (int i = 0; i < 32 * 32 * 4; ++i)
        texture.rgba.push_back(static_cast<std::uint8_t>(uniform(60.0F, 255.0F)));
    builder.scene.textures.push_back(texture);
    const std::uint32_t material = builder.material(glm::vec3(0.9F));
    set_albedo_texture(builder.scene.materials[material], 0);
    builder.add(std::move(plane), material);
    builder.scene.environment = Environment{glm::vec3(1.0F)};
    const Camera camera = test::look_at({0.0, 0.0, 2.0}, {0.0, 0.0, 0.0}, 0.8);
    for (const TestBackend backend : test::backends()) {
        RenderSettings settings = test::small_settings(Algorithm::igi, 61, 47);
        const Rendering filtered = test::render(backend, builder.scene, camera, settings);
        settings.sampling.filter_radius = 0;
        const Rendering unfiltered = test::render(backend, builder.scene, camera, settings);
        EXPECT_EQ(filtered.layer("albedo"), unfiltered.layer("albedo"));
        const std::vector<float>& albedo = filtered.layer("albedo");
        EXPECT_GT(*std::max_element(albedo.begin(), albedo.end()),
                  2.0F * *std::min_element(albedo.begin(), albedo.end()));
        for (std::size_t i = 0; i < albedo.size(); ++i) {
            ASSERT_NEAR(filtered.layer("direct")[i], albedo[i], 2e-6F * albedo[i]);
            ASSERT_NEAR(filtered.layer("direct")[i], unfiltered.layer("direct")[i],
                        2e-6F * albedo[i]);
        }
    }
}

/// Pixels by whether `dark` says that no light may reach them.
struct Bleeding {
    std::size_t dark_pixels = 0;
    std::size_t lit_pixels = 0;
    std::size_t lit_wrongly = 0;  ///< dark ones that are not exactly 0
    double largest_loss = 0.0;    ///< of a lit one against the reference, relative
};

template <class Dark>
Bleeding bleeding(const Rendering& igi, const Rendering& ir, const Dark& dark) {
    Bleeding found;
    for (std::uint32_t y = 0; y < igi.image.height; ++y)
        for (std::uint32_t x = 0; x < igi.image.width; ++x) {
            if (!(igi.at("albedo", x, y) > 0.0F)) continue;
            const double value = static_cast<double>(igi.at("direct", x, y));
            if (dark(igi, x, y)) {
                ++found.dark_pixels;
                found.lit_wrongly += value != 0.0 ? 1 : 0;
                continue;
            }
            ++found.lit_pixels;
            const double reference = static_cast<double>(ir.at("direct", x, y));
            if (reference > 0.0)
                found.largest_loss = std::max(found.largest_loss, 1.0 - value / reference);
        }
    return found;
}

template <class Dark>
void expect_no_bleeding(const Scene& scene, const Camera& camera, const Dark& dark) {
    for (const TestBackend backend : test::backends()) {
        // With so many samples every set is nearly right, so that losses show.
        RenderSettings settings = settings_of(Algorithm::ir, 80, 60);
        settings.sampling.samples_per_light = 256;
        settings.indirect = false;
        const Rendering ir = test::render(backend, scene, camera, settings);
        settings.algorithm = Algorithm::igi;
        const Bleeding found = bleeding(test::render(backend, scene, camera, settings), ir, dark);
        EXPECT_GT(found.dark_pixels, 500U);
        EXPECT_GT(found.lit_pixels, 500U);
        EXPECT_EQ(found.lit_wrongly, 0U);
        EXPECT_LT(found.largest_loss, 0.08);
        // A filter that mixes everything does bleed: the comparison can fail.
        settings.sampling.filter_cosine = -2.0;
        settings.sampling.filter_planes = 1e9;
        const Bleeding mixed = bleeding(test::render(backend, scene, camera, settings), ir, dark);
        EXPECT_GT(mixed.lit_wrongly, 20U);
        EXPECT_GT(mixed.largest_loss, 0.2);
    }
}

TEST(BruteForce, NoLightBleedsAcrossACrease) {
    // The area light hangs within the cube's outline: its sides see nothing of it.
    SceneBuilder builder;
    Mesh cube = test::room_mesh();
    for (auto& triangle : cube.triangles) std::swap(triangle[1], triangle[2]);
    builder.add(std::move(cube), builder.material(glm::vec3(0.7F)));
    builder.add(test::quad_mesh({-0.9F, 2.5F, -0.9F}, {1.8F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.8F}),
                builder.material(glm::vec3(0.0F), glm::vec3(3.0F)));
    expect_no_bleeding(builder.scene, test::look_at({3.0, 2.2, 4.0}, {0.3, 0.6, 0.3}, 0.5),
                       [](const Rendering& rendering, std::uint32_t x, std::uint32_t y) {
                           return rendering.at("normal", x, y, 1) < 0.5F;
                       });
}

TEST(BruteForce, ParallelPlanesAtDifferentDepthDoNotMix) {
    // The area light lies between the planes and shines down to the lower one.
    SceneBuilder builder;
    const std::uint32_t white = builder.material(glm::vec3(0.7F));
    builder.add(test::quad_mesh({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}), white);
    builder.add(test::quad_mesh({-2.0F, -2.0F, 1.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 4.0F, 0.0F}),
                white);
    builder.add(test::quad_mesh({-1.0F, -0.5F, 0.9F}, {0.0F, 1.0F, 0.0F}, {0.9F, 0.0F, 0.0F}),
                builder.material(glm::vec3(0.0F), glm::vec3(4.0F)));
    expect_no_bleeding(builder.scene, test::look_at({0.3, 0.0, 5.0}, {0.3, 0.0, 0.0}, 0.35),
                       [](const Rendering& rendering, std::uint32_t x, std::uint32_t y) {
                           return rendering.at("depth", x, y) < 4.5F;
                       });
}

TEST(BruteForce, PunctualLightIsTheSameForBothAndIsNotFiltered) {
    SceneBuilder builder = room_scene();
    builder.light(LightType::point, {0.5, 0.5, 0.5}, glm::vec3(1.0F));
    builder.light(LightType::directional, {}, glm::vec3(1.0F), {0.3, -0.5, -1.0});
    builder.scene.environment.reset();
    builder.scene.materials.back().emission.radiance = glm::vec3(0.0F);
    const Camera camera = test::look_at({0.0, 0.0, 3.2}, {0.0, 0.0, 0.0}, 0.75);
    for (const TestBackend backend : test::backends()) {
        RenderSettings settings = test::small_settings(Algorithm::igi, 50, 40);
        settings.indirect = false;
        const Rendering igi = test::render(backend, builder.scene, camera, settings);
        settings.algorithm = Algorithm::ir;
        const Rendering ir = test::render(backend, builder.scene, camera, settings);
        EXPECT_GT(test::mean_of(ir.layer("direct")), 0.01);
        EXPECT_LE(test::relative_mse(ir.layer("direct"), igi.layer("direct")), 1e-12);
    }
}

}  // namespace
}  // namespace weft::brute_force_test
