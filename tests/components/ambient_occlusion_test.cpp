// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/ambient_occlusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/testing/closed_forms.h"
#include "tests/testing/render_fixture.h"

// Ambient occlusion: closed forms, a brute force of its own, and what must not change its bits.
namespace weft::ambient_occlusion_test {
namespace {

using test::Rendering;
using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;

RenderSettings occlusion_settings(Algorithm algorithm, std::uint32_t width, std::uint32_t height) {
    RenderSettings settings = test::small_settings(algorithm, width, height);
    settings.direct = false;
    settings.indirect = false;
    settings.requested = {"occlusion"};
    settings.sampling.edge_samples = 0;
    return settings;
}

/// Every pixel with its own set alone.
RenderSettings unfiltered(RenderSettings settings) {
    settings.sampling.filter_radius = 0;
    return settings;
}

FlatScene flat(SceneBuilder& builder) {
    validate_scene(builder.scene);
    return flatten(builder.scene);
}

/// Scene units.
double reach_of(const FlatScene& scene) {
    return occlusion_reach * static_cast<double>(scene.radius) / scene.units.scale;
}

void add_floor(SceneBuilder& builder) {
    builder.add(test::quad_mesh({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}),
                builder.material(glm::vec3(0.5F)));
}

/// The ray through a pixel's centre, not normalised.
glm::dvec3 pixel_direction(const Camera& camera, std::uint32_t x, std::uint32_t y,
                           std::uint32_t width, std::uint32_t height) {
    const double tangent = std::tan(0.5 * camera.fov);
    const double s = (2.0 * (x + 0.5) / width - 1.0) * tangent * width / height;
    const double t = (1.0 - 2.0 * (y + 0.5) / height) * tangent;
    return glm::dmat3(camera.to_world) * glm::dvec3(s, t, -1.0);
}

TEST(AmbientOcclusion, OpenPlaneSeesTheWholeSky) {
    SceneBuilder builder;
    add_floor(builder);
    const FlatScene scene = flat(builder);
    const Camera camera = test::look_at({0.3, 1.0, 6.0}, {0.0, 0.0, 0.0}, 0.9);
    for (const TestBackend backend : test::light_backends())
        for (const Algorithm algorithm :
             {Algorithm::ais, Algorithm::amax, Algorithm::igi, Algorithm::ir}) {
            const Rendering rendering =
                test::render_flat(test::shared_executor(backend), scene, camera,
                                  occlusion_settings(algorithm, 61, 43), 2);
            test::expect_clean(rendering);
            // 16 taps of weights that are rounded, and pi over pi.
            for (const float open : rendering.layer("occlusion")) EXPECT_NEAR(open, 1.0F, 3e-6F);
        }
}

TEST(AmbientOcclusion, ClosedBoxWithinReachSeesNothing) {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.5F)));
    // Far away, so that the reach is longer than any line in the box.
    builder.add(test::quad_mesh({40, 0, 0}, {0, 1, 0}, {0, 0, 1}),
                builder.material(glm::vec3(0.5F)));
    const FlatScene scene = flat(builder);
    ASSERT_GT(reach_of(scene), 2.0 * std::sqrt(3.0));
    const Camera camera = test::look_at({0.1, 0.05, 0.9}, {0.0, 0.0, 0.0}, 1.2);
    for (const TestBackend backend : test::light_backends())
        for (const Algorithm algorithm : {Algorithm::ais, Algorithm::igi}) {
            const Rendering rendering =
                test::render_flat(test::shared_executor(backend), scene, camera,
                                  occlusion_settings(algorithm, 48, 40));
            for (const float open : rendering.layer("occlusion")) ASSERT_EQ(open, 0.0F);
        }
}

/// Openness of a floor point at `distance` from a wall so wide and high that nothing within `reach`
/// misses it: directions of which the wall is within reach have a component of more than
/// c = distance / reach towards it, and project to a segment of the unit disk (Nusselt) of area
/// acos c - c sqrt(1 - c^2).
double openness_beside_wall(double distance, double reach) {
    const double c = std::min(1.0, distance / reach);
    return 1.0 - (std::acos(c) - c * std::sqrt(1.0 - c * c)) / pi;
}

// 16 seeds, by Student's t with 15 degrees of freedom at 5 standard errors: a correct renderer
// fails one such comparison in 6,000, and seeds are fixed.
TEST(AmbientOcclusion, FloorBesideAWall) {
    constexpr std::uint32_t columns = 40;
    constexpr std::uint32_t rows = 12;
    constexpr std::uint32_t bands = 5;
    SceneBuilder builder;
    add_floor(builder);
    builder.add(test::quad_mesh({0, 0, -4}, {0, 4, 0}, {0, 0, 8}),
                builder.material(glm::vec3(0.5F)));
    const FlatScene scene = flat(builder);
    const double reach = reach_of(scene);
    ASSERT_LT(reach, 2.0);  // what is seen is farther than that from the wall's ends
    // Looks down at the floor from x = 0 to 1.8.
    Camera camera = test::look_at({0.9, 3.0, 0.0}, {0.9, 0.0, 0.0}, 1.0);
    camera.fov = 2.0 * std::atan(0.9 / 3.0 * rows / columns);
    ASSERT_GT(1.8, 1.1 * reach);

    std::array<double, bands> expected{};
    std::array<std::uint32_t, bands> counts{};
    std::vector<std::uint32_t> band_of(std::size_t{columns} * rows);
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x) {
            const glm::dvec3 d = pixel_direction(camera, x, y, columns, rows);
            const double distance = 0.9 + 3.0 * d.x / -d.y;
            ASSERT_TRUE(distance > 0.0 && distance < 1.8);
            const auto band = static_cast<std::uint32_t>(distance / 1.8 * bands);
            band_of[y * columns + x] = band;
            expected.at(band) += openness_beside_wall(distance, reach);
            ++counts.at(band);
        }
    for (const TestBackend backend : test::light_backends()) {
        std::array<std::vector<double>, bands> means;
        for (std::uint32_t seed = 0; seed < 16; ++seed) {
            RenderSettings settings = unfiltered(occlusion_settings(Algorithm::igi, columns, rows));
            settings.seed = seed;
            const Rendering rendering =
                test::render_flat(test::shared_executor(backend), scene, camera, settings);
            std::array<double, bands> sums{};
            for (std::size_t i = 0; i < band_of.size(); ++i)
                sums.at(band_of[i]) += static_cast<double>(rendering.layer("occlusion")[i]);
            for (std::uint32_t band = 0; band < bands; ++band)
                means.at(band).push_back(sums.at(band) / counts.at(band));
        }
        for (std::uint32_t band = 0; band < bands; ++band) {
            const auto [mean, error] = test::estimate(means.at(band));
            EXPECT_LE(error, 0.01);  // or the next line would accept anything
            EXPECT_NEAR(mean, expected.at(band) / counts.at(band), 5.0 * error + 1e-5)
                << test::backend_name(backend) << ", band " << band;
        }
    }
}

// The brute force: every ray against every triangle, in double, from a room written out here.
struct Corners {
    glm::dvec3 a, b, c;
};

std::vector<Corners> corners_of(const Scene& scene) {
    std::vector<Corners> all;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto at = [&](std::uint32_t v) {
            return glm::dvec3(instance.to_world * glm::dvec4(mesh.positions[v], 1.0));
        };
        for (const auto& t : mesh.triangles) all.push_back({at(t[0]), at(t[1]), at(t[2])});
    }
    return all;
}

/// Distance along a ray to a triangle (Moeller and Trumbore 1997), none where it misses.
std::optional<double> hit(const Corners& t, const glm::dvec3& from, const glm::dvec3& along) {
    const glm::dvec3 p = glm::cross(along, t.c - t.a);
    const double determinant = glm::dot(t.b - t.a, p);
    if (determinant == 0.0) return {};
    const glm::dvec3 s = from - t.a;
    const double u = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, t.b - t.a);
    const double v = glm::dot(along, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0) return {};
    return glm::dot(t.c - t.a, q) / determinant;
}

/// A vector given about +z turned about `n` (Duff et al. 2017).
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& n) {
    const double s = std::signbit(n.z) ? -1.0 : 1.0;
    const double a = -1.0 / (s + n.z);
    const double b = n.x * n.y * a;
    return v.x * glm::dvec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x) +
           v.y * glm::dvec3(b, s + n.y * n.y * a, -n.y) + v.z * n;
}

Scene furnished_room() {
    SceneBuilder builder;
    const std::uint32_t white = builder.material(glm::vec3(0.7F));
    builder.add(test::room_mesh(), white);
    builder.add(test::icosphere(1, false), white, test::placement(0.3, {-0.3, -0.65, -0.3}));
    builder.add(test::quad_mesh({0.2F, -1.0F, -0.6F}, {0.5F, 0, 0.3F}, {0, 0.9F, 0.1F}), white);
    return builder.scene;
}

Camera room_camera() {
    return test::look_at({0.15, 0.1, 0.95}, {0.0, -0.3, 0.0}, 1.1);
}

/// Rays of a pixel's set that are open in frame 0, by brute force; none where the pixel is hit by
/// nothing.
double brute_openness(const std::vector<Corners>& corners, const glm::dvec3& from,
                      const glm::dvec3& along, double reach, std::uint32_t set) {
    const Corners* nearest = nullptr;
    double t = 1e300;
    for (const Corners& triangle : corners) {
        const std::optional<double> found = hit(triangle, from, along);
        if (!found || *found <= 0.0 || *found >= t) continue;
        t = *found;
        nearest = &triangle;
    }
    if (nearest == nullptr) return 1.0;
    glm::dvec3 normal =
        glm::normalize(glm::cross(nearest->b - nearest->a, nearest->c - nearest->a));
    if (glm::dot(normal, along) > 0.0) normal = -normal;
    const glm::dvec3 point = from + t * along;
    const auto directions = occlusion_directions(9, 0, 3, reach);
    std::uint32_t open = 0;
    for (std::uint32_t i = 0; i < occlusion_directions_per_set; ++i) {
        const shared::float4& d = directions[set * occlusion_directions_per_set + i];
        const glm::dvec3 direction = turned({d.x, d.y, d.z}, normal);
        const bool hidden = std::any_of(corners.begin(), corners.end(), [&](const Corners& other) {
            const std::optional<double> found = hit(other, point, direction);
            return &other != nearest && found && *found > 1e-9 && *found <= reach;
        });
        open += hidden ? 0 : 1;
    }
    return static_cast<double>(open) / occlusion_directions_per_set;
}

TEST(AmbientOcclusion, AmaxIsBruteForceOverTheSameSets) {
    constexpr std::uint32_t width = 36;
    constexpr std::uint32_t height = 30;
    const Scene room = furnished_room();
    const FlatScene scene = flatten(room);
    const std::vector<Corners> corners = corners_of(room);
    const Camera camera = room_camera();
    RenderSettings settings = unfiltered(occlusion_settings(Algorithm::amax, width, height));
    settings.seed = 3;
    for (const TestBackend backend : test::light_backends()) {
        const Rendering rendering =
            test::render_flat(test::shared_executor(backend), scene, camera, settings);
        std::uint32_t different = 0;
        double mean = 0.0;
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) {
                const double expected = brute_openness(corners, glm::dvec3(camera.to_world[3]),
                                                       pixel_direction(camera, x, y, width, height),
                                                       reach_of(scene), x % 3 + 3 * (y % 3));
                const auto open = static_cast<double>(rendering.at("occlusion", x, y));
                different += std::abs(open - expected) > 1e-6 ? 1 : 0;
                mean += expected / (width * height);
            }
        // Rays that graze an edge may be decided otherwise in floats.
        EXPECT_LE(different, width * height / 200) << test::backend_name(backend);
        EXPECT_TRUE(mean > 0.3 && mean < 0.9) << mean;  // both answers occur
    }
}

TEST(AmbientOcclusion, TheFilterIsTheMeanOfNineSets) {
    constexpr std::uint32_t edge = 32;
    SceneBuilder builder;
    add_floor(builder);
    builder.add(test::quad_mesh({0, 0, -4}, {0, 4, 0}, {0, 0, 8}),
                builder.material(glm::vec3(0.5F)));
    const FlatScene scene = flat(builder);
    // The floor alone is seen.
    const Camera camera = test::look_at({0.9, 3.0, 0.0}, {0.9, 0.0, 0.0}, 0.5);
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const RenderSettings settings = occlusion_settings(Algorithm::amax, edge, edge);
    const Rendering raw = test::render_flat(executor, scene, camera, unfiltered(settings));
    const Rendering mean = test::render_flat(executor, scene, camera, settings);
    for (std::uint32_t y = 1; y + 1 < edge; ++y)
        for (std::uint32_t x = 1; x + 1 < edge; ++x) {
            double sum = 0.0;
            for (std::uint32_t j = y - 1; j <= y + 1; ++j)
                for (std::uint32_t i = x - 1; i <= x + 1; ++i)
                    sum += static_cast<double>(raw.at("occlusion", i, j));
            ASSERT_NEAR(static_cast<double>(mean.at("occlusion", x, y)), sum / 9.0, 1e-6);
        }
}

TEST(AmbientOcclusion, AdaptsAndStaysCloseToFullSampling) {
    const FlatScene scene = flatten(furnished_room());
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const auto render = [&](Algorithm algorithm, double threshold) {
        RenderSettings settings = occlusion_settings(algorithm, 160, 120);
        settings.sampling.threshold = threshold;
        return test::render_flat(executor, scene, room_camera(), settings);
    };
    const Rendering full = render(Algorithm::amax, 8.0);
    const Rendering adaptive = render(Algorithm::ais, 8.0);
    test::expect_clean(adaptive);
    ASSERT_EQ(adaptive.stats[0].levels.size(), 1U);
    EXPECT_EQ(adaptive.stats[0].levels[0].component, "occlusion");
    EXPECT_GT(adaptive.stats[0].levels[0].tiles[0], 0U);
    EXPECT_LT(adaptive.stats[0].rays, full.stats[0].rays * 3 / 4);
    EXPECT_LT(test::relative_mse(full.layer("occlusion"), adaptive.layer("occlusion")), 0.005);
    EXPECT_EQ(adaptive.layer("occlusion.level").size(), 160U * 120U);
    // Where every pixel is to be sampled it is full sampling, to the bit.
    EXPECT_EQ(render(Algorithm::ais, 0.0).layer("occlusion"), full.layer("occlusion"));
}

TEST(AmbientOcclusion, SameBitsOnEveryBackendAndWidth) {
    const FlatScene scene = flatten(furnished_room());
    for (const Algorithm algorithm : {Algorithm::ais, Algorithm::ir}) {
        RenderSettings settings = occlusion_settings(algorithm, 61, 43);
        const auto reference = test::make_executor(TestBackend::own_bvh, 1, 1);
        const Rendering expected = test::render_flat(*reference, scene, room_camera(), settings, 2);
        settings.tile = 16;
        for (const std::uint32_t lanes : {4U, 16U})
            for (const TestBackend backend : {TestBackend::own_bvh, TestBackend::opencl}) {
                if (backend == TestBackend::opencl && !test::has_opencl()) continue;
                const auto executor = test::make_executor(backend, lanes);
                const Rendering other =
                    test::render_flat(*executor, scene, room_camera(), settings, 2);
                EXPECT_EQ(test::differing_values(expected.image, other.image), 0U)
                    << test::backend_name(backend) << ", " << lanes << " lanes";
            }
    }
}

TEST(AmbientOcclusion, LayerIsTheMeanOfItsImagesFrames) {
    const FlatScene scene = flatten(furnished_room());
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const RenderSettings settings = occlusion_settings(Algorithm::igi, 32, 24);
    const auto values = [](Renderer& renderer) {
        return renderer.image().find("occlusion")->values;
    };
    Renderer renderer(executor, scene, room_camera(), settings);
    ASSERT_TRUE(renderer.render_frame({}));
    const std::vector<float> first = values(renderer);
    ASSERT_TRUE(renderer.render_frame({}));
    const std::vector<float> both = values(renderer);
    EXPECT_NE(first, both);
    // A frame that ends early is dropped, a new image begins anew.
    EXPECT_FALSE(renderer.render_frame([](Stage, double) { return false; }));
    EXPECT_EQ(values(renderer), both);
    renderer.set_camera(room_camera());
    ASSERT_TRUE(renderer.render_frame({}));
    EXPECT_EQ(values(renderer), first);
    // Frames have directions of their own, and their mean is nearer to all directions' mean.
    RenderSettings long_run = settings;
    long_run.algorithm = Algorithm::ir;
    const Rendering converged = test::render_flat(executor, scene, room_camera(), long_run, 24);
    EXPECT_LT(test::relative_mse(converged.layer("occlusion"), both),
              test::relative_mse(converged.layer("occlusion"), first));
}

}  // namespace
}  // namespace weft::ambient_occlusion_test
