// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/tables/column_means.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/common/compact_json.h"

namespace weft::bench::column_means_test {
namespace {

/// Null where the file is not at hand.
nlohmann::json published() {
    const char* const shared = std::getenv("WEFT_SHARED");
    const std::string folder = shared != nullptr ? shared : WEFT_SOURCE_DIR "/../shared";
    std::ifstream in(folder + "/reference/tables.json");
    return in ? nlohmann::json::parse(in) : nlohmann::json();
}

TEST(ColumnMeans, EachIsOverTheRowsThatHaveAFigure) {
    const nlohmann::json rows{{{"a", 1.0}, {"b", 2.0}, {"c", nullptr}},
                              {{"a", 4.0}, {"b", nullptr}},
                              {{"a", 7}, {"b", "none"}, {"c", nullptr}}};
    const nlohmann::json means = column_means(rows);
    EXPECT_EQ(means.size(), 3U);
    EXPECT_DOUBLE_EQ(means.at("a").get<double>(), 4.0);
    EXPECT_DOUBLE_EQ(means.at("b").get<double>(), 2.0);
    EXPECT_TRUE(means.at("c").is_null());
    EXPECT_TRUE(column_means(nlohmann::json::array()).empty());
}

TEST(ColumnMeans, ArePublishedOnesOfPublishedRows) {
    const nlohmann::json tables = published();
    if (tables.is_null()) GTEST_SKIP() << "the published tables are not at hand";
    // They are given with three decimals.
    constexpr double rounding = 0.5001e-3;
    int compared = 0;
    for (const char* const table : {"fps", "speedup", "hdrvdp_percent_of_pixels"}) {
        const nlohmann::json means = column_means(tables.at(table).at("rows"));
        for (const auto& [column, mean] : tables.at(table).at("mean_recomputed").items()) {
            EXPECT_NEAR(means.at(column).get<double>(), mean.get<double>(), rounding) << column;
            ++compared;
        }
    }
    EXPECT_EQ(compared, 20);
}

TEST(ColumnMeans, CommonCellsAreThoseOfBoth) {
    const nlohmann::json ours{{"Desk", {{"ID", 3.0}, {"PM", 5.0}, {"FULL", nullptr}}},
                              {"Attic", {{"ID", 9.0}}}};
    const nlohmann::json theirs{{"Desk", {{"ID", 1.0}, {"PM", nullptr}, {"FULL", 2.0}}},
                                {"Cellar", {{"ID", 8.0}}}};
    EXPECT_EQ(common_cells(ours, theirs), nlohmann::json({{"Desk", {{"ID", 3.0}}}}));
    EXPECT_EQ(common_cells(theirs, ours), nlohmann::json({{"Desk", {{"ID", 1.0}}}}));
    EXPECT_TRUE(common_cells(ours, nullptr).empty());
}

TEST(ColumnMeans, ReportsSayTheSameOnFewerLines) {
    nlohmann::json tables{{"unit", "frames per second"}};
    for (const char* const scene : {"desk", "attic", "cellar"})
        tables["rows"][scene] = {{"ID", 1.25}, {"PM", nullptr}, {"runs", {1, 2.5, 3}}};
    const std::string text = compact_json(tables);
    EXPECT_EQ(nlohmann::json::parse(text), tables);
    const std::string indented = tables.dump(2);
    const auto lines = [](const std::string& of) { return std::count(of.begin(), of.end(), '\n'); };
    EXPECT_LT(lines(text), lines(indented));
    EXPECT_EQ(compact_json({{"empty", nlohmann::json::object()}, {"list", {1, 2}}}),
              R"({"empty":{},"list":[1,2]})");
    const nlohmann::json wide{{"list", std::string(80, 'a')}, {"other", {std::string(20, 'b')}}};
    EXPECT_EQ(compact_json(wide), "{\n  \"list\": \"" + std::string(80, 'a') +
                                      "\",\n  \"other\": [\"" + std::string(20, 'b') + "\"]\n}");
}

}  // namespace
}  // namespace weft::bench::column_means_test
