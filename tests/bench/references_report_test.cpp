// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/references/references_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace weft::bench::references_report_test {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

std::vector<ReferenceRow> two_rows() {
    ReferenceRow good{.scene = "desk.gltf", .filter = "box", .algorithm = "reference"};
    good.file = "desk-512x512-box-512-vpl-0123456789abcdef.exr";
    good.samples = 512;
    good.seconds = 100.0;
    good.floor = ReferenceFloor{0.02, 0.5};
    good.hdrflip = 0.03;
    good.noise_relmse = 1e-4;
    good.reached = true;
    ReferenceRow slow{.scene = "smoke.gltf", .filter = "box", .algorithm = "path"};
    slow.samples = 64;
    slow.seconds = 50.0;
    slow.floor = ReferenceFloor{0.01, 7.25};
    return {good, slow};
}

TEST(ReferencesReport, SummaryCountsWhatReachedTheGoal) {
    std::vector<ReferenceRow> rows = two_rows();
    nlohmann::json summary = references_summary(rows);
    EXPECT_EQ(summary["references"], 2);
    EXPECT_EQ(summary["reached"], 1);
    EXPECT_EQ(summary["all_reached"], false);
    EXPECT_EQ(summary["floor_published_max"], 0.02);
    EXPECT_EQ(summary["floor_display_max"], 7.25);
    EXPECT_EQ(summary["seconds"], 150.0);
    rows[1].reached = true;
    EXPECT_EQ(references_summary(rows)["all_reached"], true);
    EXPECT_EQ(references_summary({})["references"], 0);
}

TEST(ReferencesReport, TableSaysWhatWasReachedAndWhatWentWrong) {
    std::vector<ReferenceRow> rows = two_rows();
    rows.push_back({.scene = "gone.gltf", .filter = "box", .algorithm = "reference"});
    rows.back().failure = "gone.gltf: cannot be opened";
    const std::string table = references_table(rows, good_floor);
    EXPECT_NE(table.find("desk.gltf"), std::string::npos);
    EXPECT_NE(table.find("  yes\n"), std::string::npos);
    EXPECT_NE(table.find("7.250"), std::string::npos);
    EXPECT_NE(table.find("  no: gone.gltf: cannot be opened\n"), std::string::npos);
    EXPECT_NE(table.find("1 of 3 reached: "), std::string::npos);
    // Headings stand above their columns.
    std::size_t width = std::string::npos;
    for (std::size_t begin = 1, line = 0; line < 4; ++line) {
        const std::size_t end = table.find('\n', begin);
        const std::string text = table.substr(begin, end - begin);
        const std::size_t last = line == 0   ? text.rfind("  reached")
                                 : line == 1 ? text.rfind("  yes")
                                             : text.find("  no");
        if (line == 0) width = last;
        EXPECT_EQ(last, width) << text;
        begin = end + 1;
    }
}

TEST(ReferencesReport, JsonHasNullForWhatIsNotKnown) {
    const std::vector<ReferenceRow> rows = two_rows();
    const nlohmann::json good = row_json(rows[0]);
    EXPECT_EQ(good["floor_published"], 0.02);
    EXPECT_EQ(good["floor_display"], 0.5);
    EXPECT_EQ(good["samples"], 512);
    EXPECT_EQ(good["reached"], true);
    EXPECT_FALSE(good.contains("failure"));
    const nlohmann::json nothing = row_json({.scene = "a", .filter = "box", .algorithm = "path"});
    for (const char* const key :
         {"floor_published", "floor_display", "floor_hdrflip", "floor_relmse", "noise_relmse"})
        EXPECT_TRUE(nothing[key].is_null()) << key;
}

TEST(ReferencesReport, TurnsDoubleWithinTheLimit) {
    EXPECT_GT(turn_minutes(0, 0.0, no_limit), 0.0);
    for (std::uint32_t turn = 1; turn < 10; ++turn)
        EXPECT_EQ(turn_minutes(turn, 5.0, no_limit), 2.0 * turn_minutes(turn - 1, 5.0, no_limit));
    EXPECT_LT(turn_minutes(1000000, 0.0, no_limit), no_limit);
    EXPECT_EQ(turn_minutes(9, 7.0, 10.0), 3.0);
    EXPECT_EQ(turn_minutes(9, 11.0, 10.0), 0.0);
    // However the turns are cut, their sum is the limit.
    double used = 0.0;
    for (std::uint32_t turn = 0; turn < 20; ++turn) used += turn_minutes(turn, used, 45.0);
    EXPECT_EQ(used, 45.0);
}

TEST(ReferencesReport, OnlyWhatIsNotThereGetsMoreTime) {
    const std::vector<ReferenceRow> rows = two_rows();
    EXPECT_FALSE(rows[0].wants_more());
    EXPECT_TRUE(rows[1].wants_more());
    ReferenceRow failed = rows[1];
    failed.failure = "is missing";
    EXPECT_FALSE(failed.wants_more());
}

}  // namespace
}  // namespace weft::bench::references_report_test
