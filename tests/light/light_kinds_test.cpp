// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "selftest/closed_forms.h"

#define NATIVE_KERNELS "kernels/light/light.h"
#define NATIVE_KERNELS_TOO "kernels/core/random.h"
#include "tests/testing/native_kernels.h"

// Every kind of light of kernels/light by what its samples add up to: the power that it emits, the
// irradiance of a surface, the light at a place in a medium. Means of 200,000 samples with fixed
// seeds; each may be off by 4.9 of its own standard errors, which one comparison of a million is,
// and by the rounding of floats. That devices compute the same bits is tested in
// surfaces_opencl_test.cpp.
namespace {

using native::f3;
using native::f4;
using native::float3;

constexpr double pi = std::numbers::pi;
constexpr int samples = 200'000;
constexpr float radius = 2.0F;  // of the scene
constexpr double limit = 4.9;

/// A square of edge 1 at z = 1 that shines down: its two triangles, and what kernels know of them.
struct SquareLight {
    std::vector<native::float4> positions = {f4(-0.5F, -0.5F, 1, 0), f4(0.5F, -0.5F, 1, 0),
                                             f4(0.5F, 0.5F, 1, 0), f4(-0.5F, 0.5F, 1, 0)};
    std::vector<native::Triangle> triangles = {{0, 2, 1, 0}, {0, 3, 2, 0}};
    std::vector<native::EmissiveTriangle> emissive = {{0, 0.5F, 0.5F, 0}, {1, 1.0F, 0.5F, 0}};
    std::vector<native::InstanceRecord> instances = {{0, 0, 0, 0}};

    native::Geometry geometry() const {
        native::Geometry made{};
        made.positions = positions.data();
        made.triangles = triangles.data();
        made.instances = instances.data();
        return made;
    }
};

/// Of scenes whose environment is the same everywhere; images are tested in
/// environment_image_test.cpp.
constexpr native::EnvironmentImage no_image{};

/// Lights of all kinds.
enum Kind : std::size_t { area, both_sides, point, spot, directional, environment, kinds };

std::vector<native::LightRecord> all_lights() {
    std::vector<native::LightRecord> lights(kinds);
    constexpr float probabilities[] = {0.25F, 0.125F, 0.125F, 0.25F, 0.125F, 0.125F};
    constexpr std::uint32_t emitters[] = {EMITTER_AREA, EMITTER_AREA,        EMITTER_POINT,
                                          EMITTER_SPOT, EMITTER_DIRECTIONAL, EMITTER_ENVIRONMENT};
    float sum = 0.0F;
    for (std::size_t i = 0; i < kinds; ++i) {
        native::LightRecord& light = lights[i];
        sum += probabilities[i];
        light.kind = emitters[i];
        light.probability = probabilities[i];
        light.cumulative = sum;
        light.choice_probability = probabilities[i];
        light.power = f4(3.0F, 2.0F, 1.0F, 0.0F);
    }
    for (const std::size_t i : {area, both_sides}) {
        lights[i].count = 2;
        lights[i].area = 1.0F;
    }
    lights[both_sides].both_sides = 1;
    for (const std::size_t i : {point, spot}) lights[i].position = f4(0.2F, -0.1F, 1.5F, 0.0F);
    lights[point].axis = f4(0, 0, -1, 0);
    lights[spot].axis = f4(0, 0, -1, 0);
    lights[spot].cos_inner = 0.95F;
    lights[spot].cos_outer = 0.7F;
    const float3 down = native::normalize3(f3(0.3F, 0.1F, -0.9F));
    lights[directional].axis = f4(down.x, down.y, down.z, 0.0F);
    return lights;
}

native::RenderParams scene_params() {
    native::RenderParams params{};
    params.scene.extent = 2.0F;
    params.scene.bounding_sphere = f4(0, 0, 0, radius);
    params.scene.environment = f4(3.0F, 2.0F, 1.0F, 0.0F);
    return params;
}

/// A mean with its standard error.
struct Mean {
    double value = 0.0;
    double error = 0.0;
};

Mean mean_of(const std::function<double(native::Random* random)>& sample) {
    native::Random random = native::make_random(21, 22, 23);
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < samples; ++i) {
        const double x = sample(&random);
        sum += x;
        squares += x * x;
    }
    const double mean = sum / samples;
    return {mean, std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples)};
}

void expect_mean(const Mean& mean, double expected, const std::string& what) {
    EXPECT_NEAR(mean.value, expected, limit * mean.error + 5e-6 * expected) << what;
    EXPECT_LT(mean.error, 0.01 * expected) << what;
}

native::EmissionNumbers numbers_of(native::Random* random) {
    native::EmissionNumbers numbers{};
    numbers.u = native::next_random(random);
    numbers.v = native::next_random(random);
    numbers.s = native::next_random(random);
    numbers.t = native::next_random(random);
    numbers.rest = native::next_random(random);
    return numbers;
}

/// What a light emits per unit of `power`: the closed forms of the integral over its area and
/// directions.
double emitted(const native::LightRecord& light) {
    const double inner = static_cast<double>(light.cos_inner);
    const double outer = static_cast<double>(light.cos_outer);
    switch (light.kind) {
        case EMITTER_AREA:
            return pi * static_cast<double>(light.area) * (1 + light.both_sides);
        case EMITTER_POINT:
            return 4.0 * pi;
        // The falloff is a square between the cones, whose integral is a third.
        case EMITTER_SPOT:
            return 2.0 * pi * ((1.0 - inner) + (inner - outer) / 3.0);
        case EMITTER_DIRECTIONAL:
            return pi * radius * radius;
        default:
            return 4.0 * pi * pi * radius * radius;
    }
}

TEST(LightKinds, EmitTheirPower) {
    const SquareLight square;
    const native::Geometry geometry = square.geometry();
    const native::RenderParams params = scene_params();
    const std::vector<native::LightRecord> lights = all_lights();
    for (std::size_t i = 0; i < kinds; ++i) {
        const native::LightRecord& light = lights[i];
        const Mean mean = mean_of([&](native::Random* random) {
            const native::EmissionNumbers numbers = numbers_of(random);
            const native::EmittedRay ray = native::emit_light(
                &params, &geometry, light, square.emissive.data(), &no_image, &numbers);
            EXPECT_NEAR(native::length3(ray.direction), 1.0F, 1e-5F);
            EXPECT_NEAR(ray.flux.z * 3.0F, ray.flux.x, 1e-5F * ray.flux.x);
            return static_cast<double>(ray.flux.z);
        });
        expect_mean(mean, emitted(light) / static_cast<double>(light.probability),
                    "light " + std::to_string(i));
    }
}

TEST(LightKinds, EmitTogetherWhatAllOfThemDo) {
    const SquareLight square;
    const native::Geometry geometry = square.geometry();
    const native::RenderParams params = scene_params();
    const std::vector<native::LightRecord> lights = all_lights();
    double expected = 0.0;
    for (const native::LightRecord& light : lights) expected += emitted(light);
    expect_mean(mean_of([&](native::Random* random) {
                    native::EmissionNumbers numbers = numbers_of(random);
                    const std::uint32_t chosen =
                        native::choose_light(lights.data(), kinds, &numbers.rest);
                    return static_cast<double>(
                        native::emit_light(&params, &geometry, lights[chosen],
                                           square.emissive.data(), &no_image, &numbers)
                            .flux.z);
                }),
                expected, "all kinds");
}

TEST(LightKinds, LightFromAfarFillsTheScenesDisk) {
    // Through a disk across the direction, outside of the scene: the middle of its points is below
    // the centre, and the mean square of their distances half the square of its radius.
    const SquareLight square;
    const native::Geometry geometry = square.geometry();
    const native::RenderParams params = scene_params();
    for (const std::size_t i : {directional, environment}) {
        const native::LightRecord light = all_lights()[i];
        expect_mean(mean_of([&](native::Random* random) {
                        const native::EmissionNumbers numbers = numbers_of(random);
                        const native::EmittedRay ray = native::emit_light(
                            &params, &geometry, light, square.emissive.data(), &no_image, &numbers);
                        const float along = native::dot3(ray.origin, ray.direction);
                        EXPECT_NEAR(along, -1.5F * radius, 1e-5F);
                        const float3 across = ray.origin - ray.direction * along;
                        return static_cast<double>(native::dot3(across, across));
                    }),
                    0.5 * radius * radius, "light " + std::to_string(i));
    }
}

/// A surface that looks up, at a point of the plane z = 0.
native::LitPoint floor_at(float x, float y) {
    native::LitPoint surface{};
    surface.position = f3(x, y, 0.0F);
    surface.normal = f3(0, 0, 1);
    surface.shading = surface.normal;
    return surface;
}

/// Irradiance that a sample estimates, of the last channel, by its own pdf alone.
double irradiance_of(const native::LightSample& sample) {
    const auto power = static_cast<double>(sample.power.z);
    if (!(sample.pdf > 0.0F)) return power * static_cast<double>(sample.share);
    return power * static_cast<double>(sample.in.z) / static_cast<double>(sample.pdf);
}

/// The closed form of it.
double floor_irradiance(const native::LightRecord& light, const native::LitPoint& surface) {
    const glm::dvec3 place(surface.position.x, surface.position.y, surface.position.z);
    if (light.kind == EMITTER_AREA)
        return weft::selftest::polygon_irradiance(
            {{-0.5, -0.5, 1}, {-0.5, 0.5, 1}, {0.5, 0.5, 1}, {0.5, -0.5, 1}}, place, {0, 0, 1});
    if (light.kind == EMITTER_DIRECTIONAL) return -static_cast<double>(light.axis.z);
    const glm::dvec3 towards =
        glm::dvec3(light.position.x, light.position.y, light.position.z) - place;
    const double distance = glm::length(towards);
    const double cosine = towards.z / distance;
    double falloff = 1.0;
    if (light.kind == EMITTER_SPOT) {
        const double inner = static_cast<double>(light.cos_inner);
        const double outer = static_cast<double>(light.cos_outer);
        falloff = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
        falloff *= falloff;
    }
    return falloff * cosine / (distance * distance);
}

TEST(LightKinds, LightSurfacesAsTheirClosedForms) {
    const SquareLight square;
    const native::Geometry geometry = square.geometry();
    const native::RenderParams params = scene_params();
    const std::vector<native::LightRecord> lights = all_lights();
    for (const native::LitPoint& surface : {floor_at(0, 0), floor_at(0.7F, -0.4F)})
        for (std::size_t i = 0; i < environment; ++i) {
            const native::LightRecord& light = lights[i];
            const float probability = light.choice_probability;
            expect_mean(mean_of([&](native::Random* random) {
                            const float u = native::next_random(random);
                            const float v = native::next_random(random);
                            const native::LightSample sample = native::light_at_surface(
                                &params, &geometry, light, square.emissive.data(), &no_image,
                                &surface, surface.position, probability, u, v);
                            return irradiance_of(sample);
                        }),
                        floor_irradiance(light, surface) / static_cast<double>(probability),
                        "light " + std::to_string(i));
        }
}

TEST(LightKinds, LightNoSurfaceFromBehind) {
    const SquareLight square;
    const native::Geometry geometry = square.geometry();
    const native::RenderParams params = scene_params();
    native::LitPoint ceiling = floor_at(0, 0);
    ceiling.normal = f3(0, 0, -1);
    ceiling.shading = ceiling.normal;
    native::LitPoint above = floor_at(0.1F, 0.1F);
    above.position.z = 2.0F;
    above.normal = above.shading = f3(0, 0, -1);
    const std::vector<native::LightRecord> lights = all_lights();
    const auto sample = [&](std::size_t i, const native::LitPoint& surface) {
        return native::light_at_surface(&params, &geometry, lights[i], square.emissive.data(),
                                        &no_image, &surface, surface.position, 1.0F, 0.3F, 0.6F);
    };
    for (std::size_t i = 0; i < environment; ++i)
        EXPECT_EQ(irradiance_of(sample(i, ceiling)), 0.0) << i;
    EXPECT_EQ(irradiance_of(sample(area, above)), 0.0);
    EXPECT_GT(irradiance_of(sample(both_sides, above)), 0.0);
}

TEST(LightKinds, ScatteredRaysMeetLightsAsOftenAsTheyAreSampled) {
    const SquareLight square;
    const native::Geometry geometry = square.geometry();
    const native::RenderParams params = scene_params();
    const std::vector<native::LightRecord> lights = all_lights();
    const native::LitPoint surface = floor_at(0.3F, 0.1F);
    const auto sample =
        native::light_at_surface(&params, &geometry, lights[area], square.emissive.data(),
                                 &no_image, &surface, surface.position, 1.0F, 0.4F, 0.8F);
    const float length = native::length3(sample.towards);
    const float found =
        native::met_light_pdf(&params, &geometry, lights.data(), square.emissive.data(), 0, 0,
                              f3(0, 0, -1), sample.towards / length, length);
    EXPECT_NEAR(found, sample.pdf, 1e-4F * sample.pdf);
    EXPECT_EQ(native::met_light_pdf(&params, &geometry, lights.data(), square.emissive.data(), 0, 0,
                                    f3(0, 0, -1), f3(0, 0, -1), 1.0F),
              0.0F);
}

/// The square with a texture of which one half, y > 0, is bright. Its triangles are chosen as if
/// the first were three times as bright as the other.
struct TexturedSquare : SquareLight {
    std::vector<float> coordinates = {0, 0, 0, 0, 1, 0, 1, 0};
    std::vector<native::TextureRecord> textures = {{0, 2, 1, TEXTURE_NEAREST}};
    std::vector<std::uint32_t> texels = {0x000000, 0x80FFFF};
    std::vector<native::MaterialRecord> materials{1};
    native::LightRecord light = all_lights()[area];
    native::RenderParams params = scene_params();
    native::Geometry all = geometry();

    TexturedSquare() {
        emissive = {{0, 0.75F, 0.75F, 0.75F / 0.5F}, {1, 1.0F, 0.25F, 0.25F / 0.5F}};
        light.textured = 1;
        params.features = FEATURE_EMISSION_TEXTURES;
        all.texture_coordinates = coordinates.data();
        all.textures = textures.data();
        all.texels = texels.data();
        all.materials = materials.data();
    }
};

TEST(LightKinds, TexturedLightsShineAsTheirTexture) {
    const TexturedSquare square;
    const native::RenderParams& params = square.params;
    const double blue = 128.0 / 255.0;
    expect_mean(mean_of([&](native::Random* random) {
                    const native::EmissionNumbers numbers = numbers_of(random);
                    return static_cast<double>(
                        native::emit_light(&params, &square.all, square.light,
                                           square.emissive.data(), &no_image, &numbers)
                            .flux.z);
                }),
                blue * 0.5 * pi / static_cast<double>(square.light.probability), "power");
    const native::LitPoint surface = floor_at(0.3F, 0.1F);
    const float probability = square.light.choice_probability;
    const double expected = blue * weft::selftest::polygon_irradiance(
                                       {{-0.5, 0, 1}, {-0.5, 0.5, 1}, {0.5, 0.5, 1}, {0.5, 0, 1}},
                                       {0.3, 0.1, 0}, {0, 0, 1});
    expect_mean(mean_of([&](native::Random* random) {
                    const float u = native::next_random(random);
                    const float v = native::next_random(random);
                    return irradiance_of(native::light_at_surface(
                        &params, &square.all, square.light, square.emissive.data(), &no_image,
                        &surface, surface.position, probability, u, v));
                }),
                expected / static_cast<double>(probability), "irradiance");
}

TEST(LightKinds, ScatteredRaysMeetTexturedLightsAsOftenAsTheyAreSampled) {
    const TexturedSquare square;
    const native::RenderParams& params = square.params;
    std::vector<native::LightRecord> lights = {square.light};
    const native::LitPoint surface = floor_at(0.3F, 0.1F);
    for (const float u : {0.4F, 0.9F}) {  // of the first triangle, and of the second
        const auto sample =
            native::light_at_surface(&params, &square.all, square.light, square.emissive.data(),
                                     &no_image, &surface, surface.position, 1.0F, u, 0.8F);
        const float length = native::length3(sample.towards);
        const std::uint32_t triangle = u < 0.75F ? 0 : 1;
        const float found =
            native::met_light_pdf(&params, &square.all, lights.data(), square.emissive.data(),
                                  triangle, 0, f3(0, 0, -1), sample.towards / length, length);
        EXPECT_NEAR(found, sample.pdf, 1e-4F * sample.pdf) << u;
    }
    // A triangle without a bright texel is never sampled.
    std::vector<native::EmissiveTriangle> one = square.emissive;
    one[1].density = 0.0F;
    EXPECT_EQ(native::met_light_pdf(&params, &square.all, lights.data(), one.data(), 1, 0,
                                    f3(0, 0, -1), f3(0, 0, 1), 1.0F),
              0.0F);
}

TEST(LightKinds, ReachPlacesInMediaAsTheirClosedForms) {
    const SquareLight square;
    const native::Geometry geometry = square.geometry();
    const native::RenderParams params = scene_params();
    const std::vector<native::LightRecord> lights = all_lights();
    const float3 place = f3(0, 0, 0);
    // The solid angle of a square of edge 1, seen from 1 below its centre.
    const double solid = 4.0 * std::atan(0.25 / std::sqrt(0.25 + 0.25 + 1.0));
    const native::LitPoint level = floor_at(0, 0);
    const double distance = std::sqrt(0.04 + 0.01 + 2.25);
    const double cosine = 1.5 / distance;
    for (std::size_t i = 0; i < environment; ++i) {
        const native::LightRecord& light = lights[i];
        const double expected =
            light.kind == EMITTER_AREA
                ? solid
                : (light.kind == EMITTER_DIRECTIONAL ? 1.0
                                                     : floor_irradiance(light, level) / cosine);
        const float probability = light.choice_probability;
        expect_mean(mean_of([&](native::Random* random) {
                        const float u = native::next_random(random);
                        const float v = native::next_random(random);
                        const native::ChosenPoint chosen = native::point_on_light(
                            &params, &geometry, light, square.emissive.data(), &no_image,
                            probability, u, v);
                        return static_cast<double>(
                            native::light_at_place(&params, &chosen, place).irradiance.z);
                    }),
                    expected / static_cast<double>(probability), "light " + std::to_string(i));
    }
}

TEST(LightKinds, TheEnvironmentGivesPiOfItsRadiance) {
    const native::RenderParams params = scene_params();
    expect_mean(
        mean_of([&](native::Random* random) {
            const float u = native::next_random(random);
            const float v = native::next_random(random);
            const float3 d = native::environment_direction(u, v);
            const float cosine = std::max(0.0F, d.z);
            return static_cast<double>(native::environment_radiance(&params, &no_image, d).z *
                                       cosine * SPHERE_SOLID_ANGLE);
        }),
        pi, "by directions of the sphere");
    expect_mean(mean_of([&](native::Random* random) {
                    const float u = native::next_random(random);
                    const float v = native::next_random(random);
                    const float3 d = native::environment_local_direction(u, v);
                    // The cosine over its pdf, where that is not 0.
                    return d.z > 0.0F ? static_cast<double>(d.z) / double(native::cosine_pdf(d.z))
                                      : pi;
                }),
                static_cast<double>(COSINE_IRRADIANCE), "by directions about the normal");
    EXPECT_NEAR(double(COSINE_IRRADIANCE), pi, 1e-6);
}

}  // namespace
