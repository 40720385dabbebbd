// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "tests/testing/divided_scene.h"
#include "tests/testing/path_fixture.h"

// Light that VPLs leave out and one path per pixel brings back: against closed forms where there
// are any (inside a sphere; beside an area light that shares an edge with the receiver), else
// against the path tracer. Means over at least 128 independent fixed seeds, or over thousands of
// independent pixels, may be off by sidak_limit standard errors: for all comparisons of this file
// together, a correct renderer fails with a probability of 1e-4, or 4e-4 by Student's t instead of
// the normal distribution. Every comparison also bounds its standard error, or it would accept
// anything.
namespace weft::vpl_residual_test {
namespace {

using test::Estimate;
using test::SceneBuilder;
using test::TestBackend;

constexpr double pi = std::numbers::pi;
constexpr std::size_t comparisons = 400;  // a few more than there are

/// Some numbers of every seed: [number][seed].
using SeedValues = std::vector<std::vector<double>>;

void append(SeedValues& all, const std::vector<double>& values) {
    all.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) all[i].push_back(values[i]);
}

/// What `measure` makes of the images of `count` seeds.
template <typename Measure>
SeedValues render_seeds(const FlatScene& flat, const Camera& camera, RenderSettings settings,
                        std::uint32_t count, const Measure& measure) {
    SeedValues all;
    for (settings.seed = 1; settings.seed <= count; ++settings.seed) {
        const test::Rendering rendering = test::render_flat(
            test::shared_executor(TestBackend::own_bvh), flat, camera, settings, settings.samples);
        test::expect_clean(rendering);
        append(all, measure(rendering));
    }
    return all;
}

/// The same of path-traced images, of 128 other seeds.
template <typename Measure>
SeedValues trace_seeds(const FlatScene& flat, const Camera& camera, PathSettings settings,
                       bool through_centres, const Measure& measure) {
    settings.through_centres = through_centres;
    SeedValues all;
    for (settings.seed = 5000; settings.seed < 5128; ++settings.seed)
        append(all, measure(test::path_image(test::shared_executor(TestBackend::own_bvh), flat,
                                             camera, settings)));
    return all;
}

RenderSettings compensated(RenderSettings settings) {
    settings.sampling.compensation = true;
    return settings;
}

// The integrating sphere (vpl_sphere_test): G is 1 / (4 R^2) between any two of its points, so a
// bound of `share` times that leaves `share` of every order up to `bounces` to the VPLs. Facets of
// level 5 and so few VPLs make up to 4e-3 of difference.
constexpr double facets = 4e-3;

struct Sphere {
    double rho;
    FlatScene flat;

    explicit Sphere(float reflectance) : rho(static_cast<double>(reflectance)) {
        SceneBuilder builder;
        builder.add(test::icosphere(5, true), builder.material(glm::vec3(reflectance)));
        builder.light(LightType::point, {0.0, 0.0, 0.0}, glm::vec3(1.0F));
        flat = flatten(builder.scene);
    }

    /// Irradiance by the orders of light from 1 to `last`, I / R^2 being 1.
    [[nodiscard]] double orders(std::uint32_t last) const {
        double sum = 0.0;
        for (std::uint32_t k = 1; k <= last; ++k) sum += std::pow(rho, k);
        return sum;
    }

    /// Settings whose bound is `share` of what G is everywhere: pi n / (c^2 4 pi R^2).
    [[nodiscard]] RenderSettings settings(double share, std::uint32_t bounces = 4) const {
        RenderSettings made = test::small_settings(Algorithm::ir, 160, 128);
        made.sampling.interleave = 1;
        made.sampling.bounces = bounces;
        made.sampling.local_bounds = false;
        made.sampling.vpl_tail = false;
        made.sampling.bound_spacing = std::sqrt(plan_for(flat, made).vpls_per_set / share);
        return made;
    }

    /// Indirect irradiance of every pixel.
    [[nodiscard]] std::vector<double> irradiance(const RenderSettings& made) const {
        const Camera camera = test::look_at({0.1, -0.2, 0.3}, {-0.5, 0.3, -0.8}, 1.2);
        const test::Rendering rendering = test::render_flat(
            test::shared_executor(TestBackend::own_bvh), flat, camera, made, made.samples);
        test::expect_clean(rendering);
        std::vector<double> values = test::channel_of(rendering, "indirect", 0);
        for (double& value : values) value *= pi / rho;
        return values;
    }

    /// That VPLs bring `kept`, and the residual the rest of all orders.
    void expect_residual(const RenderSettings& made, double kept, const std::string& what) const {
        expect_residual(made, kept, rho / (1.0 - rho), what);
    }
    /// The same of light that is `all` in the end.
    void expect_residual(const RenderSettings& made, double kept, double all,
                         const std::string& what) const {
        const std::vector<double> without = irradiance(made);
        std::vector<double> rest = irradiance(compensated(made));
        for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= without[i];
        EXPECT_NEAR(test::estimate(without).mean, kept, facets * kept) << what;
        const double whole = all / (all - kept);
        test::expect_estimate(test::estimate(rest), all - kept,
                              {comparisons, 0.01 * whole, facets * whole}, what);
    }
};

TEST(VplResidual, InASphereItIsWhatTheBoundCutsOffAndAllLaterOrders) {
    for (const float reflectance : {0.5F, 0.8F}) {
        const Sphere sphere(reflectance);
        for (const double share : {0.3, 0.8, 1.5})
            sphere.expect_residual(sphere.settings(share), std::min(share, 1.0) * sphere.orders(4),
                                   testing::PrintToString(reflectance) + ", bound of " +
                                       testing::PrintToString(share));
    }
    const Sphere sphere(0.8F);
    for (const std::uint32_t bounces : {1U, 2U, 8U})
        sphere.expect_residual(sphere.settings(1e6, bounces), sphere.orders(bounces),
                               testing::PrintToString(bounces) + " bounces");

    RenderSettings frames = sphere.settings(0.2);
    frames.samples = 4;
    double share = 0.0;
    for (std::uint32_t f = 0; f < 4; ++f) share += 0.2 * bound_growth(f) / 4.0;
    sphere.expect_residual(frames, share * sphere.orders(4), "four frames");
}

TEST(VplResidual, NearItIsWhatTheBoundCutsOffAndNoLaterOrders) {
    const Sphere sphere(0.8F);
    for (const std::uint32_t bounces : {1U, 4U, 8U})
        for (const double share : {0.3, 0.8}) {
            RenderSettings settings = sphere.settings(share, bounces);
            settings.sampling.near_residual = true;
            const double all = sphere.orders(bounces);
            sphere.expect_residual(settings, share * all, all,
                                   testing::PrintToString(bounces) + " bounces, near, bound of " +
                                       testing::PrintToString(share));
        }
}

TEST(VplResidual, IsTheSameOnEveryBackend) {
    const test::DividedBox box;
    for (const Algorithm algorithm : {Algorithm::igi, Algorithm::ir}) {
        RenderSettings settings = compensated(test::small_settings(algorithm, 24, 20));
        settings.sampling.near_residual = algorithm == Algorithm::igi;
        const test::Rendering reference = test::render_flat(
            test::shared_executor(TestBackend::own_bvh), box.flat, box.camera, settings);
        for (const TestBackend backend : test::backends()) {
            const test::Rendering other =
                test::render_flat(test::shared_executor(backend), box.flat, box.camera, settings);
            test::expect_clean(other);
            // Embree may let a ray that grazes an edge pass where others do not: a few pixels.
            const std::size_t most = backend == TestBackend::embree ? 5 * 6 : 0;
            EXPECT_LE(test::differing_values(reference.image, other.image), most)
                << test::backend_name(backend);
        }
    }
}

// The perpendicular squares of form_factor_test: the receiver [0, 1]^2 in z = 0 fills the image,
// the area light of radiance 1 stands on its edge x = 0. Columns of pixels are parallel to that
// edge.
constexpr std::uint32_t columns = 32;

/// Mean over the pixel centres of a column of the integral of min(G, bound) over the area light: by
/// the midpoint rule in y and in the root of z, as G changes fast near z = 0.
double column_mean(std::uint32_t column, double bound) {
    constexpr int steps = 256;
    const double x = (column + 0.5) / columns;
    double sum = 0.0;
    for (std::uint32_t row = 0; row < columns / 2; ++row)
        for (int j = 0; j < steps; ++j) {
            const double root = (j + 0.5) / steps;
            const double z = root * root;
            for (int i = 0; i < steps; ++i) {
                const double dy = (i + 0.5) / steps - (row + 0.5) / columns;
                const double square = x * x + dy * dy + z * z;
                sum += 2.0 * root * std::min(x * z / (square * square), bound);
            }
        }
    return sum / (columns / 2) / (steps * steps);
}

double lambert_column(std::uint32_t column) {
    const double x = (column + 0.5) / columns;
    double sum = 0.0;
    for (std::uint32_t row = 0; row < columns; ++row)
        sum += test::polygon_irradiance({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}},
                                        {x, (row + 0.5) / columns, 0.0}, {0, 0, 1});
    return sum / columns;
}

/// The receiver, and the area light with its reflectance and radiance. It has more triangles than
/// area lights that are known in closed form (host/scene/area_light_bounds.h).
Scene perpendicular_squares(float receiver, float radiance) {
    SceneBuilder builder;
    builder.add(test::quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                builder.material(glm::vec3(receiver)));
    builder.add(test::quad_mesh({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 3),
                builder.material(glm::vec3(0.0F), glm::vec3(radiance)));
    return builder.scene;
}

const Camera above_receiver = test::look_at({0.5, 0.5, 0.5}, {0.5, 0.5, 0.0}, pi / 2.0);

TEST(VplResidual, BesideAnAreaLightItIsWhatLambertsFormulaHasBeyondTheBound) {
    constexpr double bound = 6.0;
    const FlatScene flat = flatten(perpendicular_squares(1.0F, 1.0F));
    RenderSettings settings = test::small_settings(Algorithm::ir, columns, columns);
    settings.indirect = false;
    settings.sampling.bound_spacing = std::sqrt(pi * 36.0 / bound);  // of 9 sets of 4 samples
    ASSERT_NEAR(plan_for(flat, settings).light_bound_scale, bound, 1e-9);
    const auto by_column = [](const test::Rendering& rendering) {
        std::vector<double> means(columns, 0.0);
        for (std::uint32_t x = 0; x < columns; ++x)
            for (std::uint32_t y = 0; y < columns; ++y)
                means[x] += rendering.irradiance("direct", x, y) / columns;
        return means;
    };
    const SeedValues without = render_seeds(flat, above_receiver, settings, 256, by_column);
    const SeedValues with =
        render_seeds(flat, above_receiver, compensated(settings), 256, by_column);
    double deficit = 0.0;
    for (std::uint32_t x = 0; x < columns; ++x) {
        const std::string what = "area light, column " + std::to_string(x);
        const double lambert = lambert_column(x);
        ASSERT_NEAR(column_mean(x, 1e30), lambert, 1e-3 * lambert);
        const double kept = column_mean(x, bound);
        deficit = std::max(deficit, 1.0 - kept / lambert);
        test::expect_estimate(test::estimate(without[x]), kept, {comparisons, 0.01, 1e-4},
                              what + ", without");
        test::expect_estimate(test::estimate(with[x]), lambert, {comparisons, 0.02}, what);
    }
    EXPECT_GT(deficit, 0.7) << "the bound bites beside the edge";
}

// The Cornell box, 32 x 32 pixels seen through their centres.
constexpr std::uint32_t edge = 32;
constexpr std::uint32_t blocks = 4;  // each way
constexpr std::size_t areas = blocks * blocks + 1;

/// Means of both layers and all channels: of every block, and last of the image.
std::vector<double> area_means(const test::Rendering& rendering) {
    std::vector<double> means;
    for (const char* const layer : {"direct", "indirect"})
        for (std::uint32_t channel = 0; channel < 3; ++channel) {
            std::array<double, areas> sums{};
            for (std::uint32_t y = 0; y < edge; ++y)
                for (std::uint32_t x = 0; x < edge; ++x)
                    sums.at(y * blocks / edge * blocks + x * blocks / edge) +=
                        static_cast<double>(rendering.at(layer, x, y, channel));
            for (std::size_t b = 0; b + 1 < areas; ++b) {
                sums.back() += sums.at(b);
                sums.at(b) *= static_cast<double>(areas - 1);
            }
            for (const double sum : sums) means.push_back(sum / (edge * edge));
        }
    return means;
}

/// For one layer alone, with a bound that it feels.
RenderSettings cornell_settings(Algorithm algorithm, bool direct) {
    RenderSettings settings = test::small_settings(algorithm, edge, edge);
    settings.direct = direct;
    settings.indirect = !direct;
    settings.sampling.interleave = algorithm == Algorithm::igi ? 3 : 1;
    settings.sampling.bounces = 4;
    settings.sampling.local_bounds = false;
    settings.sampling.vpl_tail = false;
    // The same bound for both: the number of sets goes with the square of this.
    settings.sampling.bound_spacing = (direct ? 18.0 : 4.0) * settings.sampling.interleave;
    return settings;
}

/// That a layer's mean over the image is that of the reference.
void expect_image(const SeedValues& found, const SeedValues& reference, bool direct, double bias,
                  const std::string& what) {
    const std::size_t first = direct ? 0 : 3 * areas;
    for (std::size_t i = first + areas - 1; i < first + 3 * areas; i += areas) {
        const Estimate a = test::estimate(found[i]);
        const Estimate b = test::estimate(reference[i]);
        test::expect_estimate({a.mean, std::hypot(a.error, b.error)}, b.mean,
                              {comparisons, 0.01, bias}, what + ", area " + std::to_string(i));
    }
}

TEST(VplResidual, ClosesTheGapToPathTracingInTheCornellBox) {
    constexpr std::array<double, 3> area_light{16.1, 8.51, 2.16};  // seen in a wall of albedo 0.78
    const test::DividedBox box;
    const SeedValues reference =
        trace_seeds(box.flat, box.camera, test::path_settings(edge, edge, 8), true, area_means);
    for (const bool direct : {true, false}) {
        const RenderSettings settings = cornell_settings(Algorithm::ir, direct);
        const std::uint32_t seeds = direct ? 1280 : 320;
        const SeedValues with =
            render_seeds(box.flat, box.camera, compensated(settings), seeds, area_means);
        const SeedValues without = render_seeds(box.flat, box.camera, settings, seeds, area_means);
        const std::size_t first = direct ? 0 : 3 * areas;
        for (std::size_t i = first; i < first + 3 * areas; ++i) {
            const std::string what = "area " + std::to_string(i);
            const bool whole = i % areas == areas - 1;
            const Estimate traced = test::estimate(reference[i]);
            const Estimate bounded = test::estimate(without[i]);
            const Estimate found = test::estimate(with[i]);
            const double gap = traced.mean - bounded.mean;
            // So few rays hit the area light that their scatter says little: the expected number
            // does.
            const double rare =
                direct ? gap * area_light.at(i / areas) / (whole ? 16.0 : 1.0) : 0.0;
            const double error = std::sqrt(traced.error * traced.error + found.error * found.error +
                                           std::max(rare, 0.0) / (64.0 * seeds));
            test::expect_estimate({found.mean, error}, traced.mean,
                                  {comparisons, whole    ? 0.01
                                                : direct ? 0.12
                                                         : 0.07},
                                  what);
            for (std::size_t seed = 0; seed < with[i].size(); ++seed)
                ASSERT_GE(with[i][seed], without[i][seed]) << "light is never taken away";
            const double least = whole ? 10.0 * std::hypot(traced.error, bounded.error) : -1.0;
            EXPECT_GT(gap, least) << "nothing to close in " << what;
        }
    }
}

// The filter of igi, radius 1, moves light between neighbouring pixels of a surface: those at its
// edges give away a little more or less than they get.
TEST(VplResidual, KeepsTheMeanOverFramesAndOfInterleavedImages) {
    const test::DividedBox box;
    const PathSettings path = test::path_settings(edge, edge, 8);
    const SeedValues centres = trace_seeds(box.flat, box.camera, path, true, area_means);
    const SeedValues everywhere = trace_seeds(box.flat, box.camera, path, false, area_means);
    const auto by_area = [&](const RenderSettings& settings) {
        return render_seeds(box.flat, box.camera, compensated(settings), 128, area_means);
    };
    for (const bool direct : {true, false}) {
        RenderSettings frames = cornell_settings(Algorithm::ir, direct);
        frames.samples = 3;
        expect_image(by_area(frames), everywhere, direct, 1e-5, "three frames");
        RenderSettings igi = cornell_settings(Algorithm::igi, direct);
        expect_image(by_area(igi), centres, direct, 0.02, "igi");
        igi.sampling.filter_radius = 0;
        expect_image(by_area(igi), centres, direct, 1e-5, "igi, no filter");
    }
}

TEST(VplResidual, IsInPlansThatAskForItAndOnlyWhereThereIsLight) {
    const FlatScene flat = test::DividedBox().flat;
    for (const Algorithm algorithm : {Algorithm::igi, Algorithm::ir}) {
        RenderSettings settings = test::small_settings(algorithm, 8, 8);
        // The residual goes with neither.
        settings.sampling.local_bounds = settings.sampling.vpl_tail = false;
        const FramePlan without = plan_for(flat, settings);
        const FramePlan with = plan_for(flat, compensated(settings));
        std::vector<KernelId> kernels = kernels_of(without);
        EXPECT_EQ(std::ranges::count(kernels, KernelId::vpl_residual), 0);
        kernels.push_back(KernelId::vpl_residual);
        std::ranges::sort(kernels);
        EXPECT_EQ(kernels_of(with), kernels);
        EXPECT_EQ(features_of(flat, with), features_of(flat, without));
    }
    SamplingSettings sampling;
    sampling.compensation = true;
    const auto planned = [&](const SceneStatistics& scene) {
        return plan_frames(Algorithm::igi, sampling, scene).compensation;
    };
    SceneStatistics scene;
    scene.mean_reflectance = 0.5;
    EXPECT_FALSE(planned(scene)) << "no light";
    scene.mean_reflectance = 0.0;
    scene.punctual_lights = 1;
    EXPECT_FALSE(planned(scene)) << "nothing reflects, and point lights have no bound";
    scene.area_lights = 1;
    EXPECT_TRUE(planned(scene));
    scene.direct = false;
    EXPECT_FALSE(planned(scene));
}

TEST(VplResidual, BlackSurfacesAndScenesWithoutLightStayBlack) {
    for (const float lit : {0.0F, 1.0F})
        for (const TestBackend backend : test::backends()) {
            const test::Rendering rendering = test::render(
                backend, perpendicular_squares(0.5F * (1.0F - lit), lit), above_receiver,
                compensated(test::small_settings(Algorithm::igi, 9, 9)));
            test::expect_clean(rendering);
            for (const char* const layer : {"", "direct", "indirect"})
                EXPECT_EQ(test::mean_of(rendering.layer(layer)), 0.0) << layer;
        }
}

}  // namespace
}  // namespace weft::vpl_residual_test
