// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "image/background.h"
#include "render/camera_params.h"
#include "tests/testing/media_builder.h"
#include "tests/testing/moving_room.h"
#include "tests/testing/path_fixture.h"

// Orthographic cameras: what they show has a known place, size and depth.
namespace weft::orthographic_test {
namespace {

using test::TestBackend;

constexpr std::uint32_t width = 48;
constexpr std::uint32_t height = 36;

/// A camera at (0, 0, 5) that looks along -z and shows 4 units by 3: a pixel is 1/12.
Camera parallel_camera() {
    Camera camera = test::look_at({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 0.8);
    camera.half_extent = {2.0, 1.5};
    return camera;
}

/// A regular polygon of 256 corners in a plane of constant z, facing +z.
Mesh disc(const glm::vec3& centre, float radius) {
    constexpr std::uint32_t corners = 256;
    Mesh mesh;
    mesh.positions.push_back(centre);
    for (std::uint32_t i = 0; i < corners; ++i) {
        const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / corners;
        mesh.positions.push_back(centre +
                                 radius * glm::vec3(std::cos(angle), std::sin(angle), 0.0F));
        mesh.triangles.push_back({0, i + 1, (i + 1) % corners + 1});
    }
    return mesh;
}

/// An image by each algorithm that has rays of its own: edges smoothed by ais, samples of path.
std::vector<Image> images(TestBackend backend, const Scene& scene, const Camera& camera,
                          std::uint32_t samples) {
    PathSettings path;
    path.width = width;
    path.height = height;
    path.samples = {0, samples};
    return {
        test::render(backend, scene, camera, test::small_settings(Algorithm::ais, width, height))
            .image,
        test::path_image(backend, scene, camera, path).image};
}

TEST(Orthographic, ParametersAreThoseOfTheExtent) {
    test::SceneBuilder builder;
    builder.add(test::quad_mesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), builder.material({1, 1, 1}));
    const FlatScene flat = flatten(builder.scene);
    Camera camera = parallel_camera();
    camera.near_plane = 2.0;
    const auto at = [&](std::uint32_t w, std::uint32_t h) {
        return scene_params(flat, camera, w, h).camera;
    };
    const double scale = flat.units.scale;
    EXPECT_NEAR(at(48, 36).right.x, 2.0 * scale, 1e-6);
    EXPECT_NEAR(at(48, 36).up.y, 1.5 * scale, 1e-6);
    EXPECT_NEAR(at(48, 36).pixel_angle, scale / 12.0, 1e-7);
    EXPECT_NEAR(at(48, 36).origin.z, 3.0 * scale, 1e-6);
    EXPECT_NEAR(at(48, 36).origin.w, 2.0 * scale, 1e-6);
    // Of another aspect, the image shows more than asked for, and pixels stay square.
    EXPECT_NEAR(at(40, 40).right.x, 2.0 * scale, 1e-6);
    EXPECT_NEAR(at(40, 40).up.y, 2.0 * scale, 1e-6);
    EXPECT_NEAR(at(80, 40).right.x, 3.0 * scale, 1e-6);
    EXPECT_NEAR(at(80, 40).up.y, 1.5 * scale, 1e-6);
}

TEST(Orthographic, PointsProjectLinearlyAtAnyDepth) {
    // Three squares of 6 x 6 pixels at depths of 1, 5 and 90, with edges between pixels.
    test::SceneBuilder builder;
    const std::uint32_t material = builder.material({0.5F, 0.5F, 0.5F});
    builder.light(LightType::directional, {0, 0, 9}, {1.0F, 1.0F, 1.0F});
    const double corners[3][3] = {{-1.5, 0.5, 4.0}, {0.0, -1.0, 0.0}, {1.0, 0.75, -85.0}};
    for (const auto& c : corners)
        builder.add(test::quad_mesh(glm::vec3(c[0], c[1], c[2]), {0.5F, 0, 0}, {0, 0.5F, 0}),
                    material);
    for (const TestBackend backend : test::backends())
        for (const Image& image : images(backend, builder.scene, parallel_camera(), 4)) {
            SCOPED_TRACE(test::backend_name(backend));
            std::size_t wrong = 0;
            for (std::uint32_t y = 0; y < height; ++y)
                for (std::uint32_t x = 0; x < width; ++x) {
                    double depth = 0.0;
                    for (const auto& c : corners) {
                        const double px = (x + 0.5) / 12.0 - 2.0 - c[0];
                        const double py = 1.5 - (y + 0.5) / 12.0 - c[1];
                        if (px > 0.0 && px < 0.5 && py > 0.0 && py < 0.5) depth = 5.0 - c[2];
                    }
                    const std::size_t at = std::size_t{y} * width + x;
                    const auto alpha = static_cast<double>(alpha_of(image)[at]);
                    const auto found = static_cast<double>(image.find("depth")->values[at]);
                    wrong +=
                        std::abs(found - depth) > 1e-4 * depth || alpha != (depth > 0.0 ? 1.0 : 0.0)
                            ? 1
                            : 0;
                }
            EXPECT_EQ(wrong, 0U);
        }
}

TEST(Orthographic, ADiscHasItsAreaInPixels) {
    for (const double z : {3.0, -40.0}) {
        test::SceneBuilder builder;
        builder.add(disc(glm::vec3(0.11, -0.07, z), 1.2F), builder.material({0.5F, 0.5F, 0.5F}));
        builder.light(LightType::directional, {0, 0, 9}, {1.0F, 1.0F, 1.0F});
        const double area = std::numbers::pi * 1.2 * 1.2 * 144.0;
        for (const TestBackend backend : test::backends())
            for (const Image& image : images(backend, builder.scene, parallel_camera(), 64)) {
                double covered = 0.0;
                for (const float a : alpha_of(image)) covered += static_cast<double>(a);
                // 130 pixels at its edge, each off by a fraction with a deviation of at most 0.1:
                // five times 1.2 pixels.
                EXPECT_NEAR(covered, area, 6.0) << test::backend_name(backend);
            }
    }
}

TEST(Orthographic, RaysAreParallel) {
    // Into a shaft with walls along the axis one sees its bottom alone, whole and at one depth; and
    // a slanted plane has a depth that is linear.
    test::SceneBuilder shaft;
    const std::uint32_t material = shaft.material({0.5F, 0.5F, 0.5F});
    shaft.light(LightType::point, {0, 0, 3}, {9.0F, 9.0F, 9.0F});
    shaft.add(test::quad_mesh({-2, -1.5F, -20}, {4, 0, 0}, {0, 3, 0}), material);
    for (const float side : {-1.0F, 1.0F})
        shaft.add(test::quad_mesh({2.0001F * side, -2, -20}, {0, 0, 24}, {0, 4, 0}), material);
    test::SceneBuilder slope;
    slope.add(test::quad_mesh({-4, -4, -4}, {8, 0, 8}, {0, 8, 0}), material);
    slope.scene.materials = shaft.scene.materials;
    slope.scene.lights = shaft.scene.lights;
    for (const TestBackend backend : test::backends()) {
        const RenderSettings settings = test::small_settings(Algorithm::igi, width, height);
        const Image seen = test::render(backend, shaft.scene, parallel_camera(), settings).image;
        for (const float depth : seen.find("depth")->values) ASSERT_NEAR(depth, 25.0F, 1e-4F);
        const Image slanted = test::render(backend, slope.scene, parallel_camera(), settings).image;
        for (std::uint32_t x = 0; x < width; ++x)
            ASSERT_NEAR(slanted.find("depth")->values[x], 5.0 - ((x + 0.5) / 12.0 - 2.0), 1e-4);
    }
}

TEST(Orthographic, TheNearPlaneCutsAndDepthCountsFromTheCamera) {
    test::SceneBuilder builder;
    const std::uint32_t material = builder.material({0.5F, 0.5F, 0.5F});
    builder.light(LightType::directional, {0, 0, 9}, {1.0F, 1.0F, 1.0F});
    builder.add(test::quad_mesh({-9, -9, 4}, {18, 0, 0}, {0, 18, 0}), material);
    builder.add(test::quad_mesh({-9, -9, 1}, {18, 0, 0}, {0, 18, 0}), material);
    Camera camera = parallel_camera();
    for (const double near_plane : {0.5, 2.0}) {
        camera.near_plane = near_plane;
        for (const TestBackend backend : test::backends())
            for (const Image& image : images(backend, builder.scene, camera, 2))
                for (const float depth : image.find("depth")->values)
                    ASSERT_NEAR(depth, near_plane > 1.0 ? 4.0 : 1.0, 1e-5);
    }
}

/// A camera from so far away that its rays are nearly parallel, with the same view of the middle.
Camera distant_camera(const Camera& parallel, double distance) {
    Camera camera = parallel;
    camera.half_extent = glm::dvec2(0.0);
    camera.to_world[3] += distance * camera.to_world[2];
    const double middle = distance + 5.0;
    camera.fov = 2.0 * std::atan(parallel.half_extent.y / middle);
    return camera;
}

TEST(Orthographic, LightIsThatOfADistantCamera) {
    // Footprints, the discontinuity filter, edges and records: all have to be as from far away.
    test::SceneBuilder builder;
    const std::uint32_t grey = builder.material({0.6F, 0.5F, 0.4F});
    const std::uint32_t red = builder.material({0.7F, 0.1F, 0.1F});
    builder.add(test::quad_mesh({-3, -2, -3}, {6, 0, 0}, {0, 0, 6}), grey);
    builder.add(test::quad_mesh({-3, -2, -3}, {6, 0, 0}, {0, 4, 0}), grey);
    builder.add(test::icosphere(3, false), red, test::placement(0.8, {0.2, -1.0, -1.0}));
    builder.light(LightType::point, {1.5, 1.5, 1.0}, {20.0F, 20.0F, 20.0F});
    const Camera camera = parallel_camera();
    const Camera far = distant_camera(camera, 2000.0);
    for (const Algorithm algorithm : {Algorithm::ais, Algorithm::igi, Algorithm::ic}) {
        const RenderSettings settings = test::small_settings(algorithm, width, height);
        const Image parallel =
            test::render(TestBackend::own_bvh, builder.scene, camera, settings).image;
        const Image distant =
            test::render(TestBackend::own_bvh, builder.scene, far, settings).image;
        EXPECT_GT(test::mean_of(parallel.find("indirect")->values), 0.005);
        EXPECT_LT(test::relative_mse(distant.find("")->values, parallel.find("")->values), 2e-3)
            << static_cast<int>(algorithm);
    }
}

TEST(Orthographic, LightInMediaIsThatOfPathTracing) {
    test::SceneBuilder builder;
    const std::uint32_t grey = builder.material({0.6F, 0.5F, 0.4F});
    builder.add(test::quad_mesh({-3, -2, -3}, {6, 0, 0}, {0, 4, 0}), grey);
    builder.light(LightType::point, {0.5, 0.4, -0.5}, {3.0F, 3.0F, 3.0F});
    builder.light(LightType::directional, {0, 0, 9}, {0.5F, 0.5F, 0.5F}, {0.3, -1.0, -0.4});
    builder.scene.media.push_back(test::medium_of(glm::vec3(0.4F), glm::vec3(0.8F), 0.3F));
    test::add_boundary(builder.scene, test::cube_mesh(), test::placement(1.5, glm::dvec3(0.0)), 0);
    for (const bool convex : {true, false}) {
        if (!convex) test::add_far_overlap(builder.scene);
        RenderSettings settings =
            test::unbounded(test::small_settings(Algorithm::ais, width, height));
        settings.samples = 32;
        const Image image =
            test::render(TestBackend::own_bvh, builder.scene, parallel_camera(), settings, 32)
                .image;
        PathSettings path;
        path.width = width;
        path.height = height;
        path.samples = {0, 256};
        const double traced = test::mean_of(
            test::path_image(TestBackend::own_bvh, builder.scene, parallel_camera(), path)
                .image.find("")
                ->values);
        EXPECT_GT(test::mean_of(image.find("media")->values), 0.05);
        // One percent of VPLs, three standard errors of paths.
        EXPECT_NEAR(test::mean_of(image.find("")->values), traced, 0.02 * traced) << convex;
    }
}

TEST(Orthographic, TexturesAreAveragedOverAPixel) {
    // A checkerboard of texels much smaller than a pixel is grey, however far away it lies.
    test::SceneBuilder builder;
    const std::uint32_t material = builder.material({1.0F, 1.0F, 1.0F});
    Texture texture;
    texture.width = 256;
    texture.height = 256;
    for (std::uint32_t i = 0; i < 256 * 256; ++i) {
        const std::uint8_t value = (i % 256 + i / 256) % 2 == 0 ? 255 : 0;
        texture.rgba.insert(texture.rgba.end(), {value, value, value, 255});
    }
    texture.srgb = false;
    builder.scene.textures.push_back(texture);
    std::get<DiffuseSurface>(builder.scene.materials[material].surface).albedo_texture = 0;
    builder.light(LightType::directional, {0, 0, 9}, {1.0F, 1.0F, 1.0F});
    builder.add(test::quad_mesh({-3, -3, -300}, {6, 0, 0}, {0, 6, 0}), material);
    const Image image = test::render(TestBackend::own_bvh, builder.scene, parallel_camera(),
                                     test::small_settings(Algorithm::igi, width, height))
                            .image;
    for (const float albedo : image.find("albedo")->values) ASSERT_NEAR(albedo, 0.5F, 0.01F);
}

TEST(Orthographic, BackendsAndWidthsMakeTheSameImage) {
    const Scene scene = test::moving_room(2).scene;
    Camera camera = test::look_at({0.1, 0.2, 0.9}, {0.0, -0.2, 0.0}, 0.8);
    camera.half_extent = {0.8, 0.6};
    const RenderSettings settings = test::small_settings(Algorithm::ais, 37, 29);
    const Image expected = test::render(TestBackend::own_bvh, scene, camera, settings).image;
    if (test::has_opencl()) {
        const Image by_device = test::render(TestBackend::opencl, scene, camera, settings).image;
        EXPECT_EQ(test::differing_values(by_device, expected), 0U);
    }
    for (const std::uint32_t lanes : {1U, 4U, 16U}) {
        const auto executor = test::make_executor(TestBackend::own_bvh, lanes);
        EXPECT_EQ(test::differing_values(test::render(*executor, scene, camera, settings).image,
                                         expected),
                  0U)
            << lanes;
    }
}

TEST(Orthographic, ARendererMayChangeItsCamera) {
    const FlatScene flat = flatten(test::moving_room(2).scene);
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    Camera camera = test::look_at({0.1, 0.2, 0.9}, {0.0, -0.2, 0.0}, 0.8);
    Camera parallel = camera;
    parallel.half_extent = {0.8, 0.6};
    const RenderSettings settings = test::small_settings(Algorithm::igi, width, height);
    Renderer renderer(executor, flat, camera, settings);
    renderer.render_frame({});
    const Image before = renderer.image();
    renderer.set_camera(parallel);
    renderer.render_frame({});
    EXPECT_EQ(test::differing_values(renderer.image(),
                                     test::render_flat(executor, flat, parallel, settings).image),
              0U);
    renderer.set_camera(camera);
    renderer.render_frame({});
    EXPECT_EQ(test::differing_values(renderer.image(), before), 0U);
    PathSettings path;
    path.width = width;
    path.height = height;
    path.samples = {0, 2};
    PathRenderer traced(executor, flat, camera, path, {});
    traced.render_frame({});
    traced.set_camera(parallel);
    while (traced.render_frame({})) continue;
    EXPECT_EQ(traced.sums().words, test::path_sums(executor, flat, parallel, path).words);
}

TEST(Orthographic, MediaAreCrossedAlongItsRays) {
    test::SceneBuilder builder;
    builder.add(test::quad_mesh({-50, -50, -30}, {0.1F, 0, 0}, {0, 0.1F, 0}),
                builder.material({0.5F, 0.5F, 0.5F}));
    builder.light(LightType::point, {0, 0, 9}, {1.0F, 1.0F, 1.0F});
    builder.scene.media.push_back(test::medium_of(glm::vec3(0.4F), glm::vec3(0.0F)));
    test::add_boundary(builder.scene, test::cube_mesh(), test::placement(3.0, glm::dvec3(0.0)), 0);
    for (const TestBackend backend : test::backends())
        for (const Image& image : images(backend, builder.scene, parallel_camera(), 2))
            for (const float a : alpha_of(image)) ASSERT_NEAR(a, 1.0 - std::exp(-2.4), 1e-4);
    // A near plane partly in a medium has no single medium to start in.
    const FlatScene flat = flatten(builder.scene);
    Camera camera = parallel_camera();
    EXPECT_TRUE(starts_in_one_medium(flat, camera, width, height));
    camera.to_world[3] = {2.0, 0.0, 2.0, 1.0};
    EXPECT_FALSE(starts_in_one_medium(flat, camera, width, height));
}

}  // namespace
}  // namespace weft::orthographic_test
