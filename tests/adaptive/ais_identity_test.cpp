// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "adaptive/level_overlay.h"
#include "tests/testing/render_fixture.h"
#include "tests/testing/room_scenes.h"

// What adaptive interleaved sampling must equal: plain interleaved sampling where it samples every
// pixel, the union of all sample sets where light is constant, and itself however it is run.
namespace weft::ais_identity_test {
namespace {

using test::Rendering;
using test::TestBackend;

/// What lights a room with a smooth ball and a screen.
enum class Lights : std::uint8_t {
    area_lights,       ///< two area lights
    many_area_lights,  ///< 40 area lights, more than a word has bits
    chosen,            ///< 80 area lights, chosen by power
    mixed,             ///< an area light, a point light, a spot and a distant light
    surroundings       ///< an area light and an environment
};
constexpr std::pair<Lights, const char*> all_lights[] = {
    {Lights::area_lights, "area lights"},
    {Lights::many_area_lights, "many area lights"},
    {Lights::chosen, "chosen area lights"},
    {Lights::mixed, "mixed lights"},
    {Lights::surroundings, "surroundings"}};

void add_area_lights(test::SceneBuilder& builder, std::uint32_t count) {
    const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
    const float cell = 1.6F / static_cast<float>(columns);
    for (std::uint32_t i = 0; i < count; ++i) {
        const float x = -0.8F + cell * static_cast<float>(i % columns);
        const float z = -0.8F + cell * static_cast<float>(i / columns);
        const float radiance = (4.0F + static_cast<float>(i % 3)) / static_cast<float>(count);
        const float edge = 0.3F * cell;
        builder.add(test::quad_mesh({x + edge, 0.95F, z + edge}, {edge, 0, 0}, {0, 0, edge}),
                    builder.material({0.2F, 0.2F, 0.2F},
                                     glm::vec3(1.0F, 0.9F, 0.7F) * radiance / (edge * edge)));
    }
}

Scene room(Lights lights) {
    test::SceneBuilder builder;
    test::add_open_room(builder);
    Mesh ball = test::icosphere(3, false);
    ball.normals = ball.positions;
    builder.add(std::move(ball), builder.material({0.3F, 0.6F, 0.8F}),
                test::placement(0.35, {-0.4, -0.6, -0.2}));
    test::add_screen(builder);
    switch (lights) {
        case Lights::area_lights:
            add_area_lights(builder, 2);
            break;
        case Lights::many_area_lights:
            add_area_lights(builder, 40);
            break;
        case Lights::chosen:
            add_area_lights(builder, 80);
            break;
        case Lights::mixed: {
            add_area_lights(builder, 1);
            builder.light(LightType::point, {0.5, 0.4, 0.6}, {0.3F, 0.4F, 0.3F});
            PunctualLight& spot = builder.light(LightType::spot, {0.0, 0.9, 0.8},
                                                {2.0F, 1.5F, 1.0F}, {0.1, -1.0, -0.6});
            spot.cos_inner = 0.95F;
            spot.cos_outer = 0.8F;
            builder.light(LightType::directional, {}, {0.5F, 0.5F, 0.7F}, {-0.7, -0.6, -0.2});
            break;
        }
        case Lights::surroundings:
            add_area_lights(builder, 1);
            builder.scene.environment = Environment{{0.2F, 0.3F, 0.4F}};
            break;
    }
    return builder.scene;
}

const FlatScene& flat_room(Lights lights) {
    static std::map<Lights, FlatScene> rooms;
    const auto found = rooms.find(lights);
    return found != rooms.end() ? found->second
                                : rooms.emplace(lights, flatten(room(lights))).first->second;
}

Camera camera() {
    return test::look_at({0.35, 0.1, 2.9}, {0.0, -0.05, 0.0}, 0.75);
}

RenderSettings settings_of(Algorithm algorithm, std::uint32_t width, std::uint32_t height,
                           double threshold = 4.0) {
    RenderSettings settings = test::small_settings(algorithm, width, height);
    settings.sampling.threshold = threshold;
    settings.sampling.vpls_per_set = 24;
    settings.sampling.edge_samples = 0;  // igi has none
    settings.seed = 5;
    return settings;
}

Rendering render_room(Executor& executor, Lights lights, const RenderSettings& settings,
                      std::uint32_t frames = 1) {
    return test::render_flat(executor, flat_room(lights), camera(), settings, frames);
}

std::vector<std::uint64_t> rays_of(const Rendering& rendering) {
    std::vector<std::uint64_t> rays;
    for (const FrameStats& frame : rendering.stats) rays.push_back(frame.rays);
    return rays;
}

/// Tiles of each level, of every adaptive component of every frame.
std::vector<std::array<std::uint32_t, 3>> tiles_of(const Rendering& rendering) {
    std::vector<std::array<std::uint32_t, 3>> tiles;
    for (const FrameStats& frame : rendering.stats)
        for (const LevelStats& levels : frame.levels) tiles.push_back(levels.tiles);
    return tiles;
}

using Size = std::pair<std::uint32_t, std::uint32_t>;

std::string text_of(const Size& size) {
    return std::to_string(size.first) + "x" + std::to_string(size.second);
}

TEST(AisIdentity, TheScenesShowAllLevelsAndLight) {
    for (const auto& [lights, name] : all_lights) {
        const Rendering rendering = render_room(test::shared_executor(TestBackend::own_bvh), lights,
                                                settings_of(Algorithm::ais, 128, 96));
        test::expect_clean(rendering);
        for (const char* layer : {"direct", "indirect"})
            EXPECT_GT(test::mean_of(rendering.layer(layer)), 0.01) << name << ' ' << layer;
        const Rendering full = render_room(test::shared_executor(TestBackend::own_bvh), lights,
                                           settings_of(Algorithm::amax, 128, 96));
        EXPECT_LT(rays_of(rendering), rays_of(full)) << name;
        // Lights that are chosen by power are sampled in full.
        const auto tiles = tiles_of(rendering);
        ASSERT_EQ(tiles.size(), lights == Lights::chosen ? 1U : 2U) << name;
        for (const std::uint32_t count : tiles.back()) EXPECT_GT(count, 0U) << name;
        // Of direct light a tile is coarse or full.
        EXPECT_GT(tiles.front()[0], 0U) << name;
        EXPECT_GT(tiles.front()[2], 0U) << name;
        EXPECT_LT(test::relative_mse(full.layer(""), rendering.layer("")), 0.01) << name;
    }
}

TEST(AisIdentity, AmaxIsInterleavedSampling) {
    for (const TestBackend backend : test::backends())
        for (const auto& [lights, name] : all_lights) {
            Executor& executor = test::shared_executor(backend);
            const Rendering igi =
                render_room(executor, lights, settings_of(Algorithm::igi, 61, 43), 2);
            RenderSettings with_all_vpls = settings_of(Algorithm::amax, 61, 43);
            with_all_vpls.sampling.candidates = 1;  // igi gathers all that its paths leave
            const Rendering amax = render_room(executor, lights, with_all_vpls, 2);
            EXPECT_EQ(test::differing_values(igi.image, amax.image), 0U)
                << test::backend_name(backend) << ' ' << name;
            EXPECT_EQ(rays_of(igi), rays_of(amax));
        }
}

/// The image without what only ais tells of itself.
Image without_levels(Image image) {
    std::erase_if(image.layers, [](const Layer& layer) { return is_overlay_layer(layer.name); });
    return image;
}

TEST(AisIdentity, ThresholdZeroIsFullSampling) {
    for (const TestBackend backend : test::backends())
        for (const auto& [lights, name] : all_lights)
            for (const Size& size : {Size{64, 48}, Size{61, 43}, Size{1, 1}, Size{7, 5}}) {
                if (size.first == 64 && backend != TestBackend::own_bvh) continue;
                Executor& executor = test::shared_executor(backend);
                const Rendering amax = render_room(
                    executor, lights, settings_of(Algorithm::amax, size.first, size.second), 3);
                const Rendering ais = render_room(
                    executor, lights, settings_of(Algorithm::ais, size.first, size.second, 0.0), 3);
                EXPECT_EQ(test::differing_values(amax.image, without_levels(ais.image)), 0U)
                    << test::backend_name(backend) << ' ' << name << ' ' << text_of(size);
                EXPECT_EQ(rays_of(amax), rays_of(ais));
            }
}

TEST(AisIdentity, SmallAndOddImagesAreClean) {
    for (const double threshold : {0.5, 12.0, 1e9})
        for (const Size& size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{2, 2}, Size{7, 5},
                                 Size{8, 8}, Size{9, 9}, Size{3, 64}, Size{65, 17}}) {
            SCOPED_TRACE(text_of(size));
            const Rendering rendering =
                render_room(test::shared_executor(TestBackend::own_bvh), Lights::mixed,
                            settings_of(Algorithm::ais, size.first, size.second, threshold), 2);
            test::expect_clean(rendering);
            // Where the surface is lit by any light at all no pixel may be left out.
            const Rendering full =
                render_room(test::shared_executor(TestBackend::own_bvh), Lights::mixed,
                            settings_of(Algorithm::amax, size.first, size.second), 2);
            std::size_t lost = 0;
            for (std::size_t i = 0; i < full.layer("indirect").size(); ++i)
                lost += full.layer("indirect")[i] > 0.0F && rendering.layer("indirect")[i] <= 0.0F;
            EXPECT_EQ(lost, 0U);
        }
}

/// A floor under an area light so far above that every pixel gets the same light from every point
/// of it.
Scene constant_light() {
    test::SceneBuilder builder;
    builder.add(test::quad_mesh({-0.5F, 0, -0.5F}, {0, 0, 1}, {1, 0, 0}),
                builder.material({0.5F, 0.5F, 0.5F}));
    builder.add(test::quad_mesh({-0.5F, 2000, -0.5F}, {1, 0, 0}, {0, 0, 1}),
                builder.material({0, 0, 0}, glm::vec3(4e6F)));
    return builder.scene;
}

TEST(AisIdentity, ConstantLightIsTheUnionOfAllSets) {
    // Over the floor and the area light cosines and distances differ by less than (1 / 2000)^2.
    const Scene scene = constant_light();
    const Camera above = test::look_at({0, 2, 0}, {0, 0, 0}, 0.3);
    for (const TestBackend backend : test::backends())
        for (const Size& size : {Size{61, 43}, Size{64, 48}, Size{7, 5}}) {
            SCOPED_TRACE(std::string(test::backend_name(backend)) + ' ' + text_of(size));
            const auto direct_of = [&](Algorithm algorithm, double threshold) {
                RenderSettings settings =
                    test::unbounded(settings_of(algorithm, size.first, size.second, threshold));
                settings.indirect = false;
                return test::render(backend, scene, above, settings).layer("direct");
            };
            const std::vector<float> all = direct_of(Algorithm::ir, 0.0);
            const double mean = test::mean_of(all);
            // Irradiance 4e6 / 2000^2 = 1, of which 0.5 / pi is reflected.
            EXPECT_NEAR(mean, 0.5 / std::numbers::pi, 1e-6);
            std::vector<std::vector<float>> others{direct_of(Algorithm::amax, 0.0)};
            for (const double threshold : {0.0, 1e-3, 12.0, 1e9})
                others.push_back(direct_of(Algorithm::ais, threshold));
            for (const std::vector<float>& other : others) {
                double most = 0.0;
                for (std::size_t i = 0; i < all.size(); ++i)
                    most = std::max(most, std::abs(static_cast<double>(other[i]) -
                                                   static_cast<double>(all[i])));
                EXPECT_LE(most, 1e-6 * mean);
                EXPECT_NEAR(test::mean_of(other), mean, 5e-7 * mean);
            }
        }
}

TEST(AisIdentity, InASphereTheMeanStaysAtAnyThreshold) {
    // Indirect light in an integrating sphere is the same everywhere but for the facets of the
    // mesh, see vpl_sphere_test.cpp.
    test::SceneBuilder builder;
    builder.add(test::icosphere(5, true), builder.material({0.5F, 0.5F, 0.5F}));
    builder.light(LightType::point, {0, 0, 0}, glm::vec3(1.0F));
    const FlatScene flat = flatten(builder.scene);
    const Camera inside = test::look_at({0.1, -0.2, 0.3}, {-0.5, 0.3, -0.8}, 1.2);
    for (const double threshold : {0.0, 0.3, 12.0, 1e9}) {
        RenderSettings settings = test::unbounded(settings_of(Algorithm::ais, 61, 43, threshold));
        // All VPLs add alike, so that chance would decide on every one of them.
        settings.sampling.roulette = 0.0;
        const Rendering rendering =
            test::render_flat(test::shared_executor(TestBackend::own_bvh), flat, inside, settings);
        test::expect_clean(rendering);
        double sum = 0.0;
        for (std::uint32_t y = 0; y < 43; ++y)
            for (std::uint32_t x = 0; x < 61; ++x) sum += rendering.irradiance("indirect", x, y);
        // 1/2 + 1/4 + 1/8 + ...; of a lattice fewer pixels share the facets' errors.
        EXPECT_NEAR(sum / (61 * 43), 1.0, 4e-3) << threshold;
    }
}

TEST(AisIdentity, OpenClEqualsTheNativeKernelsBitForBit) {
    if (!test::has_opencl()) GTEST_SKIP() << "no OpenCL device";
    for (const auto& [lights, name] : all_lights)
        for (const double threshold : {0.5, 12.0, 40.0}) {
            const RenderSettings settings = settings_of(Algorithm::ais, 97, 70, threshold);
            const Rendering native =
                render_room(test::shared_executor(TestBackend::own_bvh), lights, settings, 2);
            const Rendering opencl =
                render_room(test::shared_executor(TestBackend::opencl), lights, settings, 2);
            EXPECT_EQ(test::differing_values(native.image, opencl.image), 0U)
                << name << " threshold " << threshold;
            EXPECT_EQ(rays_of(native), rays_of(opencl)) << name << " threshold " << threshold;
            EXPECT_EQ(tiles_of(native), tiles_of(opencl)) << name << " threshold " << threshold;
        }
}

TEST(AisIdentity, EmbreeDiffersAtAlmostNoPixel) {
    for (const auto& [lights, name] : all_lights) {
        const RenderSettings settings = settings_of(Algorithm::ais, 200, 150);
        const Rendering own =
            render_room(test::shared_executor(TestBackend::own_bvh), lights, settings);
        const Rendering embree =
            render_room(test::shared_executor(TestBackend::embree), lights, settings);
        const std::size_t pixels = std::size_t{200} * 150;
        std::size_t different = 0;
        for (std::size_t i = 0; i < pixels; ++i) {
            bool same = true;
            for (std::size_t c = 0; c < 3; ++c) {
                const float a = own.layer("")[c * pixels + i];
                const float b = embree.layer("")[c * pixels + i];
                // Hit points differ by rounding, and light with them.
                same = same && std::abs(a - b) <= 1e-4F * std::max(a, b);
            }
            different += same ? 0 : 1;
        }
        // Rays that graze the ball may differ, and with them whole tiles; of many area lights many
        // do.
        const bool many = lights == Lights::many_area_lights || lights == Lights::chosen;
        // A first look counts in 6 x 6 pixels' footprints, by the filter in 64 pixels.
        EXPECT_LE(different, many ? pixels / 30 : std::size_t{64}) << name;
    }
}

TEST(AisIdentity, TilesOfTheWorkListDoNotMatter) {
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    for (const auto& [lights, name] : all_lights) {
        RenderSettings settings = settings_of(Algorithm::ais, 97, 70);
        const Rendering reference = render_room(executor, lights, settings);
        for (const std::uint32_t tile : {1U, 7U, 1000U}) {
            settings.tile = tile;
            const Rendering other = render_room(executor, lights, settings);
            EXPECT_EQ(test::differing_values(reference.image, other.image), 0U)
                << name << " tile " << tile;
        }
    }
}

TEST(AisIdentity, PacketWidthsDoNotMatter) {
    for (const TestBackend backend : {TestBackend::own_bvh, TestBackend::embree}) {
        std::map<Lights, Rendering> reference;
        for (const std::uint32_t lanes : {1U, 4U, 8U, 16U}) {
            const auto executor = test::make_executor(backend, lanes);
            ASSERT_EQ(executor->lanes(), lanes);
            for (const auto& [lights, name] : all_lights) {
                Rendering rendering =
                    render_room(*executor, lights, settings_of(Algorithm::ais, 97, 70));
                const auto [first, is_new] = reference.try_emplace(lights, std::move(rendering));
                if (is_new) continue;
                EXPECT_EQ(test::differing_values(first->second.image, rendering.image), 0U)
                    << test::backend_name(backend) << ' ' << name << ' ' << lanes;
                EXPECT_EQ(rays_of(first->second), rays_of(rendering)) << name << ' ' << lanes;
            }
        }
    }
}

TEST(AisIdentity, ThreadsAndRepetitionDoNotMatter) {
    for (const TestBackend backend : test::backends()) {
        const RenderSettings settings = settings_of(Algorithm::ais, 97, 70);
        const Rendering one =
            render_room(*test::make_executor(backend, 0, 1), Lights::many_area_lights, settings, 2);
        const auto executor = test::make_executor(backend, 0, 2);
        for (int i = 0; i < 2; ++i) {
            const Rendering two = render_room(*executor, Lights::many_area_lights, settings, 2);
            EXPECT_EQ(test::differing_values(one.image, two.image), 0U)
                << test::backend_name(backend);
        }
    }
}

}  // namespace
}  // namespace weft::ais_identity_test
