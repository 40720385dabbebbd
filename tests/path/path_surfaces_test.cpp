// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/testing/environment_images.h"
#include "tests/testing/floor_scenes.h"
#include "tests/testing/path_fixture.h"
#include "tests/testing/surface_scenes.h"

// Path tracing with metals, plastics and glass: in surroundings of radiance 1 what absorbs nothing
// is invisible, sheets let their share of light pass, normal maps turn surfaces, and images are the
// same however they are made. What glass does with rays is tested in surface_optics_test.cpp.
//
// The mean of an image is compared with its expectation by its standard error; the limit is that of
// 300 comparisons (sidak_limit: all of them together fail with a probability of 1e-4), more than
// this file makes. All seeds are fixed.
namespace weft::path_surfaces_test {
namespace {

using test::add_surface;
using test::glass;
using test::metal;
using test::Rendering;
using test::SceneBuilder;
using test::sheet;
using test::TestBackend;

constexpr std::size_t comparisons = 300;

void expect_mean(const Rendering& rendering, double expected, double largest_error,
                 const std::string& name) {
    for (std::uint32_t c = 0; c < 3; ++c)
        test::expect_estimate(test::beauty_of(rendering, c), expected,
                              {comparisons, largest_error, 1e-5},
                              name + " channel " + std::to_string(c));
}

std::string on(TestBackend backend, const std::string& what) {
    return std::string(test::backend_name(backend)) + " " + what;
}

/// The picture of a sphere that fills most of it, in surroundings of radiance 1.
Rendering sphere_in_a_furnace(TestBackend backend, const SurfaceDescription& surface,
                              std::uint32_t samples, std::uint32_t seed, bool smooth = false) {
    SceneBuilder builder;
    builder.scene.environment = Environment{glm::vec3(1.0F)};
    builder.add(smooth ? test::smooth_sphere(3) : test::icosphere(3, false),
                add_surface(builder, surface));
    return test::path_image(backend, builder.scene, test::look_at({0, 0, 3}, {0, 0, 0}, 0.6),
                            test::path_settings(16, 16, samples, seed));
}

/// That the mean is between two bounds, but for its standard error.
void expect_between(const Rendering& rendering, double low, double high, const std::string& name) {
    const auto found = test::beauty_of(rendering, 1);
    const double limit = test::sidak_limit(comparisons) * found.error;
    EXPECT_LE(found.error, 6e-3) << name;
    EXPECT_GE(found.mean, low - limit) << name;
    EXPECT_LE(found.mean, high + limit + 1e-5) << name;
}

double farthest_from_one(const Rendering& rendering) {
    double farthest = 0.0;
    for (const double value : test::channel_of(rendering, "", 0))
        farthest = std::max(farthest, std::abs(value - 1.0));
    return farthest;
}

TEST(PathSurfaces, WhiteMetalIsInvisibleInAFurnace) {
    for (const TestBackend backend : test::light_backends())
        for (const bool smooth : {false, true}) {
            // Every sample of a mirror has all of the radiance, at every pixel.
            EXPECT_LE(farthest_from_one(sphere_in_a_furnace(backend, metal(0.0F), 4, 1, smooth)),
                      1e-5)
                << on(backend, "mirror");
            // The albedo tables lie up to 0.5 % of what they tell above the truth.
            for (const float roughness : {0.1F, 0.3F, 1.0F})
                expect_between(sphere_in_a_furnace(backend, metal(roughness), 32, 1, smooth), 0.995,
                               1.0, on(backend, "metal " + std::to_string(roughness)));
        }
}

TEST(PathSurfaces, WhitePlasticIsInvisibleInAFurnace) {
    for (const TestBackend backend : test::light_backends())
        for (const float roughness : {0.0F, 0.3F, 1.0F})
            for (const float coat : {0.0F, 1.0F}) {
                MetallicSurface surface;
                surface.metallic.factor = 0.0F;
                surface.roughness.value.factor = roughness;
                surface.clearcoat.factor.factor = coat;
                surface.clearcoat.roughness.value.factor = 0.2F;
                expect_between(sphere_in_a_furnace(backend, {surface, {}, {}}, 32, 2), 0.995, 1.0,
                               on(backend, "plastic " + std::to_string(roughness)));
            }
}

TEST(PathSurfaces, ClearGlassIsInvisibleInAFurnace) {
    // 1 - 2^-10 and 1 + 2^-9 are about the least steps that are boundaries at all.
    for (const TestBackend backend : test::light_backends())
        for (const double index :
             {1.0, 1.0 - 0x1p-10, 1.0 + 0x1p-10, 1.0 + 0x1p-9, 1.33, 1.5, 2.42}) {
            const Rendering image = sphere_in_a_furnace(backend, glass(index), 64, 2);
            expect_mean(image, 1.0, 1e-3, on(backend, "glass " + std::to_string(index)));
            // Only roulette is left to chance, which ends one of 1000 at each surface but the
            // first.
            EXPECT_LE(farthest_from_one(image), 0.1) << index;
        }
}

TEST(PathSurfaces, RoughAndSmoothlyCurvedGlassLosesLittleInAFurnace) {
    // Balls of several roughnesses far from each other, seen one by one.
    constexpr float roughnesses[] = {0.1F, 0.4F, 0.8F};
    SceneBuilder builder;
    builder.scene.environment = Environment{glm::vec3(1.0F)};
    for (int i = 0; i < 3; ++i)
        builder.add(
            test::icosphere(3, false),
            add_surface(builder, test::absorbing_glass(1.5F, glm::vec3(1.0F), 0.0, roughnesses[i])),
            test::placement(1.0, {20.0 * i, 0, 0}));
    const FlatScene flat = flatten(builder.scene);
    for (const TestBackend backend : test::light_backends()) {
        // The tables of rough glass are made to err to loss, up to 1.2 %, at each boundary, and
        // paths meet several; they are known by the normal of the surface, where facets are not.
        for (int i = 0; i < 3; ++i)
            expect_between(test::path_image(test::shared_executor(backend), flat,
                                            test::look_at({20.0 * i, 0, 3}, {20.0 * i, 0, 0}, 0.6),
                                            test::path_settings(16, 16, 128, 3)),
                           0.95, 1.004,
                           on(backend, "rough glass " + std::to_string(roughnesses[i])));
        // Where interpolated normals send light to the wrong side of a triangle, it is lost.
        expect_between(sphere_in_a_furnace(backend, glass(1.5), 64, 4, true), 0.97, 1.0,
                       on(backend, "smooth glass"));
    }
}

/// Reflectance of a boundary at normal incidence.
double reflectance(double eta) {
    return test::fresnel_reflectance(1.0, eta, 1.0);
}

TEST(PathSurfaces, IndicesRelativeToWhatLiesAroundMultiply) {
    // A lamp in glass in glass, each of whose indices is relative to what it is in, as in Mitsuba's
    // files. Light goes back and forth between the two boundaries; the lamp is black.
    constexpr double outer = 1.4;
    constexpr double inner = 1.8 / 1.4;
    const auto local = [](double eta) {
        SurfaceDescription description = glass(eta);
        std::get<DielectricSurface>(description.model).local_index = true;
        return description;
    };
    SceneBuilder builder;
    builder.add(test::quad_mesh({-10, -10, 0}, {20, 0, 0}, {0, 20, 0}),
                builder.material(glm::vec3(0.0F), glm::vec3(2.0F)));
    Mesh box = test::room_mesh();
    for (auto& triangle : box.triangles) std::swap(triangle[1], triangle[2]);
    builder.add(box, add_surface(builder, local(outer)),
                glm::scale(glm::dmat4(1.0), glm::dvec3(30.0, 30.0, 0.5)));
    builder.add(box, add_surface(builder, local(inner)),
                glm::scale(glm::dmat4(1.0), glm::dvec3(20.0, 20.0, 0.25)));
    const double f = reflectance(outer);
    const double g = reflectance(inner);
    const double transmitted = (1.0 - f) * (1.0 - g) / (1.0 - f * g);
    for (const TestBackend backend : test::light_backends())
        expect_mean(
            test::path_image(backend, builder.scene, test::look_at({0, 0, 5}, {0, 0, 0}, 0.01),
                             test::path_settings(16, 16, 256, 12)),
            2.0 * transmitted / (outer * inner * outer * inner), 0.01,
            on(backend, "lamp in glass in glass"));
}

TEST(PathSurfaces, SheetsLetTheirShareOfLightPass) {
    // Seen before a bright wall, and in the light of a sun and of an area light on a floor, which
    // paths find both by its samples and by scattered rays.
    struct Sheets {
        int count;
        float alpha;
    };
    const double area_light =
        test::polygon_irradiance(test::corners_of(test::area_light_mesh()), {0, 0, 0}, {0, 0, 1});
    for (const auto& [sheets, alpha] : {Sheets{1, 0.3F}, Sheets{6, 0.3F}, Sheets{100, 0.02F}}) {
        const double passes = std::pow(1.0 - static_cast<double>(alpha), sheets);
        SceneBuilder seen = test::bright_wall();
        SceneBuilder sun = test::floor_scene();
        sun.light(LightType::directional, {}, glm::vec3(1.0F));
        SceneBuilder area = test::floor_scene();
        area.add(test::area_light_mesh(), area.material(glm::vec3(0.0F), glm::vec3(1.0F)));
        for (int i = 0; i < sheets; ++i) {
            const float z = 0.5F + 0.4F * static_cast<float>(i) / static_cast<float>(sheets);
            for (SceneBuilder* const builder : {&seen, &sun, &area})
                builder->add(test::quad_mesh({-40, -40, z}, {80, 0, 0}, {0, 80, 0}),
                             add_surface(*builder, sheet(alpha)));
        }
        // From below the sheets, the floor is seen as it is.
        const Camera camera = test::look_at(test::eye_offset, {0, 0, 0}, 0.001);
        for (const TestBackend backend : test::light_backends()) {
            const std::string name = on(backend, std::to_string(sheets) + " sheets");
            // Many sheets take long.
            const std::uint32_t fewer = sheets > 10 ? 8 : 1;
            expect_mean(test::path_image(backend, seen.scene, test::oblique_camera(1.0),
                                         test::path_settings(16, 16, 128 / fewer, 7)),
                        passes, 0.05, name);
            const double reflected =
                static_cast<double>(test::receiver_albedo.g) / std::numbers::pi * passes;
            // A few roundings for each sheet.
            test::expect_estimate(test::layer_of(test::path_image(backend, sun.scene, camera,
                                                                  test::path_settings(4, 4, 4, 8)),
                                                 "direct", 1),
                                  reflected, {comparisons, 1e-5, 1e-5}, name + " before the sun");
            test::expect_estimate(
                test::layer_of(test::path_image(backend, area.scene, camera,
                                                test::path_settings(16, 16, 64 / fewer, 9)),
                               "direct", 1),
                reflected * area_light, {comparisons, 0.02, 1e-4}, name + " before a lamp");
        }
    }
}

TEST(PathSurfaces, HolesAreThereFromBothSidesOfAOneSidedMask) {
    // Two texels, one opaque, one not; only the hole shows the wall, from the front and the back.
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.rgba = {255, 255, 255, 255, 255, 255, 255, 0};
    texture.nearest = true;
    texture.has_alpha = true;
    texture.wrap_u = texture.wrap_v = Wrap::clamp;
    for (const bool unlit : {false, true})
        for (const bool back : {false, true}) {
            SceneBuilder builder = test::bright_wall();
            builder.scene.textures.push_back(texture);
            SurfaceDescription mask = sheet(1.0F);
            if (unlit) mask.model = UnlitSurface{ColourParameter{glm::vec3(0.25F)}};
            mask.opacity.mode = OpacityMode::mask;
            mask.opacity.alpha.map.texture = 0;
            mask.opacity.alpha.map.channel = Channel::alpha;
            Mesh quad = back ? test::quad_mesh({1, -1, 0}, {-2, 0, 0}, {0, 2, 0})
                             : test::quad_mesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
            quad.uv_sets = {quad.uvs};
            const std::uint32_t material = add_surface(builder, mask);
            builder.scene.materials[material].two_sided = false;
            builder.add(quad, material);
            PathSettings settings = test::path_settings(2, 1, 4, 10);
            settings.through_centres = true;
            const Rendering image =
                test::path_image(TestBackend::own_bvh, builder.scene,
                                 test::look_at({0, 0, 1}, {0, 0, 0}, 0.5), settings);
            EXPECT_NEAR(image.at("", back ? 0 : 1, 0), 1.0F, 1e-5F) << back << unlit;
            EXPECT_NEAR(image.at("", back ? 1 : 0, 0), unlit && !back ? 0.25F : 0.0F, 1e-5F)
                << back << unlit;
        }
}

/// A texture of one colour, not of sRGB.
Texture plain_texture(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    Texture texture;
    texture.width = texture.height = 1;
    texture.rgba = {r, g, b, 255};
    texture.srgb = false;
    return texture;
}

/// A parallelogram with the coordinates and tangents that normal maps need.
Mesh mapped_quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
    Mesh mesh = test::quad_mesh(corner, u, v);
    mesh.uv_sets = {mesh.uvs};
    mesh.tangents.assign(mesh.positions.size(), glm::vec4(glm::normalize(u), 1.0F));
    return mesh;
}

TEST(PathSurfaces, AFlatNormalMapChangesNoBit) {
    // A map of any slopes that are scaled to nothing, on a smooth sphere with an anisotropic metal.
    const auto sums = [](bool mapped) {
        SceneBuilder builder;
        builder.scene.environment = Environment{glm::vec3(0.4F)};
        builder.scene.textures.push_back(plain_texture(190, 80, 255));
        builder.light(LightType::point, {1, 2, 3}, glm::vec3(20.0F));
        MetallicSurface surface;
        surface.base_colour.factor = {0.9F, 0.6F, 0.3F};
        surface.metallic.factor = 0.5F;
        surface.roughness.value.factor = 0.4F;
        surface.anisotropy.strength = 0.5F;
        surface.clearcoat.factor.factor = 0.5F;
        SurfaceDescription description{surface, {}, {}};
        if (mapped) {
            description.normal_map.map.texture = 0;
            description.normal_map.scale = 0.0F;
        }
        Mesh mesh = test::smooth_sphere(2);
        for (const glm::vec3& p : mesh.positions) {
            mesh.uvs.emplace_back(p.x, p.y);
            const glm::vec3 along = glm::cross(glm::vec3(0.1F, 1.0F, 0.2F), p);
            mesh.tangents.emplace_back(glm::normalize(along), 1.0F);
        }
        mesh.uv_sets = {mesh.uvs};
        builder.add(mesh, add_surface(builder, description));
        FilmSums found = test::path_sums(
            test::shared_executor(TestBackend::own_bvh), flatten(builder.scene),
            test::look_at({0, 0, 3}, {0, 0, 0}, 0.8), test::path_settings(16, 16, 4, 11));
        found.identity.clear();  // of the scene as it is written
        return found;
    };
    test::expect_same_sums(sums(false), sums(true));
}

TEST(PathSurfaces, ADiffuseNormalMapOfATiltedPlaneIsLitAsThatPlane) {
    // By a sun, which both planes see; seen from straight above and from the side.
    const glm::dvec3 slope = glm::dvec3(178, 90, 230) / 127.5 - 1.0;
    const glm::dvec3 normal = glm::normalize(slope);
    const glm::dvec3 sun = glm::normalize(glm::dvec3(-0.4, 0.3, -1.0));
    const glm::dvec3 albedo(0.8, 0.5, 0.25);
    LambertSurface lambert;
    lambert.colour.factor = glm::vec3(albedo);
    SurfaceDescription description{lambert, {}, {}};
    description.normal_map.map.texture = 0;
    for (const bool mirrored : {false, true})
        for (const glm::dvec3& eye : {glm::dvec3(0, 0, 3), glm::dvec3(2, 1, 1)}) {
            SceneBuilder builder;
            builder.scene.textures.push_back(plain_texture(178, 90, 230));
            builder.light(LightType::directional, {}, glm::vec3(2.0F), sun);
            Mesh quad = mapped_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
            // A mirrored texture: v runs the other way.
            if (mirrored)
                for (glm::vec4& tangent : quad.tangents) tangent.w = -1.0F;
            builder.add(quad, add_surface(builder, description));
            const glm::dvec3 tilted(normal.x, mirrored ? -normal.y : normal.y, normal.z);
            const Rendering image = test::path_image(TestBackend::own_bvh, builder.scene,
                                                     test::look_at(eye, {0.1, 0.2, 0}, 0.01),
                                                     test::path_settings(2, 2, 4, 12));
            for (std::uint32_t c = 0; c < 3; ++c) {
                const double expected = albedo[static_cast<glm::length_t>(c)] / std::numbers::pi *
                                        2.0 * -glm::dot(tilted, sun);
                EXPECT_NEAR(image.at("", 0, 0, c), expected, 1e-5 * expected)
                    << mirrored << ' ' << eye.x;
            }
        }
}

/// A sphere of a material in surroundings that grow brighter upwards, with a lamp beside it.
Rendering crossing_image(const SurfaceDescription& surface) {
    SceneBuilder builder;
    builder.scene.environment = Environment{
        glm::vec3(1.0F),
        std::make_shared<const EnvironmentImage>(test::image_of(
            8, 5, false, [](const glm::dvec3& d) { return glm::vec3(float(1.2 + d.y)); }))};
    builder.add(test::smooth_sphere(3), add_surface(builder, surface));
    builder.add(test::quad_mesh({-4, 0, 4}, {3, 0, 1}, {0, 3, 0}),
                builder.material(glm::vec3(0.0F), glm::vec3(3.0F)));
    return test::path_image(TestBackend::own_bvh, builder.scene,
                            test::look_at({0, 0, 4}, {0, 0, 0}, 0.5),
                            test::path_settings(16, 16, 32, 13));
}

TEST(PathSurfaces, RoughnessCrossesTheSmoothLimitWithoutAStep) {
    // Surfaces just below the limit, alpha = 2^-12, are mirrors whose light is found by rays alone;
    // just above it lights are sampled as well. Both take the same random numbers, so that what is
    // compared differs less than 2 % even where it is noisy.
    constexpr float alpha = 0x1p-12F;
    const auto by_alpha = [](bool rough) { return rough ? alpha : std::nextafter(alpha, 0.0F); };
    const auto by_root = [](bool rough) { return rough ? 0x1p-6F : std::nextafter(0x1p-6F, 0.0F); };
    for (const int kind : {0, 1, 2, 3, 4, 5, 6}) {
        const auto described = [&](bool rough) -> SurfaceDescription {
            MetallicSurface surface;
            surface.base_colour.factor = {0.8F, 0.5F, 0.3F};
            surface.metallic.factor = kind == 0 ? 1.0F : 0.0F;
            surface.roughness.value.factor = by_root(rough);
            surface.transmission.factor = kind == 2 || kind == 3 ? 1.0F : 0.0F;
            surface.solid = kind == 3;
            surface.clearcoat.factor.factor = kind == 4 ? 1.0F : 0.0F;
            surface.clearcoat.roughness.value.factor = by_root(rough);
            PlasticSurface plastic;
            plastic.roughness.value.factor = by_alpha(rough);
            DielectricSurface dielectric;
            dielectric.roughness_u.value.factor = by_alpha(rough);
            dielectric.roughness_v.value.factor = by_alpha(rough);
            dielectric.microfacets.single_scatter = true;
            if (kind == 5) return {plastic, {}, {}};
            if (kind == 6) return {dielectric, {}, {}};
            return {surface, {}, {}};
        };
        const Rendering below = crossing_image(described(false));
        const Rendering above = crossing_image(described(true));
        for (std::uint32_t c = 0; c < 3; ++c) {
            const auto a = test::beauty_of(below, c);
            const auto b = test::beauty_of(above, c);
            EXPECT_NEAR(b.mean, a.mean, 0.02 * a.mean)
                << "kind " << kind << ", errors " << a.error << ' ' << b.error;
            EXPECT_LT(a.error, 0.02 * a.mean) << kind;
        }
    }
}

TEST(PathSurfaces, BacksOfOneSidedSheetsHaveGapsToo) {
    constexpr float alpha = 0.3F;
    for (const bool turned : {false, true}) {
        SceneBuilder builder;
        builder.add(test::quad_mesh({-40, -40, -3}, {80, 0, 0}, {0, 80, 0}),
                    builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
        const std::uint32_t number = add_surface(builder, sheet(alpha));
        builder.scene.materials[number].two_sided = false;
        const glm::vec3 u(80, 0, 0);
        const glm::vec3 v(0, 80, 0);
        builder.add(test::quad_mesh({-40, -40, 0}, turned ? v : u, turned ? u : v), number);
        for (const TestBackend backend : test::light_backends())
            expect_mean(
                test::path_image(backend, builder.scene, test::look_at({0, 0, 5}, {0, 0, 0}, 0.01),
                                 test::path_settings(16, 16, 256, 14)),
                1.0 - static_cast<double>(alpha), 0.02,
                on(backend, turned ? "sheet from behind" : "sheet"));
    }
}

TEST(PathSurfaces, PanesReflectAndTransmitWithTheirColours) {
    // A pane before a bright wall, with the camera in surroundings of the radiance that it
    // reflects.
    const double f = reflectance(1.5);
    const double reflected = 2.0 * f / (1.0 + f);
    for (const bool thin : {true, false}) {
        DielectricSurface surface;
        surface.ior_inside = 1.5;
        surface.thin = thin;
        surface.local_index = true;
        surface.reflectance.factor = glm::vec3(0.5F);
        surface.transmittance.factor = glm::vec3(0.8F);
        SceneBuilder builder;
        builder.scene.environment = Environment{glm::vec3(3.0F)};
        builder.add(test::quad_mesh({-40, -40, -3}, {80, 0, 0}, {0, 80, 0}),
                    builder.material(glm::vec3(0.0F), glm::vec3(1.0F)));
        builder.add(test::quad_mesh({-35, -35, 0}, {70, 0, 0}, {0, 70, 0}),
                    add_surface(builder, {surface, {}, {}}));
        // Without a back, solid glass is its front alone: light comes out of the index 1.5.
        const double expected = thin ? 3.0 * 0.5 * reflected + 0.8 * (1.0 - reflected)
                                     : 3.0 * 0.5 * f + 0.8 * (1.0 - f) / (1.5 * 1.5);
        for (const TestBackend backend : test::light_backends())
            expect_mean(
                test::path_image(backend, builder.scene, test::look_at({0, 0, 5}, {0, 0, 0}, 0.01),
                                 test::path_settings(16, 16, 256, 15)),
                expected, 0.02, on(backend, thin ? "pane" : "boundary"));
    }
}

// A plate that is tilted about the x axis, with one normal everywhere, under light straight from
// above, seen along `viewer`. A Lambertian plate has a closed form for each rule of normal maps.
struct TiltedPlate {
    NormalMap normals{};
    bool mirrored = false;  // texture coordinates run the other way
    bool back = false;      // light and viewer are at the plate's back
    glm::dvec3 viewer{0.0, 0.0, 1.0};
};

constexpr double tilt_sine = 0.28;
constexpr double tilt_cosine = 0.96;

/// The normal that the texel is, in the frame of the plate.
glm::dvec3 texel_normal() {
    return glm::normalize(2.0 * glm::dvec3(179.0, 204.0, 220.0) / 255.0 - 1.0);
}

double plate_radiance(TestBackend backend, const TiltedPlate& plate) {
    SceneBuilder builder;
    Texture texture;
    texture.width = texture.height = 1;
    texture.rgba = {179, 204, 220, 255};
    texture.srgb = false;
    builder.scene.textures.push_back(texture);
    LambertSurface surface;
    surface.colour.factor = glm::vec3(0.5F);
    SurfaceDescription description{surface, plate.normals, {}};
    description.normal_map.map.texture = 0;
    const glm::vec3 x(6.0F, 0.0F, 0.0F);
    const glm::vec3 up(0.0F, 6.0F * static_cast<float>(tilt_cosine),
                       6.0F * static_cast<float>(tilt_sine));
    const glm::vec3 u = plate.back ? up : x;
    const glm::vec3 v = plate.back ? x : up;
    Mesh mesh = test::quad_mesh(-0.5F * (x + up), u, v);
    const float sign = plate.mirrored ? -1.0F : 1.0F;
    mesh.tangents.assign(mesh.positions.size(), glm::vec4(sign * glm::normalize(u), sign));
    mesh.uv_sets = {std::vector<glm::vec2>(mesh.positions.size(), glm::vec2(0.5F))};
    builder.add(mesh, add_surface(builder, description));
    builder.light(LightType::directional, {}, glm::vec3(1.0F));
    const Rendering image =
        test::path_image(backend, builder.scene, test::look_at(5.0 * plate.viewer, {}, 0.01),
                         test::path_settings(4, 4, 4, 13));
    return test::beauty_of(image, 1).mean;
}

TEST(PathSurfaces, NormalMapsFollowTheRulesOfTheirFormat) {
    const glm::dvec3 n = texel_normal();
    const glm::dvec3 along_x(1.0, 0.0, 0.0);
    const glm::dvec3 along_up(0.0, tilt_cosine, tilt_sine);
    const glm::dvec3 normal(0.0, -tilt_sine, tilt_cosine);
    NormalMap gltf;
    NormalMap mitsuba;
    mitsuba.mitsuba_frame = true;
    NormalMap shadowed = mitsuba;
    shadowed.mitsuba_shadowing = true;
    NormalMap flipped = mitsuba;
    flipped.mitsuba_flip = true;
    // From here the plate is seen, but not along the texel's normal.
    const glm::dvec3 low = glm::normalize(-0.7 * along_x - 0.6 * along_up + 0.3 * normal);
    ASSERT_LT(dot(low, n.x * along_x + n.y * along_up + n.z * normal), 0.0);
    const double tan_n = (1.0 - n.z * n.z) / (n.z * n.z);
    const double tan_l = (1.0 - tilt_cosine * tilt_cosine) / (tilt_cosine * tilt_cosine);
    const double shadowing = 2.0 / (1.0 + std::sqrt(1.0 + std::min(tan_n / 8.0, 1.0) * tan_l));
    // Cosines of the light with the normal.
    const double facing = n.y * tilt_sine + n.z * tilt_cosine;
    const double turned = -n.y * tilt_sine + n.z * tilt_cosine;
    const double behind = n.x * tilt_sine + n.z * tilt_cosine;
    const double behind_gltf = -n.x * tilt_sine + n.z * tilt_cosine;
    const auto check = [](const TiltedPlate& plate, double cosine, const char* what) {
        for (const TestBackend backend : test::light_backends())
            EXPECT_NEAR(plate_radiance(backend, plate), 0.5 / std::numbers::pi * cosine, 2e-6)
                << on(backend, what);
    };
    const glm::dvec3 above(0.0, 0.0, 1.0);
    check({gltf, false, false, above}, facing, "glTF");
    check({mitsuba, false, false, above}, facing, "Mitsuba");
    check({shadowed, false, false, above}, facing * shadowing, "shadowing");
    // The bitangent of mirrored coordinates runs as the texture does, or turns with the tangent.
    check({gltf, true, false, above}, facing, "glTF mirrored");
    check({mitsuba, true, false, above}, turned, "Mitsuba mirrored");
    check({gltf, false, true, above}, behind_gltf, "glTF from behind");
    check({mitsuba, false, true, above}, behind, "Mitsuba from behind");
    check({mitsuba, false, false, low}, 0.0, "facing away");
    check({flipped, false, false, low}, turned, "flipped");
    check({flipped, false, false, above}, facing, "nothing to flip");
}

TEST(PathSurfaces, SameBitsOnAllBackendsAndInParts) {
    SceneBuilder builder;
    builder.scene.environment = Environment{glm::vec3(0.3F)};
    builder.add(test::room_mesh(), builder.material(glm::vec3(0.6F)));
    builder.add(test::quad_mesh({-0.3F, 0.9F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    builder.add(test::icosphere(2, false), add_surface(builder, metal(0.3F, {0.9F, 0.6F, 0.3F})),
                test::placement(0.3, {-0.4, -0.5, 0}));
    builder.add(test::icosphere(2, false), add_surface(builder, glass(1.5)),
                test::placement(0.3, {0.4, -0.5, 0}));
    builder.add(test::quad_mesh({-0.5F, -0.5F, 0.5F}, {1, 0, 0}, {0, 0.5F, 0}),
                add_surface(builder, sheet(0.5F)));
    const FlatScene flat = flatten(builder.scene);
    const Camera camera = test::look_at({0, 0, 0.95}, {0, -0.2, -1}, 1.2);
    const auto sums = [&](TestBackend backend, std::uint32_t first, std::uint32_t end) {
        PathSettings settings = test::path_settings(24, 24, end, 9);
        settings.samples = {first, end};
        return test::path_sums(test::shared_executor(backend), flat, camera, settings);
    };
    const FilmSums whole = sums(TestBackend::own_bvh, 0, 8);
    FilmSums parts = sums(TestBackend::own_bvh, 0, 3);
    add_sums(parts, sums(TestBackend::own_bvh, 3, 8));
    test::expect_same_sums(whole, parts);
    for (const TestBackend backend : test::light_backends())
        test::expect_same_sums(whole, sums(backend, 0, 8));
}

}  // namespace
}  // namespace weft::path_surfaces_test
