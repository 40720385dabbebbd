// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/measure_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tradeoff/reference_images.h"

namespace weft::measure_points_test {
namespace {

/// Candidates told apart by their samples, which say how long a frame takes.
std::vector<Candidate> some_candidates() {
    const auto candidate = [](const std::string& name, const std::string& family,
                              std::uint32_t samples) {
        return Candidate{name, family, {Algorithm::ais, {}, samples}};
    };
    return {candidate("b", "b", 20), candidate("a", "a", 10), candidate("c", "c", 1000),
            candidate("d", "c", 15)};
}

/// A machine on which a frame takes `frame_ms`, and an error is as large as one over the samples.
struct MadeUp {
    double frame_ms = 1.0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> made;  ///< samples and seed, whole ones
    std::uint32_t first_frames = 0;

    Measuring measuring() {
        return {.make =
                    [this](const Preset& preset, std::uint32_t seed, bool first_alone) {
                        MeasuredImage image;
                        image.frames = first_alone ? 1 : preset.samples;
                        image.ms = frame_ms * image.frames;
                        image.rays = preset.samples;
                        image.image.width = preset.samples;
                        if (first_alone)
                            ++first_frames;
                        else
                            made.emplace_back(preset.samples, seed);
                        return image;
                    },
                .judge =
                    [](const Image& image) {
                        return std::vector<double>(error_measures, 1.0 / image.width);
                    },
                .report =
                    [](double done, const std::string&) {
                        EXPECT_GE(done, 0.0);
                        EXPECT_LE(done, 1.0 + 1e-9);
                    }};
    }
};

TEST(MeasurePoints, VisitsEveryCandidateOnceInARound) {
    MadeUp machine;
    std::vector<std::string> skipped;
    const MeasurePlan plan{.repetitions = 3, .seed = 5, .slow_ms = 500.0};
    const auto points = measure_points(some_candidates(), plan, machine.measuring(), skipped);
    EXPECT_EQ(skipped, std::vector<std::string>{"c"});
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[0].name, "a");
    EXPECT_EQ(points[1].name, "d");
    EXPECT_EQ(points[2].name, "b");
    const std::vector<std::pair<std::uint32_t, std::uint32_t>> order{
        {20, 5}, {10, 5}, {15, 5}, {20, 6}, {10, 6}, {15, 6}, {20, 7}, {10, 7}, {15, 7}};
    EXPECT_EQ(machine.made, order);
    EXPECT_DOUBLE_EQ(points[0].ms.median, 10.0);
    EXPECT_EQ(points[0].runs_ms.size(), 3U);
    EXPECT_EQ(points[0].runs_errors.size(), 3U);
    ASSERT_EQ(points[0].errors.size(), error_measures);
    EXPECT_DOUBLE_EQ(points[0].errors[0].median, 0.1);
    EXPECT_EQ(points[0].rays, 10U);
}

TEST(MeasurePoints, UnbiasedErrorsAreMeansOverTheImages) {
    MadeUp machine;
    Measuring measuring = machine.measuring();
    std::vector<std::string> skipped;
    const MeasurePlan plan{.repetitions = 2, .seed = 5, .slow_ms = 500.0};
    for (const TradeoffPoint& point : measure_points(some_candidates(), plan, measuring, skipped)) {
        EXPECT_FALSE(point.unbiased_relmse.has_value()) << "without halves";
        EXPECT_TRUE(point.runs_unbiased.empty());
    }
    int asked = 0;
    measuring.unbiased = [&](const Image& image) {
        const double value = image.width + (asked++ < 3 ? 0.0 : 1.0);  // three settings a round
        return std::optional(ErrorEstimate{value, value - 2.0, value + 3.0});
    };
    const auto points = measure_points(some_candidates(), plan, measuring, skipped);
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(asked, 6);
    ASSERT_EQ(points[0].runs_unbiased.size(), 2U);
    EXPECT_EQ(points[0].runs_unbiased[1].value, 11.0);
    EXPECT_EQ(points[0].unbiased_relmse.value().value, 10.5);
    EXPECT_EQ(points[0].unbiased_relmse->low, 8.5);
    EXPECT_EQ(points[0].unbiased_relmse->high, 13.5);
}

TEST(MeasurePoints, TimesOfAllSettingsSayHowFarThoseOfOneMayLie) {
    MadeUp machine;
    Measuring measuring = machine.measuring();
    measuring.make = [make = measuring.make](const Preset& preset, std::uint32_t seed,
                                             bool first_alone) {
        MeasuredImage image = make(preset, seed, first_alone);
        // One setting takes as long with every seed, as chance may have it.
        if (!first_alone && preset.samples != 10) image.ms *= seed % 2 == 0 ? 1.0 : 1.25;
        return image;
    };
    std::vector<std::string> skipped;
    const MeasurePlan plan{.repetitions = 4, .seed = 0, .slow_ms = 500.0};
    const auto points = measure_points(some_candidates(), plan, measuring, skipped);
    ASSERT_EQ(points.size(), 3U);
    EXPECT_EQ(points[0].name, "a");
    EXPECT_DOUBLE_EQ(points[0].ms.median, 10.0);
    EXPECT_LT(points[0].ms.low, 10.0 / 1.25);
    EXPECT_GT(points[0].ms.high, 10.0 * 1.25);
    for (const TradeoffPoint& point : points)
        EXPECT_NEAR(point.ms.high / point.ms.median, points[0].ms.high / 10.0, 1e-12);
}

TEST(MeasurePoints, AFamilyOfSlowFramesIsNotTriedFurther) {
    MadeUp machine;
    machine.frame_ms = 1000.0;
    std::vector<std::string> skipped;
    const MeasurePlan plan{.repetitions = 2, .seed = 0, .slow_ms = 500.0};
    EXPECT_TRUE(measure_points(some_candidates(), plan, machine.measuring(), skipped).empty());
    EXPECT_EQ(skipped.size(), 4U);
    // Twice each, as the first frame may compile; "d" not at all.
    EXPECT_EQ(machine.first_frames, 6U);
    EXPECT_TRUE(machine.made.empty());
}

TEST(MeasurePoints, BudgetsAreFilledByFramesThatAreNotTheFirst) {
    MadeUp machine;
    Measuring measuring = machine.measuring();
    measuring.make = [make = measuring.make](const Preset& preset, std::uint32_t seed,
                                             bool first_alone) {
        MeasuredImage image = make(preset, seed, first_alone);
        image.ms *= first_alone ? 2.5 : 1.0;  // the first of a process takes longer
        return image;
    };
    std::vector<Candidate> candidates;
    for (const char* const family : {"a", "b"})
        candidates.push_back({family, family, {Algorithm::ais, {}, 1}, "", family[0] == 'a'});
    std::vector<std::string> skipped;
    const std::vector<double> budgets{20.0, 100.0, 2000.0};
    const MeasurePlan plan{.repetitions = 2, .slow_ms = 1000.0, .wish = {budgets, 10000}};
    const auto points = measure_points(candidates, plan, measuring, skipped);
    std::set<std::string> names;
    for (const TradeoffPoint& point : points) names.insert(point.name);
    // Half of two seconds would be too slow, and what does not fill budgets is measured alone.
    EXPECT_EQ(names,
              (std::set<std::string>{"a", "b", "a spp 11", "a spp 16", "a spp 55", "a spp 82"}));
    EXPECT_TRUE(skipped.empty());
    for (const TradeoffPoint& point : points) EXPECT_EQ(point.runs_ms.size(), 2U);
}

TEST(MeasurePoints, TheFrontIsThatOfTheChosenError) {
    std::vector<TradeoffPoint> points(3);
    const double times[] = {1.0, 2.0, 3.0};
    const double errors[] = {0.5, 0.7, 0.1};
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].ms.median = times[i];
        points[i].errors.assign(error_measures, {1.0, 1.0, 1.0});
        points[i].errors[static_cast<std::size_t>(ErrorMeasure::bias)].median = errors[i];
    }
    mark_front(points, ErrorMeasure::bias);
    EXPECT_TRUE(points[0].on_front);
    EXPECT_FALSE(points[1].on_front);
    EXPECT_TRUE(points[2].on_front);
    mark_front(points, ErrorMeasure::hdrflip);
    EXPECT_TRUE(points[0].on_front);
    EXPECT_FALSE(points[2].on_front);
}

TEST(MeasurePoints, TheCheckUsesNewSeedsAndCounts) {
    MadeUp machine;
    std::vector<std::string> skipped;
    const MeasurePlan plan{.repetitions = 3, .seed = 5, .slow_ms = 500.0};
    auto points = measure_points(some_candidates(), plan, machine.measuring(), skipped);
    mark_front(points, ErrorMeasure::hdrflip);
    machine.made.clear();
    // Intervals of equal measurements hold just these: one is opened, the others left.
    points[0].ms.low = 0.0;
    points[0].ms.high = 100.0;
    for (Interval& error : points[0].errors) error.high = 1.0;
    machine.frame_ms = 1.25;
    const FrontCheck check =
        check_front(points, ErrorMeasure::hdrflip, plan, machine.measuring(), 2);
    EXPECT_EQ(check.images, 6U);
    EXPECT_EQ(check.times_within, 2U);
    EXPECT_EQ(check.errors_within, 6U);
    ASSERT_EQ(check.points.size(), 3U);
    EXPECT_EQ(check.points[0].ms, (std::vector<double>{12.5, 12.5}));
    for (const auto& [samples, seed] : machine.made) EXPECT_TRUE(seed == 8 || seed == 9);
}

TEST(MeasurePoints, SeedsDifferAndAreNeverTheReferences) {
    for (const std::uint32_t left_out : reference_seeds)
        for (const std::uint32_t first :
             {0U, left_out - 150, left_out - 1, left_out, left_out + 1, 0xFFFFFFF0U}) {
            std::set<std::uint32_t> seeds;
            for (std::uint32_t index = 0; index < 200; ++index) {
                const std::uint32_t seed = image_seed(first, index);
                for (const std::uint32_t never : reference_seeds) EXPECT_NE(seed, never);
                EXPECT_TRUE(seeds.insert(seed).second) << first << " " << index;
            }
            if (first != left_out) {
                EXPECT_EQ(image_seed(first, 0), first);
            }
        }
}

TEST(MeasurePoints, EndsWhereTheReportThrows) {
    MadeUp machine;
    Measuring measuring = machine.measuring();
    measuring.report = [&](double, const std::string&) {
        if (machine.made.size() == 4) throw std::runtime_error("enough");
    };
    std::vector<std::string> skipped;
    EXPECT_THROW((void)measure_points(some_candidates(), {}, measuring, skipped),
                 std::runtime_error);
    EXPECT_EQ(machine.made.size(), 4U);
}

}  // namespace
}  // namespace weft::measure_points_test
