// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "device/launch.h"
#include "tests/testing/render_fixture.h"

// The bound of each VPL by its neighbours (kernels/light/vpl_bounds.cl), against brute force.
namespace weft::vpl_bounds_test {
namespace {

using test::TestBackend;

constexpr float global_bound = 7.0F;
constexpr std::size_t neighbours = 8;
constexpr double similar = 0.5;

shared::Vpl surface_vpl(const glm::vec3& at, const glm::vec3& normal, float flux) {
    shared::Vpl vpl{};
    vpl.position = {at.x, at.y, at.z, global_bound};
    vpl.normal = {normal.x, normal.y, normal.z, 0.0F};  // the bits of VPL_SURFACE
    vpl.flux = {flux, 0.5F * flux, 0.25F * flux, 0.5F};
    return vpl;
}

std::vector<float> bounds_of(TestBackend backend, std::vector<shared::Vpl> vpls, float scale) {
    Executor& executor = test::shared_executor(backend);
    const auto count = static_cast<std::uint32_t>(vpls.size());
    executor.build(std::vector{KernelId::vpl_bounds}, 0);
    auto buffer = allocate<kinds::VirtualLights>(executor, count, "VPLs");
    write_buffer(executor, buffer, vpls);
    EXPECT_TRUE(run_kernel(executor, {},
                           kernels::vpl_bounds{.vpl_count = count, .scale = scale, .vpls = buffer},
                           count));
    std::vector<float> bounds;
    for (const shared::Vpl& vpl : read_buffer(executor, buffer, count))
        bounds.push_back(vpl.position.w);
    return bounds;
}

glm::dvec3 vector_of(const shared::float4& v) {
    return {v.x, v.y, v.z};
}

/// The bound of VPL `j` by its definition.
double expected_bound(const std::vector<shared::Vpl>& vpls, std::size_t j, double scale) {
    struct Neighbour {
        double distance, flux;
    };
    std::vector<Neighbour> found;
    const double own = static_cast<double>(vpls[j].flux.x);
    if (!(own > 0.0) || vpls[j].normal.w != 0.0F) return static_cast<double>(global_bound);
    for (std::size_t i = 0; i < vpls.size(); ++i) {
        const bool counts =
            i != j && vpls[i].flux.x > 0.0F && vpls[i].normal.w == 0.0F &&
            glm::dot(vector_of(vpls[i].normal), vector_of(vpls[j].normal)) >= similar;
        if (counts)
            found.push_back(
                {glm::distance(vector_of(vpls[i].position), vector_of(vpls[j].position)),
                 static_cast<double>(vpls[i].flux.x)});
    }
    if (found.size() < neighbours) return static_cast<double>(global_bound);
    std::sort(found.begin(), found.end(),
              [](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
    double sum = own;
    for (std::size_t k = 0; k < neighbours; ++k) sum += found[k].flux;
    return scale * sum / own / std::pow(found[neighbours - 1].distance, 2);
}

/// VPLs of all kinds of surfaces, some dark, some in a medium.
std::vector<shared::Vpl> mixed_vpls(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    std::vector<shared::Vpl> vpls;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 at(uniform(random), uniform(random), uniform(random));
        const glm::vec3 normal =
            glm::normalize(glm::vec3(uniform(random), uniform(random), uniform(random)) + 1e-3F);
        const float flux = i % 7 == 0 ? 0.0F : std::exp(3.0F * uniform(random));
        vpls.push_back(surface_vpl(at, normal, flux));
        const std::uint32_t medium = VPL_MEDIUM;
        if (i % 11 == 0) std::memcpy(&vpls.back().normal.w, &medium, sizeof medium);
    }
    return vpls;
}

TEST(VplBounds, AreThoseOfTheirDefinition) {
    const std::vector<shared::Vpl> vpls = mixed_vpls(333);
    for (const TestBackend backend : test::backends()) {
        const std::vector<float> bounds = bounds_of(backend, vpls, 0.3F);
        for (std::size_t j = 0; j < vpls.size(); ++j) {
            const double expected = expected_bound(vpls, j, static_cast<double>(0.3F));
            EXPECT_NEAR(static_cast<double>(bounds[j]) / expected, 1.0, 1e-5)
                << test::backend_name(backend) << " " << j;
        }
    }
}

TEST(VplBounds, OfEvenVplsIsThatOfTheirDensity) {
    // On a grid of cells of area a, 8 neighbours and the VPL itself lie within sqrt(2 a): the bound
    // pi n / (c^2 A) = pi / (c^2 a) is met up to 9 / (2 pi), which is how round a square is.
    constexpr float edge = 0.1F;
    std::vector<shared::Vpl> vpls;
    for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 21; ++x)
            vpls.push_back(
                surface_vpl({edge * static_cast<float>(x), edge * static_cast<float>(y), 0.0F},
                            {0.0F, 0.0F, 1.0F}, 2.0F));
    const std::vector<float> bounds = bounds_of(TestBackend::own_bvh, vpls, 1.0F);
    const double density = std::numbers::pi / static_cast<double>(edge * edge);
    EXPECT_NEAR(static_cast<double>(bounds[10 * 21 + 10]) / density, 9.0 / (2.0 * std::numbers::pi),
                1e-4);
}

TEST(VplBounds, FewNeighboursOrNoneKeepTheBoundOfTheScene) {
    for (const std::size_t count : {1U, 2U, 8U}) {
        const std::vector<shared::Vpl> vpls = mixed_vpls(count);
        for (const float bound : bounds_of(TestBackend::own_bvh, vpls, 1.0F))
            EXPECT_EQ(bound, global_bound);
    }
}

TEST(VplBounds, VplsInOnePlaceOrOfExtremeFluxStayFinite) {
    const std::vector<shared::Vpl> together(20, surface_vpl({1, 2, 3}, {0, 1, 0}, 1.0F));
    for (const float bound : bounds_of(TestBackend::own_bvh, together, 1.0F))
        EXPECT_EQ(bound, global_bound);
    std::vector<shared::Vpl> extreme = mixed_vpls(100);
    for (std::size_t i = 0; i < extreme.size(); ++i) {
        const float factor = i % 2 == 0 ? 1e37F : 1e-37F;
        shared::float4& flux = extreme[i].flux;
        flux = {flux.x * factor, flux.y * factor, flux.z * factor, flux.w};
    }
    for (const float bound : bounds_of(TestBackend::own_bvh, extreme, 1.0F))
        EXPECT_TRUE(bound > 0.0F && bound <= 1e30F) << bound;
}

}  // namespace
}  // namespace weft::vpl_bounds_test
