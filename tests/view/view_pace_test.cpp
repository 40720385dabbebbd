// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_pace.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft::view_pace_test {
namespace {

/// The sizes of images, each of which takes `fixed_ms` and so many milliseconds a megapixel, and
/// the time of the last.
double settle(ViewPace& pace, double fixed_ms, double ms_per_megapixel, int images = 60) {
    double ms = 0.0;
    for (int i = 0; i < images; ++i) {
        const FilmSize size = pace.size();
        ms = fixed_ms + ms_per_megapixel * 1e-6 * size.width * size.height;
        pace.took(ms);
    }
    return ms;
}

TEST(ViewPace, FindsASizeThatIsQuickEnough) {
    for (const double cost : {10.0, 100.0, 400.0, 1000.0, 4000.0, 20000.0}) {
        ViewPace pace;
        pace.set_full({512, 512});
        const double ms = settle(pace, 3.0, cost);
        const FilmSize size = pace.size();
        // The slowest has no size that is quick enough, and stays at the least.
        EXPECT_EQ(ms <= ViewPace::most_ms, cost < 5000.0) << cost << ": " << ms;
        EXPECT_TRUE(ms <= ViewPace::most_ms || size.width == 128U) << cost << ": " << ms;
        EXPECT_GE(std::max(size.width, size.height), 128U) << cost;
        EXPECT_EQ(size.width == 512U, cost <= 200.0) << cost;
    }
}

TEST(ViewPace, SettlesOnOneSize) {
    for (const double cost : {50.0, 200.0, 300.0, 700.0, 1500.0}) {
        ViewPace pace;
        pace.set_full({1280, 720});
        (void)settle(pace, 5.0, cost);
        const FilmSize first = pace.size();
        for (int i = 0; i < 40; ++i) {
            (void)settle(pace, 5.0, cost, 1);
            EXPECT_EQ(pace.size().width, first.width) << cost;
        }
    }
}

TEST(ViewPace, GuessesItsFirstSizeByAnImageOfTheFullOne) {
    for (const double ms : {40.0, 200.0, 1200.0, 1e9}) {
        ViewPace pace;
        pace.set_full({512, 512});
        pace.took_full(ms);
        const FilmSize size = pace.size();
        const double share = size.width * size.height / (512.0 * 512.0);
        EXPECT_TRUE(share * ms <= ViewPace::aim_ms || size.width == 128U) << ms;
        EXPECT_EQ(size.width == 512U, ms <= ViewPace::aim_ms) << ms;
        // What was measured of small images counts for more.
        (void)settle(pace, 2.0, 50.0);
        pace.took_full(1e6);
        EXPECT_EQ(pace.size().width, 512U);
    }
}

TEST(ViewPace, KeepsItsSizeWhereTheFullOneChanges) {
    ViewPace pace;
    pace.set_full({512, 512});
    (void)settle(pace, 2.0, 2000.0);
    const std::uint32_t before = pace.size().width;
    EXPECT_LE(before, 256U);
    for (const std::uint32_t edge : {1024U, 256U, 512U}) {
        pace.set_full({edge, edge});
        EXPECT_LE(pace.size().width, before) << edge;
        EXPECT_GE(pace.size().width, 128U) << edge;
    }
}

TEST(ViewPace, GrowsAgainWhereThereIsTime) {
    ViewPace pace;
    pace.set_full({512, 512});
    (void)settle(pace, 2.0, 3000.0);
    const FilmSize small = pace.size();
    // One quick image is not enough.
    pace.took(1.0);
    EXPECT_EQ(pace.size().width, small.width);
    (void)settle(pace, 2.0, 50.0);
    EXPECT_EQ(pace.size().width, 512U);
}

TEST(ViewPace, NeverGoesBelow128PixelsUnlessTheImageIsSmaller) {
    for (const FilmSize full : {FilmSize{512, 512}, FilmSize{1920, 1080}, FilmSize{300, 900},
                                FilmSize{200, 100}, FilmSize{64, 48}, FilmSize{1, 1}}) {
        ViewPace pace;
        pace.set_full(full);
        for (int i = 0; i < 10; ++i) pace.took(10000.0);
        const FilmSize size = pace.size();
        EXPECT_GE(std::max(size.width, size.height),
                  std::min(128U, std::max(full.width, full.height)));
        EXPECT_GE(size.width, 1U);
        EXPECT_GE(size.height, 1U);
    }
}

}  // namespace
}  // namespace weft::view_pace_test
