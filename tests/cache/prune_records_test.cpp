// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/prune_records.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "kernels/cache/cache.h"

namespace weft::prune_records_test {
namespace {

constexpr double error = 0.1;

shared::CacheRecord record_at(float x, float y, float z, float radius) {
    shared::CacheRecord record{};
    record.position = {x, y, z, radius};
    record.normal = {0.0F, 1.0F, 0.0F, 0.0F};
    const float clear = std::numeric_limits<float>::max();
    record.clear_low = {clear, clear, clear, clear};
    record.clear_high = {clear, clear, clear, clear};
    return record;
}

/// On a floor and on a wall, of radii over four orders of magnitude, some of them guarded.
std::vector<shared::CacheRecord> random_records(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::vector<shared::CacheRecord> records;
    for (std::size_t i = 0; i < count; ++i) {
        const float u = uniform(random);
        const float v = uniform(random);
        const float radius = 0.2F * std::pow(10.0F, -4.0F * uniform(random) * uniform(random));
        shared::CacheRecord record = record_at(u, 0.0F, v, radius);
        if (i % 4 == 0) {
            record.position = {0.0F, u, v, radius};
            record.normal = {1.0F, 0.0F, 0.0F, 0.0F};
        }
        if (i % 3 == 0) record.clear_high.z = 0.01F * radius * radius;
        records.push_back(record);
    }
    return records;
}

/// Of all records that are kept and at least as large, without any grid.
double weight_of_kept(const std::vector<shared::CacheRecord>& records,
                      const std::vector<std::size_t>& dispensable, std::size_t index) {
    double weight = 0.0;
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (std::binary_search(dispensable.begin(), dispensable.end(), i)) continue;
        const bool before = records[i].position.w > records[index].position.w ||
                            (records[i].position.w == records[index].position.w && i < index);
        if (before) weight += certain_weight(records[i], records[index], error);
    }
    return weight;
}

TEST(PruneRecords, WhatOthersServeIsDispensableAndNothingElse) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        const auto records = random_records(1500, seed);
        const auto dispensable = dispensable_records(records, error, 2.0);
        EXPECT_TRUE(std::is_sorted(dispensable.begin(), dispensable.end()));
        EXPECT_GT(dispensable.size(), 100U);
        EXPECT_LT(dispensable.size(), 1400U);
        // Sums differ in their order by some ulps.
        for (std::size_t i = 0; i < records.size(); ++i) {
            const double weight = weight_of_kept(records, dispensable, i);
            if (std::binary_search(dispensable.begin(), dispensable.end(), i))
                EXPECT_GE(weight, 2.0 * (1.0 - 1e-12)) << i;
            else
                EXPECT_LT(weight, 2.0 * (1.0 + 1e-12)) << i;
        }
    }
}

TEST(PruneRecords, WeightsAreThoseOfTheLookup) {
    const shared::CacheRecord record = record_at(0.0F, 0.0F, 0.0F, 0.5F);
    EXPECT_DOUBLE_EQ(certain_weight(record, record, error), 1.0);
    EXPECT_DOUBLE_EQ(certain_weight(record, record_at(0.25F, 0.0F, 0.0F, 1.0F), error), 0.75);
    EXPECT_EQ(certain_weight(record, record_at(0.5F, 0.0F, 0.0F, 1.0F), error), 0.0);
    shared::CacheRecord turned = record;
    turned.normal = {std::sin(0.2F), std::cos(0.2F), 0.0F, 0.0F};
    EXPECT_NEAR(certain_weight(record, turned, error), 1.0 - (1.0 - std::cos(0.2)) / error, 1e-6);
    // Below its surface by more than the share it may be.
    const float below = -2.0F * BEHIND_SHARE * record.position.w;
    EXPECT_EQ(certain_weight(record, record_at(0.1F, below, 0.0F, 1.0F), error), 0.0);
    // Where something may lie between the two, in whatever direction, nothing is certain.
    shared::CacheRecord guarded = record;
    guarded.clear_low.y = 0.01F;
    EXPECT_EQ(certain_weight(guarded, record_at(0.25F, 0.0F, 0.0F, 1.0F), error), 0.0);
    EXPECT_GT(certain_weight(guarded, record_at(0.05F, 0.0F, 0.0F, 1.0F), error), 0.0);
}

TEST(PruneRecords, TheSmallOnesGoFirst) {
    std::vector<shared::CacheRecord> records;
    for (int i = 0; i < 4; ++i) records.push_back(record_at(0.0F, 0.0F, 0.0F, 0.1F));
    for (int i = 0; i < 2; ++i) records.push_back(record_at(0.0F, 0.0F, 0.0F, 0.4F));
    EXPECT_EQ(dispensable_records(records, error, 2.0), (std::vector<std::size_t>{0, 1, 2, 3}));
    EXPECT_TRUE(dispensable_records({}, error, 2.0).empty());
    // A record without a radius serves nobody, and is nobody's concern.
    records.push_back(record_at(0.0F, 0.0F, 0.0F, 0.0F));
    EXPECT_EQ(dispensable_records(records, error, 2.0).size(), 4U);
}

}  // namespace
}  // namespace weft::prune_records_test
