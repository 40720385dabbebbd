// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "tests/testing/render_fixture.h"

// What is not finite, put past the readers straight into the flattened scene: it is counted by
// component, its first pixel is named, it turns black, and it reaches nothing else.
namespace weft::nonfinite_guard_test {
namespace {

using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr std::uint32_t width = 32;
constexpr std::uint32_t height = 24;
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// A floor of 2 x 2 under light, of which the camera sees all, and a patch in front of it that
/// covers some pixels. Material 0 and instance 0 are the floor, 1 the patch.
struct Patched {
    FlatScene flat;
    Camera camera;
};

Patched patched_scene(LightType light) {
    SceneBuilder builder;
    Mesh floor = test::quad_mesh({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
    floor.colours.assign(floor.positions.size(), glm::vec3(1.0F));
    builder.add(std::move(floor), builder.material(glm::vec3(0.8F)));
    Mesh patch = test::quad_mesh({0.2F, -0.3F, 0.1F}, {0.4F, 0, 0}, {0, 0.5F, 0});
    patch.colours.assign(patch.positions.size(), glm::vec3(1.0F));
    builder.add(std::move(patch), builder.material(glm::vec3(0.6F), glm::vec3(0.25F)));
    builder.light(light, {0.0, 0.0, 2.0}, glm::vec3(5.0F), {0.1, 0.0, -1.0});
    return {flatten(builder.scene), test::look_at({0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, 0.6)};
}

RenderSettings guard_settings() {
    RenderSettings settings = test::small_settings(Algorithm::igi, width, height);
    settings.indirect = false;
    return settings;
}

/// Pixels of the patch, by depth.
struct PatchPixels {
    std::uint32_t count = 0;
    std::uint32_t first = 0;
    std::array<bool, std::size_t{width} * height> covered{};
};

PatchPixels patch_pixels(const Rendering& clean) {
    PatchPixels pixels;
    const std::vector<float>& depth = clean.layer("depth");
    for (std::uint32_t i = 0; i < width * height; ++i) {
        pixels.covered[i] = depth[i] < 2.95F;
        if (!pixels.covered[i]) continue;
        if (pixels.count++ == 0) pixels.first = i;
    }
    return pixels;
}

void expect_all_finite(const Rendering& rendering) {
    for (const Layer& layer : rendering.image.layers) {
        std::size_t bad = 0;
        for (const float value : layer.values) bad += std::isfinite(value) ? 0 : 1;
        EXPECT_EQ(bad, 0U) << "layer \"" << layer.name << '"';
    }
}

/// That `component` counted exactly the patch's pixels in a frame, and the others none.
void expect_counts(const FrameStats& frame, std::size_t component, const PatchPixels& patch) {
    for (std::size_t c = 0; c < frame.nonfinite.size(); ++c)
        EXPECT_EQ(frame.nonfinite[c].count, c == component ? patch.count : 0U) << "component " << c;
    EXPECT_EQ(frame.nonfinite.at(component).first_pixel, patch.first);
}

/// That a layer is black on the patch and untouched elsewhere.
void expect_black_patch(const Rendering& clean, const Rendering& guarded, const char* layer,
                        const PatchPixels& patch) {
    for (std::uint32_t i = 0; i < width * height; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = c * width * height + i;
            ASSERT_EQ(guarded.layer(layer)[at], patch.covered[i] ? 0.0F : clean.layer(layer)[at])
                << layer << " pixel " << i;
        }
}

TEST(NonfiniteGuard, BadEmissionIsCountedAndBlackened) {
    for (const TestBackend backend : test::backends())
        for (const float bad : {not_a_number, infinity, -infinity, -1.0F}) {
            SCOPED_TRACE(std::string(test::backend_name(backend)) + ' ' + std::to_string(bad));
            Patched scene = patched_scene(LightType::directional);
            Executor& executor = test::shared_executor(backend);
            const Rendering clean =
                test::render_flat(executor, scene.flat, scene.camera, guard_settings());
            test::expect_clean(clean);
            const PatchPixels patch = patch_pixels(clean);
            ASSERT_GT(patch.count, 10U);
            ASSERT_GT(patch.first, 0U);
            scene.flat.materials[1].emission.y = bad;
            const Rendering guarded =
                test::render_flat(executor, scene.flat, scene.camera, guard_settings());
            expect_counts(guarded.stats[0], COMPONENT_EMISSION, patch);
            expect_all_finite(guarded);
            expect_black_patch(clean, guarded, "emission", patch);
            EXPECT_EQ(clean.layer("direct"), guarded.layer("direct"));
        }
}

TEST(NonfiniteGuard, BadVertexColoursAreCountedAsDirectLight) {
    for (const LightType light : {LightType::directional, LightType::point})
        for (const TestBackend backend : test::backends())
            for (const float bad : {not_a_number, infinity}) {
                SCOPED_TRACE(std::string(test::backend_name(backend)) + ' ' + std::to_string(bad));
                Patched scene = patched_scene(light);
                Executor& executor = test::shared_executor(backend);
                const Rendering clean =
                    test::render_flat(executor, scene.flat, scene.camera, guard_settings());
                const PatchPixels patch = patch_pixels(clean);
                for (std::size_t v = 4; v < 8; ++v) scene.flat.vertex_colours[3 * v] = bad;
                const Rendering guarded =
                    test::render_flat(executor, scene.flat, scene.camera, guard_settings());
                // Reflectance belongs to both components of reflected light.
                const auto& counts = guarded.stats[0].nonfinite;
                EXPECT_EQ(counts[COMPONENT_EMISSION].count, 0U);
                EXPECT_EQ(counts[COMPONENT_DIRECT].count, patch.count);
                EXPECT_EQ(counts[COMPONENT_DIRECT].first_pixel, patch.first);
                expect_all_finite(guarded);
                expect_black_patch(clean, guarded, "direct", patch);
                EXPECT_EQ(clean.layer("emission"), guarded.layer("emission"));
                EXPECT_EQ(clean.layer("depth"), guarded.layer("depth"));
            }
}

TEST(NonfiniteGuard, BadLightIsCountedWhereItShines) {
    for (const TestBackend backend : test::backends()) {
        Patched scene = patched_scene(LightType::directional);
        Executor& executor = test::shared_executor(backend);
        scene.flat.lights.back().power.y = not_a_number;
        const Rendering guarded =
            test::render_flat(executor, scene.flat, scene.camera, guard_settings());
        EXPECT_EQ(guarded.stats[0].nonfinite[COMPONENT_DIRECT].count, width * height);
        EXPECT_EQ(guarded.stats[0].nonfinite[COMPONENT_DIRECT].first_pixel, 0U);
        expect_all_finite(guarded);
        EXPECT_EQ(test::mean_of(guarded.layer("direct")), 0.0);
    }
}

TEST(NonfiniteGuard, EveryFrameCountsItsOwn) {
    Patched scene = patched_scene(LightType::directional);
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const PatchPixels patch =
        patch_pixels(test::render_flat(executor, scene.flat, scene.camera, guard_settings()));
    scene.flat.materials[1].emission.x = not_a_number;
    const Rendering guarded =
        test::render_flat(executor, scene.flat, scene.camera, guard_settings(), 5);
    ASSERT_EQ(guarded.stats.size(), 5U);
    for (const FrameStats& frame : guarded.stats) expect_counts(frame, COMPONENT_EMISSION, patch);
    expect_all_finite(guarded);
}

TEST(NonfiniteGuard, ABadSurfaceDoesNotBlackenTheRestByItsVpls) {
    // Light that the patch would reflect is unknown; what all else reflects is not. At most the
    // pixels that see the patch may be lost, not the image: a VPL that is not finite is none.
    struct Case {
        float value;
        std::size_t channels;
    };
    SceneBuilder builder;
    Mesh room = test::room_mesh();
    room.colours.assign(room.positions.size(), glm::vec3(1.0F));
    builder.add(std::move(room), builder.material(glm::vec3(0.7F)));
    Mesh patch = test::quad_mesh({-0.3F, -0.99F, 0.3F}, {0.6F, 0, 0}, {0, 0, -0.6F});
    patch.colours.assign(patch.positions.size(), glm::vec3(1.0F));
    builder.add(std::move(patch), builder.material(glm::vec3(0.7F)));
    builder.light(LightType::point, {0.0, 0.4, 0.0}, glm::vec3(1.0F));
    const FlatScene clean = flatten(builder.scene);
    for (const TestBackend backend : test::backends())
        for (const Case& c :
             {Case{not_a_number, 3}, Case{not_a_number, 1}, Case{infinity, 3}, Case{infinity, 1}}) {
            SCOPED_TRACE(std::string(test::backend_name(backend)) + ' ' + std::to_string(c.value) +
                         " in " + std::to_string(c.channels));
            FlatScene flat = clean;
            for (std::size_t v = flat.vertex_colours.size() - 12; v < flat.vertex_colours.size();
                 v += 3)
                for (std::size_t k = 0; k < c.channels; ++k) flat.vertex_colours[v + k] = c.value;
            const Rendering guarded =
                test::render_flat(test::shared_executor(backend), flat,
                                  test::look_at({0.0, 0.0, 0.95}, {0.0, -0.2, 0.0}, 1.2),
                                  test::small_settings(Algorithm::igi, width, height));
            expect_all_finite(guarded);
            const auto& counts = guarded.stats[0].nonfinite;
            EXPECT_GT(counts[COMPONENT_DIRECT].count, 0U);
            EXPECT_EQ(counts[COMPONENT_INDIRECT].count, counts[COMPONENT_DIRECT].count);
            EXPECT_GT(test::mean_of(guarded.layer("indirect")), 0.01);
        }
}

}  // namespace
}  // namespace weft::nonfinite_guard_test
