// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/record_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "kernels/cache/cache.h"
#include "tests/testing/image_masks.h"

namespace weft::record_store_test {
namespace {

std::vector<shared::CacheRecord> random_records(std::size_t count) {
    test::RandomBits random(static_cast<std::uint32_t>(count) + 5);
    std::vector<shared::CacheRecord> records(count);
    for (shared::CacheRecord& record : records)
        record.position = {random.unit() - 0.5F, 4.0F * random.unit(), -random.unit(),
                           0.2F * random.unit()};
    return records;
}

bool holds(const shared::float4* box, const shared::float4& p) {
    return box[0].x <= p.x - p.w && box[0].y <= p.y - p.w && box[0].z <= p.z - p.w &&
           box[1].x >= p.x + p.w && box[1].y >= p.y + p.w && box[1].z >= p.z + p.w;
}

TEST(RecordStore, BoxesHoldWhatTheRecordsOfTheirGroupsServe) {
    for (const std::size_t count : {0UL, 1UL, 15UL, 16UL, 17UL, 256UL, 257UL, 5000UL}) {
        const std::vector<shared::CacheRecord> records = random_records(count);
        const std::vector<shared::float4> boxes = record_boxes(records);
        const std::size_t groups = (count + CACHE_GROUP - 1) / CACHE_GROUP;
        const std::size_t supers = (groups + CACHE_GROUP - 1) / CACHE_GROUP;
        ASSERT_EQ(boxes.size(), 2 * (groups + supers));
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_TRUE(holds(&boxes[2 * (supers + i / CACHE_GROUP)], records[i].position));
            EXPECT_TRUE(holds(&boxes[2 * (i / CACHE_GROUP / CACHE_GROUP)], records[i].position));
        }
        // No larger than they must be, but for rounding.
        for (std::size_t group = 0; group < groups; ++group) {
            float least = 1e9F;
            for (std::size_t i = group * CACHE_GROUP;
                 i < std::min(count, (group + 1) * CACHE_GROUP); ++i)
                least = std::min(least, records[i].position.x - records[i].position.w);
            EXPECT_NEAR(boxes[2 * (supers + group)].x, least, 1e-4F);
        }
    }
}

}  // namespace
}  // namespace weft::record_store_test
