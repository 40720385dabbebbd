// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>

#include "tests/testing/media_builder.h"
#include "tests/testing/path_fixture.h"
#include "tests/testing/scattered_light.h"
#include "tests/testing/smoky_room.h"

// Previews of scenes with participating media against path tracing.
namespace weft::media_slow_test {
namespace {

using test::Rendering;
using test::scattered_mean;
using test::TestBackend;

/// That previews without bounds have the mean of path tracing. 2.5 % may be off: light of more
/// bounces than VPLs have, which is less than 0.5^9 of all where nothing reflects or scatters more
/// than half, and noise. Six seeds of 64 frames scatter by .9 % at most, six of path tracing by
/// .8 %, which is .4 and .5 % with the samples here: 2.5 % are about four standard errors.
void expect_mean_of_path(Scene scene) {
    constexpr double share = 0.025;
    for (Material& material : scene.materials)
        set_diffuse_albedo(material, diffuse_albedo(material) * 0.5F);
    for (Medium& medium : scene.media) medium.albedo *= 0.5F;
    const Camera camera = test::room_camera();
    const Rendering path =
        test::path_image(TestBackend::embree, scene, camera, test::path_settings(16, 16, 4096));
    RenderSettings settings = test::unbounded(test::small_settings(Algorithm::igi, 16, 16));
    settings.sampling.bounces = MAX_BOUNCES;
    settings.samples = 384;
    const Rendering igi =
        test::render(TestBackend::embree, scene, camera, settings, settings.samples);
    for (std::uint32_t c = 0; c < 3; ++c) {
        const double expected = scattered_mean(path, c);
        EXPECT_NEAR(scattered_mean(igi, c), expected, share * expected) << "channel " << c;
    }
}

TEST(MediaSlow, FogInARoomHasTheMeanOfPathTracing) {
    Scene scene = test::foggy_room().scene;
    scene.outer_medium = 0;
    expect_mean_of_path(scene);
}

TEST(MediaSlow, BoundedFogHasTheMeanOfPathTracing) {
    Scene scene = test::foggy_room().scene;
    test::add_boundary(scene, test::cube_mesh(), test::placement(0.6, {0.1, -0.2, 0.1}), 0);
    expect_mean_of_path(scene);
}

TEST(MediaSlow, SmokeHasTheMeanOfPathTracing) {
    expect_mean_of_path(test::smoky_room());
}

}  // namespace
}  // namespace weft::media_slow_test
