// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "scene/flat_environment.h"
#include "scene/flat_scene.h"
#include "scene/validate_scene.h"
#include "selftest/statistics.h"
#include "tests/testing/environment_images.h"
#include "tests/testing/sphere_chi_square.h"
#include "tests/testing/surface_scenes.h"

#define NATIVE_KERNELS "kernels/path/path_surfaces.cl"
#include "tests/testing/native_kernels.h"

// Whole materials as paths meet them: from the description of a scene by its record, textures and
// tables to directions and pdfs in the world (kernels/bsdf/scattering.h). Estimates have fixed
// seeds; the limit, in standard deviations of a normal variable, is that of 40 comparisons, more
// than this file makes, which a correct sampler exceeds in one of them with a probability of 1e-6
// (Sidak 1967).
namespace weft::scattering_test {
namespace {

using native::dot3;
using native::f3;
using native::float3;
using test::SphereDirection;

const double limit = test::sidak_limit(40, 1e-6);

float3 direction(double cosine, double angle) {
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    return f3(static_cast<float>(sine * std::cos(angle)),
              static_cast<float>(sine * std::sin(angle)), static_cast<float>(cosine));
}

float3 narrowed(const SphereDirection& d) {
    return f3(static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z));
}

SphereDirection widened(float3 v) {
    return {double(v.x), double(v.y), double(v.z)};
}

/// Values of a scene as kernels read them.
template <class Native, class Shared>
const Native* as_native(const std::vector<Shared>& values) {
    static_assert(sizeof(Native) == sizeof(Shared));
    return reinterpret_cast<const Native*>(values.data());
}

/// A square about the origin whose outside is above, with tangents along x. Normal maps are the
/// scene's only texture, of one slope.
class Square {
  public:
    explicit Square(const SurfaceDescription& surface) {
        test::SceneBuilder builder;
        Texture slope;
        slope.width = slope.height = 1;
        slope.rgba = {150, 110, 240, 255};
        slope.srgb = false;
        builder.scene.textures.push_back(slope);
        Mesh mesh = test::quad_mesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
        mesh.uv_sets = {mesh.uvs};
        mesh.tangents.assign(mesh.positions.size(), glm::vec4(1, 0, 0, 1));
        builder.add(mesh, test::add_surface(builder, surface));
        validate_scene(builder.scene);
        flat_ = flatten(builder.scene);
        params_.features = flat_.features;
        geometry_.positions = as_native<native::float4>(flat_.positions);
        geometry_.triangles = as_native<native::Triangle>(flat_.triangles);
        geometry_.instances = as_native<native::InstanceRecord>(flat_.instances);
        geometry_.materials = as_native<native::MaterialRecord>(flat_.materials);
        geometry_.textures = as_native<native::TextureRecord>(flat_.textures);
        geometry_.texels = flat_.texels.data();
        tables_.records = as_native<native::SurfaceRecord>(flat_.surfaces.records);
        tables_.maps = as_native<native::SurfaceMap>(flat_.surfaces.maps);
        tables_.coordinates = flat_.surfaces.coordinates.data();
        tables_.of_instances = flat_.surfaces.of_instances.data();
        tables_.tangents = as_native<native::float4>(flat_.surfaces.tangents);
        tables_.interfaces = as_native<native::InterfaceRecord>(flat_.surfaces.interfaces);
        tables_.tables = flat_.surfaces.values.data();
    }
    Square(const Square&) = delete;
    Square& operator=(const Square&) = delete;

    /// How it scatters towards a viewer, above or below.
    [[nodiscard]] native::SurfaceScattering seen_from(float3 viewer) const {
        const native::Hit hit = {0, 1.0F, 0.25F, 0.25F};
        const native::Surface surface =
            native::surface_at(&params_, &geometry_, hit, -viewer, 0.0F);
        const native::SurfaceRecord& record = tables_.records[0];
        native::IndexRatio ratio = {record.eta.x, record.k.x};
        if (viewer.z < 0.0F) ratio = {1.0F / record.eta.x, record.k.y};
        return native::scattering_at(&params_, &geometry_, &tables_, &surface, hit, 0.0F, viewer,
                                     ratio);
    }

  private:
    FlatScene flat_;
    native::RenderParams params_{};
    native::Geometry geometry_{};
    native::SurfaceTables tables_{};
};

struct Case {
    const char* name;
    SurfaceDescription surface;
    double narrowest;  ///< least alpha
    bool below = false;
};

MetallicSurface layers(float roughness, float metallic = 0.0F) {
    MetallicSurface surface;
    surface.base_colour.factor = {0.9F, 0.6F, 0.3F};
    surface.metallic.factor = metallic;
    surface.roughness.value.factor = roughness;
    return surface;
}

SurfaceDescription tilted(const SurfaceModel& model) {
    SurfaceDescription surface{model, {}, {}};
    surface.normal_map.map.texture = 0;
    return surface;
}

std::vector<Case> cases() {
    MetallicSurface coated = layers(0.5F);
    coated.clearcoat.factor.factor = 0.8F;
    coated.clearcoat.roughness.value.factor = 0.3F;
    MetallicSurface everything = layers(0.6F, 0.3F);
    everything.transmission.factor = 0.5F;
    everything.solid = true;
    everything.anisotropy.strength = 0.6F;
    everything.anisotropy.rotation = 0.5F;
    everything.clearcoat = coated.clearcoat;
    everything.clearcoat.normal_map.map.texture = 0;
    MetallicSurface rough_glass = layers(0.4F);
    rough_glass.transmission.factor = 0.7F;
    rough_glass.solid = true;
    MetallicSurface pane = rough_glass;
    pane.solid = false;
    PlasticSurface plastic;
    plastic.roughness.value.factor = 0.1F;
    plastic.nonlinear = true;
    ConductorSurface brushed;
    brushed.roughness_u.value.factor = 0.1F;
    brushed.roughness_v.value.factor = 0.4F;
    brushed.microfacets = {MicrofacetDistribution::beckmann, true, true};
    DielectricSurface dielectric;
    dielectric.roughness_u.value.factor = dielectric.roughness_v.value.factor = 0.05F;
    return {{"diffuse, tilted", tilted(LambertSurface{}), 1.0},
            {"metal, tilted", tilted(layers(0.5F, 1.0F)), 0.25},
            {"metal and body at the smooth limit", {layers(0x1p-6F, 0.3F), {}, {}}, 0x1p-12},
            {"coated", {coated, {}, {}}, 0.09},
            {"everything", tilted(everything), 0.09},
            {"everything, inside", tilted(everything), 0.09, true},
            {"pane", {pane, {}, {}}, 0.16},
            {"rough glass, inside", {rough_glass, {}, {}}, 0.16, true},
            {"dielectric", {dielectric, {}, {}}, 0.05},
            {"plastic", {plastic, {}, {}}, 0.1},
            {"brushed metal", {brushed, {}, {}}, 0.1}};
}

test::SphereComparison compare(const native::SurfaceScattering& samples,
                               const native::SurfaceScattering& pdfs, float3 v, double narrowest,
                               std::size_t count) {
    native::Random random = native::make_random(1, 2, 3);
    const auto sample = [&]() -> std::optional<SphereDirection> {
        const float choice = native::next_random(&random);
        const float a = native::next_random(&random);
        const float b = native::next_random(&random);
        const native::BsdfSample s = native::scattering_sample(&samples, choice, a, b);
        if (!(s.pdf > 0.0F)) return std::nullopt;
        return widened(s.in);
    };
    // Where the facets mirror the viewer, and where glass sends light that goes on.
    const float3 n = pdfs.frame.normal;
    const float c = dot3(n, v);
    std::vector<test::PdfPeak> peaks = {{widened(n * (2.0F * c) - v), narrowest}};
    if (pdfs.model == SURFACE_LAYERED && pdfs.layered.glass > 0.0F) {
        const auto f = native::dielectric_fresnel(pdfs.layered.ratio, c);
        if (f.g > 0.0F)
            peaks.push_back({widened(native::refracted_direction(pdfs.layered.ratio, v, n, c, f.g)),
                             0.3 * narrowest});
    }
    return test::compare_on_sphere(
        [&](const SphereDirection& d) {
            return double(native::scattering_value(&pdfs, narrowed(d)).pdf);
        },
        peaks, sample, count, 28);
}

TEST(Scattering, SamplesOfWholeMaterialsFollowTheirPdf) {
    for (const auto& [name, surface, narrowest, below] : cases()) {
        const Square square(surface);
        for (const double cosine : {0.15, 0.8}) {
            const float3 v = direction(below ? -cosine : cosine, 1.0);
            const native::SurfaceScattering scattering = square.seen_from(v);
            const test::SphereComparison found =
                compare(scattering, scattering, v, narrowest, 200'000);
            EXPECT_LT(std::abs(found.normal), limit) << name << ' ' << cosine;
            EXPECT_NEAR(found.accepted, 1.0 - found.missing, 5e-3) << name << ' ' << cosine;
            EXPECT_GT(found.accepted, 0.3) << name << ' ' << cosine;
        }
    }
}

TEST(Scattering, TheTestSeesOtherPdfs) {
    // Of a surface whose roughness is another by 6 %, and whose map is not there.
    const float3 v = direction(0.8, 1.0);
    const auto normal = [&](const SurfaceDescription& a, const SurfaceDescription& b) {
        const Square one(a);
        const Square other(b);
        return compare(one.seen_from(v), other.seen_from(v), v, 0.2, 200'000).normal;
    };
    EXPECT_GT(normal({layers(0.5F, 1.0F), {}, {}}, {layers(0.53F, 1.0F), {}, {}}), limit);
    EXPECT_GT(normal({layers(0.5F), {}, {}}, tilted(layers(0.5F))), limit);
}

TEST(Scattering, LightIsTheSameBySamplesOfTheSkyByScatteredRaysAndByBoth) {
    // Light of a sky with a bright quarter, against a sum over even steps of the sphere. A texel is
    // 20 steps wide, which leaves 0.2 %. Of narrow lobes samples of the sky tell little.
    const EnvironmentImage sky = test::image_of(16, 8, false, [](const glm::dvec3& d) {
        return glm::vec3(d.x + d.y > 0.9 ? 8.0F : float(1.2 + d.y));
    });
    const FlatEnvironment flat = flatten_environment(sky, glm::dmat3(1.0));
    native::EnvironmentRecord record{};
    std::memcpy(&record, flat.records.data(), sizeof(record));
    const native::EnvironmentImage image = {&record, flat.texels.data(), flat.sums.data()};
    for (const auto& [name, surface, narrowest, below] : cases()) {
        if (narrowest < 0.08) continue;
        const Square square(surface);
        const float3 v = direction(below ? -0.7 : 0.7, 2.0);
        const native::SurfaceScattering scattering = square.seen_from(v);
        constexpr int rows = 160;
        double expected = 0.0;
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < 2 * rows; ++j) {
                const float3 l =
                    direction(2.0 * (i + 0.5) / rows - 1.0, std::numbers::pi * (j + 0.5) / rows);
                expected += double(native::scattering_value(&scattering, l).value.y) *
                            double(native::image_radiance(&image, l).y);
            }
        expected *= 4.0 * std::numbers::pi / (2.0 * rows * rows);
        native::Random random = native::make_random(4, 5, 6);
        constexpr int count = 40'000;
        double sums[3] = {};
        double squares[3] = {};
        for (int i = 0; i < count; ++i) {
            const float a = native::next_random(&random);
            const float b = native::next_random(&random);
            const float choice = native::next_random(&random);
            const float c = native::next_random(&random);
            const float d = native::next_random(&random);
            const native::EnvironmentSample lit = native::sample_image(&image, a, b);
            const native::LayeredValue value = native::scattering_value(&scattering, lit.direction);
            const double by_light = double(value.value.y * lit.radiance.y) / double(lit.pdf);
            const native::BsdfSample s = native::scattering_sample(&scattering, choice, c, d);
            const double by_ray =
                double(s.weight.y) * double(native::image_radiance(&image, s.in).y);
            const double of_light = double(lit.pdf) / double(lit.pdf + value.pdf);
            const double other =
                s.pdf > 0.0F
                    ? double(native::pdf_at_place(&image, native::image_place(&image, s.in)))
                    : 0.0;
            const double of_ray = s.pdf > 0.0F ? double(s.pdf) / (double(s.pdf) + other) : 0.0;
            const double found[3] = {by_light, by_ray, by_light * of_light + by_ray * of_ray};
            for (int k = 0; k < 3; ++k) {
                sums[k] += found[k];
                squares[k] += found[k] * found[k];
            }
        }
        for (int k = 0; k < 3; ++k) {
            const double mean = sums[k] / count;
            const double error = std::sqrt((squares[k] / count - mean * mean) / count);
            EXPECT_NEAR(mean, expected, limit * error + 3e-3 * expected) << name << ' ' << k;
            EXPECT_LT(error, 0.05 * expected) << name << ' ' << k;
        }
    }
}

}  // namespace
}  // namespace weft::scattering_test
