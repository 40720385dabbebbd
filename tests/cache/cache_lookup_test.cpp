// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#define NATIVE_KERNELS "kernels/cache/cache_lookup.cl"
#include "tests/testing/native_kernels.h"

// The weights that records have for pixels, against their formulas in double precision. What is off
// is the rounding of 1 - n.n', at most 1e-7, which is 1e-5 of its least value here.
namespace weft::cache_lookup_test {
namespace {

constexpr int pixels = NODE_WIDTH;
constexpr double tolerance = 2e-5;

/// A record at the origin with normal z, which serves places within 0.5.
native::CacheRecord plain_record() {
    native::CacheRecord record{};
    record.position = native::f4(0.0F, 0.0F, 0.0F, 0.5F);
    record.normal = native::f4(0.0F, 0.0F, 1.0F, 0.0F);
    return record;
}

/// Pixels about it, and what weights are made of.
struct Pixels {
    native::SurfaceRow row{};
    double distance[pixels]{};
    double turned[pixels]{};  ///< 1 - n.n'
};

Pixels random_pixels(std::mt19937& random) {
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    Pixels made;
    for (int i = 0; i < pixels; ++i) {
        const float angle = 6.28F * uniform(random);
        const float distance = 0.6F * uniform(random);
        made.row.x[i] = distance * std::cos(angle);
        made.row.y[i] = distance * std::sin(angle);
        made.row.normal_z[i] = 1.0F;
        const float turn = 0.15F + 0.3F * uniform(random);
        made.row.shading_x[i] = std::sin(turn);
        made.row.shading_z[i] = std::cos(turn);
        made.distance[i] =
            std::hypot(static_cast<double>(made.row.x[i]), static_cast<double>(made.row.y[i]));
        made.turned[i] = 1.0 - static_cast<double>(made.row.shading_z[i]);
    }
    return made;
}

native::RenderParams params_with(std::uint32_t features, float error) {
    native::RenderParams params{};
    params.features = features;
    params.sampling.record_error = error;
    return params;
}

TEST(CacheLookup, RecordsOfHemispheresHaveWardsWeights) {
    const native::CacheRecord record = plain_record();
    std::mt19937 random(1);
    for (const double error : {0.2, 0.4, 0.8}) {
        const native::RenderParams params =
            params_with(FEATURE_HEMISPHERES, static_cast<float>(error));
        int served = 0;
        for (int i = 0; i < 100; ++i) {
            const Pixels about = random_pixels(random);
            const native::NFloat weights = native::row_weights(&params, &about.row, &record);
            for (int k = 0; k < pixels; ++k) {
                // R = 0.5 / a: the weight is a / (d / R + sqrt(1 - n.n')) - 1.
                const double estimate =
                    about.distance[k] * error / 0.5 + std::sqrt(about.turned[k]);
                const double expected = std::max(0.0, error / estimate - 1.0);
                EXPECT_NEAR(static_cast<double>(weights[k]), expected, tolerance * (1 + expected));
                served += expected > 0.0 ? 1 : 0;
            }
        }
        EXPECT_GT(served, 10);
        EXPECT_LT(served, 100 * pixels);
    }
}

TEST(CacheLookup, OthersHaveWeightsWithoutCusps) {
    const native::CacheRecord record = plain_record();
    const native::RenderParams params = params_with(0, 0.2F);
    std::mt19937 random(2);
    for (int i = 0; i < 100; ++i) {
        const Pixels about = random_pixels(random);
        const native::NFloat weights = native::row_weights(&params, &about.row, &record);
        for (int k = 0; k < pixels; ++k) {
            const double share = about.distance[k] / 0.5;
            const double expected = std::max(0.0, 1.0 - share * share - about.turned[k] / 0.2);
            EXPECT_NEAR(static_cast<double>(weights[k]), expected, tolerance);
        }
    }
}

TEST(CacheLookup, WeightsAreBoundedAtTheRecordAndEndBehindIt) {
    const native::CacheRecord record = plain_record();
    for (const float error : {0.0F, 0.1F, 1.0F}) {
        const native::RenderParams params = params_with(FEATURE_HEMISPHERES, error);
        native::SurfaceRow row{};
        for (int i = 0; i < pixels; ++i) {
            row.normal_z[i] = 1.0F;
            row.shading_z[i] = 1.0F;
            row.z[i] = -0.05F * static_cast<float>(i);
        }
        const native::NFloat weights = native::row_weights(&params, &row, &record);
        EXPECT_FLOAT_EQ(weights[0], 1023.0F);
        for (int i = 1; i < pixels; ++i) EXPECT_EQ(weights[i], 0.0F) << i;
    }
}

TEST(CacheLookup, PlacesBeyondTheClearanceOfTheirSectorNeedARay) {
    native::CacheRecord record = plain_record();
    std::mt19937 random(2);
    std::uniform_real_distribution<float> uniform(0.0F, 0.3F);
    float* const clear[CACHE_SECTORS] = {
        &record.clear_low.x,  &record.clear_low.y,  &record.clear_low.z,  &record.clear_low.w,
        &record.clear_high.x, &record.clear_high.y, &record.clear_high.z, &record.clear_high.w};
    for (float* const square : clear) *square = uniform(random);
    native::float3 t;
    native::float3 b;
    native::make_basis(native::f3(0.0F, 0.0F, 1.0F), &t, &b);
    const native::RecordSectors sectors = native::sectors_of(&record);
    int beyond = 0;
    int judged = 0;
    for (int i = 0; i < 200; ++i) {
        Pixels about = random_pixels(random);
        // The last stands steeply above: whatever sector it is in, the least clearance counts.
        about.row.z[pixels - 1] = 2.0F * static_cast<float>(about.distance[pixels - 1]);
        const std::uint32_t bits =
            native::node_mask_bits(native::row_beyond_clearance(&about.row, &record, &sectors));
        for (int k = 0; k < pixels; ++k) {
            const auto x = static_cast<double>(about.row.x[k]);
            const auto y = static_cast<double>(about.row.y[k]);
            const auto z = static_cast<double>(about.row.z[k]);
            const double u = x * static_cast<double>(t.x) + y * static_cast<double>(t.y);
            const double v = x * static_cast<double>(b.x) + y * static_cast<double>(b.y);
            double eighths = std::atan2(v, u) * 4.0 / 3.14159265358979323846;
            if (eighths < 0.0) eighths += 8.0;
            const auto sector = static_cast<std::size_t>(eighths) % CACHE_SECTORS;
            double limit = static_cast<double>(*clear[sector]);
            if (k == pixels - 1) limit = static_cast<double>(sectors.least);
            const double square = x * x + y * y + z * z;
            // Within rounding of a limit or of a boundary either is right.
            if (std::abs(square - limit) < 1e-5 || std::abs(eighths - std::round(eighths)) < 1e-4)
                continue;
            EXPECT_EQ((bits >> k & 1U) != 0, square > limit) << u << ' ' << v;
            ++judged;
            beyond += square > limit ? 1 : 0;
        }
    }
    EXPECT_GT(judged, 1000);
    EXPECT_GT(beyond, 200);
    EXPECT_LT(beyond, judged - 200);
}

}  // namespace
}  // namespace weft::cache_lookup_test
