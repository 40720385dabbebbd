// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "bench/tables/shipped_scenes.h"
#include "bench/tables/tables_report.h"

namespace weft::bench::tables_summary_test {
namespace {

/// A scene with two columns of the table of speed-ups.
nlohmann::json scene(const char* name, const char* set, const nlohmann::json& published,
                     const nlohmann::json& id, const nlohmann::json& pm) {
    nlohmann::json rows;
    rows["speedup"]["ID"] = id;
    rows["speedup"]["PM"] = pm;
    return {{"scene", name}, {"set", set}, {"published", published}, {"rows", rows}};
}

TEST(TablesSummary, HasMeansOfEachSet) {
    const nlohmann::json scenes =
        nlohmann::json::array({scene("desk.gltf", "shipped", "Desk", 2.0, nullptr),
                               scene("office-pm.gltf", "shipped", "OfficePM", 4.0, 3.0),
                               scene("attic.gltf", "shipped", nullptr, 9.0, 5.0),
                               scene("desk", "real", "Desk", 7.0, nullptr)});
    nlohmann::json published;
    published["speedup"]["rows"]["Desk"]["ID"] = 1.5;
    published["speedup"]["rows"]["OfficePM"]["PM"] = 2.5;
    const nlohmann::json summary = tables_summary(scenes, published);
    const nlohmann::json& shipped = summary.at("shipped");
    EXPECT_EQ(shipped.at("scenes"),
              nlohmann::json::array({"desk.gltf", "office-pm.gltf", "attic.gltf"}));
    EXPECT_DOUBLE_EQ(shipped.at("speedup").at("ID").get<double>(), 5.0);
    EXPECT_DOUBLE_EQ(shipped.at("speedup").at("PM").get<double>(), 4.0);
    EXPECT_DOUBLE_EQ(shipped.at("common").at("speedup").at("ID").get<double>(), 2.0);
    EXPECT_DOUBLE_EQ(shipped.at("common").at("speedup").at("PM").get<double>(), 3.0);
    EXPECT_DOUBLE_EQ(shipped.at("published").at("speedup").at("ID").get<double>(), 1.5);
    EXPECT_DOUBLE_EQ(shipped.at("published").at("speedup").at("PM").get<double>(), 2.5);
    EXPECT_DOUBLE_EQ(summary.at("real").at("speedup").at("ID").get<double>(), 7.0);
    EXPECT_TRUE(summary.at("real").at("speedup").at("PM").is_null());
    EXPECT_FALSE(shipped.contains("fps"));
}

TEST(TablesSummary, NeedsNoPublishedTables) {
    const nlohmann::json scenes =
        nlohmann::json::array({scene("desk", "real", "Desk", 7.0, nullptr)});
    const nlohmann::json summary = tables_summary(scenes, nullptr);
    EXPECT_FALSE(summary.contains("shipped"));
    EXPECT_FALSE(summary.at("real").contains("common"));
    EXPECT_DOUBLE_EQ(summary.at("real").at("speedup").at("ID").get<double>(), 7.0);
}

TEST(TablesSummary, EveryPublishedSceneHasOneOfOurs) {
    std::set<std::string> published, files;
    for (const NamedScene& named : shipped_scenes()) {
        published.emplace(named.published);
        files.emplace(named.name);
        EXPECT_EQ(published_scene(named.name), named.published);
    }
    EXPECT_EQ(published.size(), 11U);
    EXPECT_EQ(files.size(), 11U);
    EXPECT_EQ(published_scene("office-fog"), "OfficePM");
    EXPECT_EQ(published_scene("sibenik-fog"), "");
    EXPECT_EQ(published_scene("attic"), "");
}

/// Times of methods within two repetitions, from which every cell of the tables follows.
AdaptiveScene made_up_scene() {
    AdaptiveScene made;
    made.name = "desk.gltf";
    made.shipped = true;
    const auto add = [&](const char* name, double first, double second) {
        MethodFrames method{name, {}, {}};
        for (const double ms : {first, second}) {
            FrameTime time;
            time.wall_ms = ms;
            time.indirect.ms = 0.5 * ms;
            method.runs[0].push_back(time);
        }
        made.frames.methods.push_back(method);
    };
    add(method_ais, 10.0, 30.0);
    add(method_amax, 40.0, 60.0);
    add(method_igi, 50.0, 210.0);
    return made;
}

TEST(TablesSummary, RowsFollowFromTimes) {
    const TableScene measured{made_up_scene(), MovingTimes{{90.0, 60.0}, {30.0, 30.0}, {1.0, 1.0}}};
    const nlohmann::json rows = table_scene_json(measured).at("rows");
    const auto cell = [&](const char* table, const char* column) {
        return rows.at(table).at(column).get<double>();
    };
    // 1000 over the medians 20, 50 and half of 20 ms; of tic, 30 ms.
    EXPECT_DOUBLE_EQ(cell("fps", "FULL_A"), 50.0);
    EXPECT_DOUBLE_EQ(cell("fps", "FULL_AMAX"), 20.0);
    EXPECT_DOUBLE_EQ(cell("fps", "ID_A"), 100.0);
    EXPECT_DOUBLE_EQ(cell("fps", "FULL_TIC"), 33.333);
    EXPECT_TRUE(rows.at("fps").at("SS_A").is_null());
    EXPECT_TRUE(rows.at("fps").at("FULL_IC").is_null());
    // Medians of 4 and 2, of 5 and 7, and of 3 and 2.
    EXPECT_DOUBLE_EQ(cell("speedup", "FULL"), 3.0);
    EXPECT_DOUBLE_EQ(cell("speedup", "FULL_A_vs_IGI"), 6.0);
    EXPECT_DOUBLE_EQ(cell("speedup", "TIC_vs_IC"), 2.5);
    EXPECT_TRUE(rows.at("speedup").at("ID_alone").is_null());
    EXPECT_FALSE(rows.contains("hdrflip"));
}

}  // namespace
}  // namespace weft::bench::tables_summary_test
