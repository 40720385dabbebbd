// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/media_builder.h"
#include "selftest/path_rendering.h"

// Slabs of media between z = -1 and 1, seen along z: their transmittance and emission.
namespace weft::selftest {
namespace {

constexpr double thickness = 2.0;
constexpr double wall_radiance = 3.0;

Camera along_axis() {
    return look_at({0, 0, 3}, {0, 0, -9}, 1e-4);
}

/// A slab that absorbs with the coefficient `sigma` and emits `emission` per length.
SceneBuilder slab(const glm::vec3& sigma, float emission) {
    SceneBuilder builder;
    builder.scene.media.push_back(medium_of(sigma, glm::vec3(0.0F)));
    builder.scene.media[0].emission = glm::vec3(emission);
    add_boundary(builder.scene, cube_mesh(), glm::dmat4(1.0), 0);
    return builder;
}

SceneBuilder emissive_slab(const glm::vec3& sigma) {
    return slab(sigma, 1.0F);
}

void add_wall(SceneBuilder& builder) {
    builder.add(quad_mesh({-9.0F, -9.0F, -2.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 18.0F, 0.0F}),
                builder.material(glm::vec3(0.0F), glm::vec3(static_cast<float>(wall_radiance))));
}

/// (q / sigma) (1 - exp(-sigma d)) with q = 1.
double slab_emission(double sigma) {
    return -std::expm1(-sigma * thickness) / sigma;
}

double wall_through(double sigma) {
    return wall_radiance * std::exp(-sigma * thickness) + slab_emission(sigma);
}

double traced(Executor& executor, const Scene& scene, std::uint32_t channel, double expected) {
    return farthest_from(
        expected, channel_of(trace_paths(executor, scene, along_axis(), path_settings(4, 4, 4)), "",
                             channel));
}

double previewed(Executor& executor, const Scene& scene, std::uint32_t channel, double expected) {
    const RenderSettings settings = unbounded(small_settings(Algorithm::igi, 8, 8));
    return farthest_from(
        expected, channel_of(render(executor, scene, along_axis(), settings), "emission", channel));
}

float sigma_of(double depth) {
    return static_cast<float>(depth / thickness);
}

/// Optical depths of slabs without light of their own, those of one scene in its three channels.
constexpr std::array<std::array<std::pair<double, const char*>, 3>, 2> dark_depths{
    {{{{1e-8, "1e-8"}, {1e-2, "1e-2"}, {1.0, "1"}}}, {{{6.0, "6"}, {12.0, "12"}, {1e3, "1e3"}}}}};

/// Transmittance of a slab without scattering; at a depth of 1000 it is 0 even in doubles.
double transmittance(double depth) {
    return std::exp(-static_cast<double>(sigma_of(depth)) * thickness);
}

void add_transmittance_checks(std::vector<Check>& checks) {
    const std::string alone = "the slab does not emit, so that this is an exponential in floats";
    for (const auto& depths : dark_depths)
        for (const auto& [depth, name] : depths)
            for (const char* const algorithm : {"paths", "igi"})
                checks.push_back(
                    {std::string("transmittance at optical depth ") + name + ", " + algorithm,
                     transmittance(depth), share(1e-6), alone});
}

void measure_transmittance(Executor& executor, std::vector<Measured>& measured) {
    for (const auto& depths : dark_depths) {
        const auto sigma = [&](std::size_t channel) { return sigma_of(depths.at(channel).first); };
        SceneBuilder builder = slab({sigma(0), sigma(1), sigma(2)}, 0.0F);
        add_wall(builder);
        for (std::uint32_t channel = 0; channel < 3; ++channel) {
            const double wall = wall_radiance * transmittance(depths.at(channel).first);
            measured.emplace_back(traced(executor, builder.scene, channel, wall) / wall_radiance);
            measured.emplace_back(previewed(executor, builder.scene, channel, wall) /
                                  wall_radiance);
        }
    }
}

SelftestCase homogeneous_slab() {
    const std::string exact = "what reaches the camera unscattered is computed, not sampled";
    SelftestCase made{12, "homogeneous slab", RunsOn::devices, {}, {}};
    for (const auto& [depth, name] : {std::pair{1e-8, "1e-8"}, {1e-2, "1e-2"}, {1e3, "1e3"}})
        made.checks.push_back({std::string("emission at optical depth ") + name,
                               slab_emission(static_cast<double>(sigma_of(depth))), share(1e-6),
                               exact});
    made.checks.push_back({"wall behind optical depth 1, paths", wall_through(0.5), share(3e-6),
                           exact + "; two terms add up"});
    made.checks.push_back({"wall behind optical depth 6, paths", wall_through(3.0), share(3e-6),
                           exact + "; two terms add up"});
    made.checks.push_back({"wall behind optical depth 6, igi", wall_through(3.0), share(1e-5),
                           "two terms add up, along a ray whose ends are rounded"});
    add_transmittance_checks(made.checks);
    made.measure = [](Executor& executor) {
        std::vector<Measured> measured;
        for (const double depth : {1e-8, 1e-2, 1e3}) {
            const float sigma = sigma_of(depth);
            measured.emplace_back(traced(executor, emissive_slab(glm::vec3(sigma)).scene, 0,
                                         slab_emission(static_cast<double>(sigma))));
        }
        SceneBuilder builder = emissive_slab({0.5F, 3.0F, 1.0F});
        add_wall(builder);
        measured.emplace_back(traced(executor, builder.scene, 0, wall_through(0.5)));
        measured.emplace_back(traced(executor, builder.scene, 1, wall_through(3.0)));
        measured.emplace_back(previewed(executor, builder.scene, 1, wall_through(3.0)));
        measure_transmittance(executor, measured);
        return measured;
    };
    return made;
}

constexpr std::uint32_t voxels = 64;

/// Density 1 + z, but constant within half a voxel of the faces.
DensityGrid linear_grid() {
    DensityGrid grid;
    grid.size = {1, 1, voxels};
    for (std::uint32_t k = 0; k < voxels; ++k)
        grid.densities.push_back(static_cast<float>(2.0 * (k + 0.5) / voxels));
    return grid;
}

/// Transmittance to the wall: exp(-(s0 d + s1 d^2 / 2)) for the linear part, and its constant ends.
double linear_transmittance(double sigma) {
    constexpr double edge = 1.0 / voxels;
    constexpr double far = thickness - edge;
    const double depth = edge * edge + 0.5 * (far * far - edge * edge) + far * edge;
    return wall_radiance * std::exp(-depth * sigma);
}

SelftestCase linear_slab() {
    constexpr float sigma = 0.75F;
    const double expected = linear_transmittance(static_cast<double>(sigma));
    return {34,
            "slab of linear density",
            RunsOn::devices,
            {{"wall behind it, paths", expected, share(1e-5),
              "the depth is a sum over 64 voxels in floats"},
             {"wall behind it, igi", expected, share(1e-4),
              "the depth is a sum over 64 voxels in floats, from rounded ends of the ray"}},
            [=](Executor& executor) -> std::vector<Measured> {
                SceneBuilder builder;
                add_wall(builder);
                builder.scene.media.push_back(medium_of(glm::vec3(sigma), glm::vec3(0.0F)));
                add_grid(builder.scene, 0, linear_grid());
                builder.scene.outer_medium = 0;
                return {traced(executor, builder.scene, 0, expected),
                        previewed(executor, builder.scene, 0, expected)};
            }};
}

}  // namespace

std::vector<SelftestCase> media_cases() {
    return {homogeneous_slab(), linear_slab()};
}

}  // namespace weft::selftest
