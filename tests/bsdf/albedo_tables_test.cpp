// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/surface/albedo_grid.h"
#include "scene/surface/facet_albedo.h"
#include "scene/surface/glass_table.h"
#include "tests/bsdf/whole_glass_table.h"

#define NATIVE_KERNELS "kernels/bsdf/albedo_tables.h"
#define NATIVE_KERNELS_TOO "kernels/bsdf/rough_glass.h"
#include "tests/testing/native_kernels.h"

// The tables of kernels/bsdf/albedo_tables.h, and those that the host makes of rough glass, against
// quadrature.
namespace weft::albedo_tables_test {
namespace {

using native::f3;
using native::Facets;
using native::float3;
using native::make_facets;

Facets of_roughness(double roughness) {
    const auto alpha = static_cast<float>(roughness * roughness);
    return make_facets(alpha, alpha, 0);
}

TEST(AlbedoTables, HoldTheKnownValues) {
    struct Known {
        double roughness;
        double at_1, at_half, at_tenth, mean, schlick_mean;
    };
    const FacetQuadrature quadrature(128);
    // A closed form.
    EXPECT_NEAR(quadrature.facet_albedo(1.0, 1.0).all, 1.0 - std::numbers::ln2, 1e-6);
    for (const Known& known : {Known{0.25, 0.99569, 0.98832, 0.89677, 0.98725, 0.0396},
                               Known{0.5, 0.91581, 0.85726, 0.89162, 0.88232, 0.0187},
                               Known{0.75, 0.62689, 0.66318, 0.84836, 0.65620, 0.0070},
                               Known{1.0, 0.30685, 0.45069, 0.76021, 0.40914, 0.0028}}) {
        const double alpha = known.roughness * known.roughness;
        EXPECT_NEAR(quadrature.facet_albedo(1.0, alpha).all, known.at_1, 2e-5);
        EXPECT_NEAR(quadrature.facet_albedo(0.5, alpha).all, known.at_half, 2e-5);
        EXPECT_NEAR(quadrature.facet_albedo(0.1, alpha).all, known.at_tenth, 2e-5);
        const Facets facets = of_roughness(known.roughness);
        EXPECT_NEAR(native::facet_albedo(facets, 1.0F).all, known.at_1, 1e-3);
        EXPECT_NEAR(native::facet_albedo(facets, 0.5F).all, known.at_half, 1e-3);
        EXPECT_NEAR(native::facet_albedo(facets, 0.1F).all, known.at_tenth, 2e-3);
        EXPECT_NEAR(native::mean_facet_albedo(facets).all, known.mean, 2e-4);
        EXPECT_NEAR(native::mean_facet_albedo(facets).schlick, known.schlick_mean, 1e-4);
    }
}

TEST(AlbedoTables, AreTheIntegralsOfTheLobe) {
    // Over directions of light, with nothing in common with the tables' quadrature.
    for (const double roughness : {0.25, 0.5, 1.0})
        for (const double cosine : {1.0, 0.5, 0.1}) {
            const Facets facets = of_roughness(roughness);
            const double sine = std::sqrt(1.0 - cosine * cosine);
            const float3 v = f3(static_cast<float>(sine), 0.0F, static_cast<float>(cosine));
            constexpr int rows = 1500;
            constexpr int columns = 1500;
            double all = 0.0;
            double schlick = 0.0;
            for (int i = 0; i < rows; ++i) {
                const double z = (i + 0.5) / rows;
                for (int j = 0; j < columns; ++j) {
                    const double angle = std::numbers::pi * (j + 0.5) / columns;
                    const double s = std::sqrt(1.0 - z * z);
                    const float3 l =
                        f3(static_cast<float>(s * std::cos(angle)),
                           static_cast<float>(s * std::sin(angle)), static_cast<float>(z));
                    const float3 h = v + l;
                    const double value = double(native::facet_reflection(facets, v, l, h));
                    all += value;
                    schlick += value * double(native::schlick_weight(native::facet_cosine(h)));
                }
            }
            const double cell = 2.0 * std::numbers::pi / (rows * columns);
            const FacetAlbedo expected =
                FacetQuadrature(128).facet_albedo(cosine, roughness * roughness);
            // Of narrow peaks the midpoints miss a little.
            const double slack = roughness < 0.5 ? 8e-4 : 3e-4;
            EXPECT_NEAR(all * cell, expected.all, slack) << roughness << ' ' << cosine;
            EXPECT_NEAR(schlick * cell, expected.schlick, slack) << roughness << ' ' << cosine;
        }
}

TEST(AlbedoTables, LieNowhereBelowTheTruth) {
    const FacetQuadrature quadrature(64);
    const AlbedoGrid places(ALBEDO_NODES, [](double, double) { return 0.0; });
    double most = 0.0;
    double mean = 0.0;
    int count = 0;
    for (int i = 0; i < 2 * (ALBEDO_NODES - 1); ++i)
        for (int j = 0; j < 2 * (ALBEDO_NODES - 1); ++j) {
            const double cosine = places.cosine_of((j + 0.4) / 2.0);
            const double alpha = places.alpha_of((i + 0.4) / 2.0);
            if (alpha < double(LEAST_ALPHA)) continue;
            const FacetAlbedo exact = quadrature.facet_albedo(cosine, alpha);
            const auto found = native::facet_albedo(
                make_facets(static_cast<float>(alpha), static_cast<float>(alpha), 0),
                static_cast<float>(cosine));
            // The quadrature itself is that exact.
            ASSERT_GT(found.all, exact.all - 3e-4) << cosine << ' ' << alpha;
            ASSERT_GT(found.schlick, exact.schlick - 3e-4) << cosine << ' ' << alpha;
            ASSERT_LE(found.all, 1.0F);
            if (cosine < 0.02) continue;
            most = std::max(most, double(found.all) - exact.all);
            mean += double(found.all) - exact.all;
            ++count;
        }
    // Finer, at fewer places: a white metal reflects no more than this.
    const FacetQuadrature fine(256);
    for (int i = 1; i < 16; ++i)
        for (int j = 1; j < 16; ++j) {
            const Facets facets = of_roughness(i / 15.0);
            const double cosine = j * j / 225.0;
            const double exact = fine.facet_albedo(cosine, double(facets.alpha_x)).all;
            const double found =
                double(native::facet_albedo(facets, static_cast<float>(cosine)).all);
            ASSERT_LT(exact / found, 1.0001) << cosine << ' ' << i;
        }
    EXPECT_LT(most, 4e-3);
    EXPECT_LT(mean / count, 3e-4);
}

TEST(AlbedoTables, AnisotropicFacetsHaveBounds) {
    // By the facets' own samples, in a lattice of 16384 points.
    for (const float alpha : {1.0F, 0.7F, 0.3F, 0.1F})
        for (const float ratio : {0.9F, 0.5F, 0.25F, 0.1F, 0.02F})
            for (const float cosine : {0.02F, 0.05F, 0.1F, 0.3F, 0.6F, 1.0F})
                for (const float angle : {0.0F, 0.3F, 0.8F, 1.5707F}) {
                    const Facets facets = make_facets(alpha, alpha * ratio, 0);
                    const float sine = std::sqrt((1.0F - cosine) * (1.0F + cosine));
                    const float3 v = f3(sine * std::cos(angle), sine * std::sin(angle), cosine);
                    const float k = native::reflecting_cap(facets, v);
                    double all = 0.0;
                    double schlick = 0.0;
                    constexpr int count = 16384;
                    for (int i = 0; i < count; ++i) {
                        const float a = static_cast<float>(i) / count;
                        const float b =
                            static_cast<float>(std::fmod((i + 0.5) * 0.6180339887498949, 1.0));
                        const float3 m = native::sample_facet(facets, v, k, a, b);
                        const float c = native::dot3(v, m);
                        const float3 l = native::reflected_direction(v, m, c);
                        if (!(l.z > 0.0F)) continue;
                        const double weight = double(native::facet_reflection(facets, v, l, v + l) /
                                                     native::facet_pdf(facets, v, k, v + l));
                        all += weight / count;
                        schlick += weight * double(native::schlick_weight(c)) / count;
                    }
                    const auto bound = native::facet_albedo(facets, cosine);
                    EXPECT_LT(all, double(bound.all) + 1e-3)
                        << alpha << ' ' << ratio << ' ' << cosine << ' ' << angle;
                    EXPECT_LT(schlick, double(bound.schlick) + 1e-3)
                        << alpha << ' ' << ratio << ' ' << cosine << ' ' << angle;
                }
}

TEST(AlbedoTables, CompensationIsAllThatFacetsLeave) {
    for (int i = 1; i <= 16; ++i)
        for (const float cosine : {0.02F, 0.1F, 0.5F, 1.0F}) {
            const Facets facets = of_roughness(i / 16.0);
            const auto albedo = native::facet_albedo(facets, cosine);
            const auto mean = native::mean_facet_albedo(facets);
            const float3 white = f3(1, 1, 1);
            const float3 black = f3(0, 0, 0);
            // Facets that absorb nothing.
            EXPECT_NEAR(native::compensation(white, white, albedo, mean).x * albedo.all, 1.0F,
                        1e-6F);
            EXPECT_EQ(native::compensation(black, black, albedo, mean).y, 1.0F);
            float before = 1.0F;
            for (const float f : {0.04F, 0.3F, 0.9F, 1.0F}) {
                const float3 grey = f3(f, f, f);
                const float now = native::compensation(grey, grey, albedo, mean).z;
                EXPECT_GE(now, before);
                // No more than what facets reflect that absorb nothing.
                EXPECT_LE(now * f * albedo.all, f * 1.000001F);
                before = now;
            }
        }
    const auto smooth = native::facet_albedo(make_facets(0.0F, 0.0F, 0), 0.5F);
    EXPECT_EQ(smooth.all, 1.0F);
    EXPECT_EQ(smooth.schlick, 0.03125F);
    EXPECT_EQ(native::compensation(f3(1, 1, 1), f3(1, 1, 1), smooth, smooth).x, 1.0F);
}

TEST(AlbedoTables, RoughGlassLosesWhatIsKnown) {
    const FacetQuadrature quadrature(128);
    const double expected[][4] = {{1.5, 0.992, 0.961, 0.916}, {1.0 / 1.5, 0.929, 0.827, 0.811}};
    for (const auto& [eta, at_1, at_half, at_tenth] : expected) {
        EXPECT_NEAR(quadrature.glass_albedo(1.0, 0.25, eta), at_1, 1e-3);
        EXPECT_NEAR(quadrature.glass_albedo(0.5, 0.25, eta), at_half, 1e-3);
        EXPECT_NEAR(quadrature.glass_albedo(0.1, 0.25, eta), at_tenth, 1e-3);
    }
    EXPECT_NEAR(quadrature.glass_albedo(1.0, 1.0, 1.0 / 1.5), 0.417, 1e-3);
    EXPECT_NEAR(quadrature.glass_albedo(0.5, 1.0, 1.0 / 1.5), 0.513, 1e-3);
    EXPECT_NEAR(quadrature.glass_albedo(0.1, 1.0, 1.0 / 1.5), 0.511, 1e-3);
}

TEST(AlbedoTables, GlassTablesLieNowhereBelowTheTruth) {
    static_assert(glass_nodes == GLASS_ALBEDO_NODES);
    const FacetQuadrature quadrature(96);
    for (const double eta : {1.5, 1.0 / 2.42}) {
        const std::vector<float> table = test::whole_glass_table(eta);
        for (int i = 0; i <= 20; ++i)
            for (int j = 1; j <= 20; ++j) {
                const double cosine = j / 20.0;
                const double roughness = 0.02 + 0.98 * i / 20.0;
                const Facets facets = of_roughness(roughness);
                const float found =
                    native::glass_albedo(table.data(), facets, static_cast<float>(cosine));
                const double exact = quadrature.glass_albedo(cosine, double(facets.alpha_x), eta);
                EXPECT_GT(found, exact - 3e-3) << eta << ' ' << cosine << ' ' << roughness;
                EXPECT_LT(found, exact + 1.2e-2) << eta << ' ' << cosine << ' ' << roughness;
                EXPECT_LE(found, 1.0F);
            }
        EXPECT_EQ(native::glass_albedo(table.data(), make_facets(0.0F, 0.0F, 0), 0.3F), 1.0F);
    }
}

TEST(AlbedoTables, RowsOfGlassAreTheSameWhicheverOthersThereAre) {
    const std::vector<float> whole = test::whole_glass_table(1.5);
    GlassTable table(1.5);
    // A row of its own, where rounding decides which others are read.
    const double node =
        AlbedoGrid(glass_nodes, {0, 1}, [](double, double) { return 1.0; }).alpha_of(7.0);
    for (const double alpha : {1.0, 0.25, 0.04, 0x1p-12, node}) {
        // Nothing that a direction reads of this roughness is left as it was.
        std::vector<float> rows(glass_table_size, -1.0F);
        table.write_rows(alpha, alpha, rows);
        const Facets facets = make_facets(static_cast<float>(alpha), static_cast<float>(alpha), 0);
        for (int j = 0; j <= 50; ++j) {
            const auto cosine = static_cast<float>(j / 50.0);
            EXPECT_EQ(native::glass_albedo(rows.data(), facets, cosine),
                      native::glass_albedo(whole.data(), facets, cosine))
                << alpha << ' ' << cosine;
        }
        const auto written =
            std::count_if(rows.begin(), rows.end(), [](float value) { return value >= 0.0F; });
        EXPECT_LE(written, 3 * glass_nodes) << alpha;
        for (std::size_t i = 0; i < rows.size(); ++i)
            EXPECT_TRUE(rows[i] < 0.0F || rows[i] == whole[i]) << i;
    }
}

}  // namespace
}  // namespace weft::albedo_tables_test
