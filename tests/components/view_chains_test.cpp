// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/view_chains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>
#include <vector>

#include "selftest/optics_scenes.h"
#include "tests/testing/path_fixture.h"
#include "tests/testing/render_fixture.h"
#include "tests/testing/surface_scenes.h"

// What previews show in mirrors and through glass, against scenes without either.
namespace weft::view_chains_test {
namespace {

using test::Rendering;
using test::SceneBuilder;

RenderSettings settings_of(Algorithm algorithm, std::uint32_t edge = 48) {
    RenderSettings how = test::small_settings(algorithm, edge, edge);
    how.sampling.vpls_per_set = 32;
    return how;
}

Rendering render(const Scene& scene, const Camera& camera, const RenderSettings& how,
                 std::uint32_t frames = 1) {
    return test::render(test::shared_executor(test::TestBackend::own_bvh), scene, camera, how,
                        frames);
}

glm::dvec3 mean_colour(const Rendering& rendering, std::string_view layer = "") {
    glm::dvec3 mean(0.0);
    for (std::uint32_t c = 0; c < 3; ++c) {
        const std::vector<double> values = test::channel_of(rendering, layer, c);
        for (const double value : values) mean[static_cast<int>(c)] += value;
        mean[static_cast<int>(c)] /= static_cast<double>(values.size());
    }
    return mean;
}

/// A floor with a block on it under a lamp and a point light, reflected at the plane x = 0 where
/// `mirrored`.
SceneBuilder lit_things(bool mirrored) {
    SceneBuilder builder;
    glm::dmat4 place(1.0);
    if (mirrored) place[0][0] = -1.0;
    builder.add(test::quad_mesh({0.0F, -1.0F, -3.0F}, {0.0F, 0.0F, 6.0F}, {4.0F, 0.0F, 0.0F}, 4),
                builder.material({0.6F, 0.5F, 0.4F}), place);
    glm::dmat4 block = glm::translate(place, glm::dvec3(1.5, -0.6, 0.2));
    block = glm::scale(block, glm::dvec3(0.4));
    builder.add(test::block_mesh(), builder.material({0.2F, 0.6F, 0.3F}), block);
    builder.add(test::quad_mesh({1.0F, 1.5F, -0.5F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}),
                builder.material(glm::vec3(0.0F), glm::vec3(6.0F)), place);
    const double side = mirrored ? -1.0 : 1.0;
    builder.light(LightType::point, glm::dvec3(side * 2.5, 0.8, -1.0), glm::vec3(1.0F));
    return builder;
}

// What a flat mirror shows is the scene behind it. The camera sees nothing but the mirror.
TEST(ViewChains, AMirrorShowsTheMirroredScene) {
    const Camera camera = test::look_at({2.0, 0.6, 2.6}, {0.0, 0.0, 0.6}, 0.3);
    for (const Algorithm algorithm : {Algorithm::ais, Algorithm::amax, Algorithm::igi}) {
        SCOPED_TRACE(static_cast<int>(algorithm));
        RenderSettings how = settings_of(algorithm, 64);
        how.indirect = false;  // a VPL on the mirror's own side would have no counterpart
        how.sampling.threshold = 0.0;
        how.sampling.edge_samples = 0;
        SceneBuilder with = lit_things(false);
        with.add(test::quad_mesh({0.0F, -6.0F, -6.0F}, {0.0F, 12.0F, 0.0F}, {0.0F, 0.0F, 12.0F}),
                 test::add_surface(with, test::metal(0.0F)));
        const Rendering seen = render(with.scene, camera, how, 4);
        const Rendering behind = render(lit_things(true).scene, camera, how, 4);
        EXPECT_EQ(test::unclean_values(seen.image), 0U);
        const glm::dvec3 a = mean_colour(seen);
        const glm::dvec3 b = mean_colour(behind);
        // Direct light is filtered with other neighbours in the two, and the lamp's points differ.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 0.01 * b[c]) << c;
        std::size_t far = 0;
        const std::vector<double> x = test::channel_of(seen, "", 1);
        const std::vector<double> y = test::channel_of(behind, "", 1);
        for (std::size_t i = 0; i < x.size(); ++i)
            if (std::abs(x[i] - y[i]) > 0.1 * std::max(x[i], y[i])) ++far;
        EXPECT_LT(far, x.size() / 20);
        const std::vector<float>& reflection = seen.layer("reflection");
        EXPECT_NEAR(test::mean_of(reflection), test::mean_of(seen.layer("")), 1e-6)
            << "all light comes by the mirror";
    }
}

TEST(ViewChains, APolishedSphereIsInvisibleInEvenLight) {
    for (const float roughness : {0.0F, 0.3F}) {
        SceneBuilder builder;
        builder.add(test::smooth_sphere(4), test::add_surface(builder, test::metal(roughness)));
        builder.scene.environment = Environment{glm::vec3(1.0F)};
        const Rendering seen =
            render(builder.scene, test::look_at({0.3, 0.2, 4.0}, {0.0, 0.0, 0.0}, 0.7),
                   settings_of(Algorithm::ais), 2);
        // At the rim a pixel sees 18 facets, some of which reflect downwards.
        const float tolerance = roughness > 0.0F ? 0.15F : 2e-3F;
        for (const float value : seen.layer("")) EXPECT_NEAR(value, 1.0F, tolerance) << roughness;
        EXPECT_NEAR(test::mean_of(seen.layer("")), 1.0, 0.01) << roughness;
    }
}

// In the mean over samples the choice of one number for all pixels brings all internal reflections.
TEST(ViewChains, ASlabOfGlassTransmitsWhatFresnelSays) {
    for (const double cosine : {1.0, 0.5}) {
        RenderSettings how = settings_of(Algorithm::ais, 8);
        how.samples = 256;
        const Rendering seen = render(test::slab_before_a_wall(test::glass(1.5)),
                                      test::oblique_camera(cosine), how, 256);
        const double f = test::fresnel_reflectance(1.0, 1.5, cosine);
        EXPECT_NEAR(mean_colour(seen).g, (1.0 - f) / (1.0 + f), 0.01) << cosine;
        EXPECT_NEAR(mean_colour(seen, "refraction").g, (1.0 - f) / (1.0 + f), 0.01) << cosine;
    }
}

TEST(ViewChains, GapsShowWhatIsBehindThemByTheirShare) {
    SceneBuilder builder = test::bright_wall();
    for (const double height : {0.0, 0.5})
        builder.add(test::quad_mesh({-20, -20, static_cast<float>(height)}, {40, 0, 0}, {0, 40, 0}),
                    test::add_surface(builder, test::sheet(0.3F)));
    // At the second sheet one number chooses between black and what lies behind.
    RenderSettings how = settings_of(Algorithm::ais, 8);
    how.samples = 64;
    const Rendering seen = render(builder.scene, test::oblique_camera(1.0), how, 64);
    EXPECT_NEAR(mean_colour(seen).g, 0.7 * 0.7, 1e-3);
}

TEST(ViewChains, AbsorbingGlassTakesItsShareOnTheWay) {
    const glm::vec3 colour(0.9F, 0.5F, 0.7F);
    RenderSettings how = settings_of(Algorithm::igi, 8);
    how.samples = 256;
    const Rendering seen =
        render(test::slab_before_a_wall(test::absorbing_glass(1.5F, colour, 0.2)),
               test::oblique_camera(1.0), how, 256);
    const double f = 0.04;
    for (int c = 0; c < 3; ++c) {
        const double a = static_cast<double>(colour[c]);
        const double expected = a * (1.0 - f) * (1.0 - f) / (1.0 - a * a * f * f);
        EXPECT_NEAR(mean_colour(seen)[c], expected, 0.01) << c;
    }
}

// Two mirrors that face each other show each other: chains of several mirrors.
TEST(ViewChains, MirrorsShowEachOther) {
    SceneBuilder builder;
    const std::uint32_t mirror = test::add_surface(builder, test::grey_mirror(0.5F));
    builder.add(test::quad_mesh({-1, -30, -30}, {0, 60, 0}, {0, 0, 60}), mirror);
    builder.add(test::quad_mesh({1, -30, -30}, {0, 60, 0}, {0, 0, 60}), mirror);
    builder.scene.environment = Environment{glm::vec3(1.0F)};
    // The ray meets the left mirror at z = 0 and leaves the slit after `mirrors` reflections.
    const glm::dvec3 along = glm::normalize(glm::dvec3(-1.0, 0.0, -12.0));
    const glm::dvec3 at(-1.0, 0.0, 0.0);
    const Rendering seen = render(builder.scene, test::look_at(at - 4.0 * along, at, 1e-4),
                                  settings_of(Algorithm::amax, 4), 1);
    // It reaches z = -30 after 30 / 12 = 2.5 widths of half the slit: the mirrors at x = -1 and 1.
    EXPECT_NEAR(mean_colour(seen).g, 0.25, 1e-4);
}

// A material that becomes rougher changes from one treatment to the next: at 2^-12 from smooth
// facets to rough ones, and at 0.001 from mirrors to gloss. At 1/4 it changes where it is seen in a
// mirror. The mean of an image in which a ball of it takes a tenth may not jump by 2 %.
TEST(ViewChains, RoughnessCrossesItsClassesWithoutAStep) {
    const Camera camera = test::look_at({2.0, 0.6, 3.6}, {1.4, -0.5, 0.8}, 0.7);
    for (const double alpha : {std::ldexp(1.0, -12), 0.001, 0.25}) {
        std::vector<glm::dvec3> means;
        for (const double side : {0.99, 1.01}) {
            SceneBuilder builder = lit_things(false);
            // Facets show a light without size, mirrors do not.
            if (alpha < 0.01) builder.scene.lights.clear();
            builder.scene.environment = Environment{glm::vec3(0.3F)};
            const auto roughness = static_cast<float>(std::sqrt(side * alpha));
            builder.add(test::smooth_sphere(3),
                        test::add_surface(builder, test::metal(roughness, glm::vec3(0.9F))),
                        test::placement(0.35, {1.4, -0.65, 1.2}));
            means.push_back(
                mean_colour(render(builder.scene, camera, settings_of(Algorithm::ais), 4)));
        }
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(means[0][c], means[1][c], 0.02 * means[1][c]) << alpha;
    }
}

/// Adds a light whose image on the floor is in the middle of what the test's camera sees.
void add_light(SceneBuilder& builder, int kind) {
    const glm::dvec3 above(0.2, 2.0, -2.4);
    if (kind == 0) builder.light(LightType::point, above, glm::vec3(4.0F));
    if (kind == 1) builder.light(LightType::directional, above, glm::vec3(2.0F), -above);
    if (kind == 2)
        builder.add(test::quad_mesh({0.1F, 2.0F, -2.5F}, {0.2F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.2F}),
                    builder.material(glm::vec3(0.0F), glm::vec3(100.0F)));
}

// What a rough metal shows of lights is what path tracing has: of lights without size, which no ray
// meets, of small ones, which few meet, and at all roughnesses. The bound is about four times the
// error of the mean by so many samples of either, with what the filter errs by at the image's edge;
// the seeds are fixed.
TEST(ViewChains, RoughMetalsShowLightsAsPathsDo) {
    const Camera camera = test::look_at({0.0, 1.2, 1.6}, {0.0, 0.0, 0.0}, 0.5);
    for (const int kind : {0, 1, 2})
        for (const float roughness : {0.2F, 0.5F, 0.9F}) {
            SceneBuilder builder;
            builder.add(
                test::quad_mesh({-3.0F, 0.0F, -3.0F}, {0.0F, 0.0F, 6.0F}, {6.0F, 0.0F, 0.0F}),
                test::add_surface(builder, test::metal(roughness, glm::vec3(0.9F, 0.6F, 0.3F))));
            add_light(builder, kind);
            RenderSettings how = settings_of(Algorithm::ais, 96);
            how.samples = 8;
            const glm::dvec3 seen = mean_colour(render(builder.scene, camera, how, 8));
            const glm::dvec3 truth =
                mean_colour(test::path_image(test::TestBackend::own_bvh, builder.scene, camera,
                                             selftest::path_settings(24, 24, 1024)));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(seen[c], truth[c], 0.02 * truth[c])
                    << "light " << kind << ", roughness " << roughness;
        }
}

TEST(ViewChains, SameBitsWhateverTheBackend) {
    SceneBuilder builder = lit_things(false);
    builder.add(test::smooth_sphere(3), test::add_surface(builder, test::metal(0.2F)),
                test::placement(0.4, {1.2, -0.6, 1.4}));
    builder.add(test::smooth_sphere(3), test::add_surface(builder, test::glass(1.5)),
                test::placement(0.3, {2.0, -0.7, 1.6}));
    const Camera camera = test::look_at({2.0, 0.6, 3.6}, {1.4, -0.5, 0.8}, 0.7);
    const RenderSettings how = settings_of(Algorithm::ais);
    const Rendering first = render(builder.scene, camera, how, 2);
    test::expect_clean(first);
    for (const char* const layer : {"reflection", "refraction", "glossy"})
        EXPECT_GT(test::mean_of(first.layer(layer)), 0.0) << layer;
    for (const test::TestBackend backend : test::backends()) {
        const Rendering other =
            test::render(test::shared_executor(backend), builder.scene, camera, how, 2);
        EXPECT_EQ(test::differing_values(first.image, other.image), 0U)
            << test::backend_name(backend);
    }
}

// What a varnished wall reflects is as bright whatever its own colour, but errors of it are less
// visible on top of white than on top of black, so that fewer pixels need samples.
TEST(ViewChains, ADimReflectionOnABrightSurfaceIsSampledLess) {
    std::vector<std::uint64_t> samples;
    for (const float albedo : {0.0F, 0.9F}) {
        SceneBuilder builder = lit_things(false);
        SurfaceDescription varnish;
        MetallicSurface surface;
        surface.base_colour.factor = glm::vec3(albedo);
        surface.metallic.factor = 0.0F;
        surface.roughness.value.factor = 0.0F;
        varnish.model = surface;
        builder.add(test::quad_mesh({0.0F, -6.0F, -6.0F}, {0.0F, 12.0F, 0.0F}, {0.0F, 0.0F, 12.0F}),
                    test::add_surface(builder, varnish));
        RenderSettings how = settings_of(Algorithm::ais, 96);
        how.sampling.threshold = 1.0;
        const Rendering seen =
            render(builder.scene, test::look_at({2.0, 0.6, 2.6}, {0.0, 0.0, 0.6}, 0.5), how);
        for (const LevelStats& level : seen.stats[0].levels)
            if (level.component == "reflection") samples.push_back(level.samples);
    }
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_LT(4 * samples[1], 3 * samples[0]);
}

TEST(ViewChains, ComponentsThatAreLeftOutLeaveTheOthersAlone) {
    SceneBuilder builder = lit_things(false);
    builder.add(test::smooth_sphere(3), test::add_surface(builder, test::metal(0.0F)),
                test::placement(0.4, {1.2, -0.6, 1.4}));
    const Camera camera = test::look_at({2.0, 0.6, 3.6}, {1.4, -0.5, 0.8}, 0.7);
    RenderSettings how = settings_of(Algorithm::ais);
    const Rendering with = render(builder.scene, camera, how);
    how.reflection = false;
    const Rendering without = render(builder.scene, camera, how);
    EXPECT_EQ(without.image.find("reflection"), nullptr);
    for (const char* const layer : {"direct", "indirect", "emission"})
        EXPECT_EQ(with.layer(layer), without.layer(layer)) << layer;
}

}  // namespace
}  // namespace weft::view_chains_test
