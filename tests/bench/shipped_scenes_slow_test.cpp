// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Every scene that ships, of any size and anywhere, is the same image.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "render/camera_params.h"
#include "scene/load/load_scene.h"
#include "scene/pose_scene.h"
#include "selftest/placed_scene.h"
#include "tests/testing/render_fixture.h"

namespace weft::shipped_scenes_slow_test {
namespace {

namespace fs = std::filesystem;
using test::Rendering;
using test::TestBackend;

// Rays that graze an edge may pass where they did not before: that is all that may change.
constexpr double allowed_mse = 1e-4;
// Free paths through a density grid are random walks: a rounding that changes one step changes all
// later ones, and most pixels are another draw. At five scales the smoke differs by 0.5e-4 to
// 2.1e-4, which is its noise.
constexpr double allowed_mse_of_walks = 5e-4;

std::vector<fs::path> shipped_scenes() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(WEFT_SOURCE_DIR) / "scenes"))
        if (entry.path().extension() == ".gltf") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// The scene under a root node that scales and moves all of it. Radiance stays the same where
/// intensities grow with the square of the scale and media thin out with it.
void place(Scene& scene, Camera& camera, double scale, const glm::dvec3& move) {
    const glm::dmat4 root = test::placement(scale, move);
    for (Instance& instance : scene.instances) instance.to_world = root * instance.to_world;
    for (PunctualLight& light : scene.lights) {
        light.position = glm::dvec3(root * glm::dvec4(light.position, 1.0));
        if (light.type != LightType::directional)
            light.intensity *= static_cast<float>(scale * scale);
    }
    for (Medium& medium : scene.media) {
        medium.scale /= static_cast<float>(scale);
        medium.emission /= static_cast<float>(scale);
        medium.grid_to_world = root * medium.grid_to_world;
    }
    for (Material& material : scene.materials) {
        if (!material.description) continue;
        if (auto* const s = std::get_if<MetallicSurface>(&material.description->model))
            s->absorption.distance *= scale;
    }
    for (MediumBoundary& boundary : scene.medium_boundaries)
        boundary.to_world = root * boundary.to_world;
    camera.to_world = root * camera.to_world;
}

Rendering make_image(TestBackend backend, Scene scene, Camera camera, double scale,
                     const glm::dvec3& move) {
    place(scene, camera, scale, move);
    RenderSettings settings = selftest::small_settings(default_algorithm, 48, 48);
    // Rounding decides which of two VPLs is chosen, and then it is another image with other noise.
    settings.sampling.candidates = 1;
    return test::render(backend, scene, camera, settings);
}

void expect_same_everywhere(TestBackend backend, const fs::path& file) {
    SCOPED_TRACE(file.filename().string() + " on " + test::backend_name(backend));
    Diagnostics diagnostics;
    Scene scene = load_scene(file, diagnostics);
    hold_still(scene);
    const Camera camera = choose_camera(scene, flatten(scene), "", diagnostics);
    const glm::dvec3 far_away(1e5, 1e3, -1e5);
    const bool walks = std::any_of(scene.media.begin(), scene.media.end(),
                                   [](const Medium& medium) { return medium.grid >= 0; });
    const double allowed = walks ? allowed_mse_of_walks : allowed_mse;
    // A ray that grazes an edge in a mirror meets another thing there: that pixel alone is then as
    // dark as that is. At these scales it is one pixel of car-paint.
    const bool mirrors = flatten(scene).surfaces.present();
    const std::size_t dark = mirrors ? 1 : 0;
    const Rendering reference = make_image(backend, scene, camera, 1.0, {});
    struct Place {
        double scale;
        glm::dvec3 move;
    };
    for (const Place& where : {Place{1e-3, {}}, Place{1e3, {}}, Place{1.0, far_away}}) {
        SCOPED_TRACE(where.scale);
        const Rendering placed = make_image(backend, scene, camera, where.scale, where.move);
        EXPECT_LE(selftest::relative_mse(reference.layer(""), placed.layer("")), allowed);
        EXPECT_LE(selftest::isolated_dark_pixels(reference, placed), dark);
        EXPECT_EQ(selftest::guarded_values(placed.stats), 0U);
    }
}

TEST(ShippedScenesSlow, AreTheSameImageAnywhere) {
    const std::vector<fs::path> files = shipped_scenes();
    ASSERT_GE(files.size(), 5U);
    // OpenCL and the native build with the same BVH agree bit for bit: one of them is enough.
    for (const TestBackend backend : {TestBackend::own_bvh, TestBackend::embree})
        for (const fs::path& file : files) expect_same_everywhere(backend, file);
}

}  // namespace
}  // namespace weft::shipped_scenes_slow_test
