// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/sample_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft::sample_parts_test {
namespace {

TEST(SampleParts, TogetherAreTheWholeAndDifferByOneAtMost) {
    for (const std::uint32_t count : {1U, 7U, 64U, 1000U, 16777216U}) {
        for (const std::uint32_t parts : {1U, 2U, 3U, 16U, 1000U}) {
            const SampleRange whole{5, 5 + count};
            std::uint32_t next = whole.first;
            std::uint32_t least = count;
            std::uint32_t most = 0;
            for (std::uint32_t part = 1; part <= parts; ++part) {
                const SampleRange range = part_of(whole, part, parts);
                ASSERT_EQ(range.first, next) << count << " in " << parts;
                next = range.end;
                least = std::min(least, range.end - range.first);
                most = std::max(most, range.end - range.first);
            }
            EXPECT_EQ(next, whole.end);
            EXPECT_LE(most - least, 1U);
        }
    }
}

TEST(SampleParts, MissingIsAllThatNoRangeHas) {
    const std::vector<SampleRange> none;
    const SampleRange whole{10, 20};
    EXPECT_EQ(missing_of(none, whole), (std::vector<SampleRange>{{10, 20}}));
    EXPECT_EQ(missing_of({{10, 20}}, whole), none);
    EXPECT_EQ(missing_of({{0, 30}}, whole), none);
    EXPECT_EQ(missing_of({{0, 5}, {25, 30}}, whole), (std::vector<SampleRange>{{10, 20}}));
    EXPECT_EQ(missing_of({{0, 12}, {14, 15}, {18, 40}}, whole),
              (std::vector<SampleRange>{{12, 14}, {15, 18}}));
}

TEST(SampleParts, PartsAreMissingWhereAnySampleIs) {
    const SampleRange whole{0, 16};
    const std::vector<std::uint32_t> none;
    EXPECT_EQ(missing_parts({{0, 16}}, whole, 4), none);
    EXPECT_EQ(missing_parts({}, whole, 4), (std::vector<std::uint32_t>{1, 2, 3, 4}));
    EXPECT_EQ(missing_parts({{0, 7}, {8, 16}}, whole, 4), (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(missing_parts({{4, 8}, {12, 16}}, whole, 4), (std::vector<std::uint32_t>{1, 3}));
}

TEST(SampleParts, NumbersAreWrittenAsJobArraysTakeThem) {
    EXPECT_EQ(numbers_text({}), "");
    EXPECT_EQ(numbers_text({3}), "3");
    EXPECT_EQ(numbers_text({1, 2}), "1,2");
    EXPECT_EQ(numbers_text({1, 3, 4, 5, 9}), "1,3-5,9");
}

}  // namespace
}  // namespace weft::sample_parts_test
