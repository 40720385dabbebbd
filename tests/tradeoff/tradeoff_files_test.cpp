// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "plan/preset.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"
#include "tradeoff/advice.h"
#include "tradeoff/stale_presets.h"

namespace weft::tradeoff_files_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TradeoffPoint point_of(const std::string& name, double ms, double error, std::uint32_t samples) {
    TradeoffPoint point;
    point.name = name;
    point.family = "ais";
    point.preset.samples = samples;
    point.ms = {ms, ms, ms};
    point.errors.assign(error_measures, {error, error, error});
    point.runs_ms = {ms, ms};
    point.runs_errors.assign(2, std::vector<double>(error_measures, error));
    point.on_front = true;
    return point;
}

/// A run that was asked for these budgets and errors.
TradeoffResult run_of(const std::vector<double>& budgets, const std::vector<double>& errors) {
    TradeoffResult result;
    result.scene = "box.gltf";
    result.width = result.height = 4;
    result.points = {point_of("ais", 10.0, 0.5, 1), point_of("ais spp 4", 40.0, 0.25, 4),
                     point_of("ais spp 16", 160.0, 0.125, 16)};
    for (const double budget : budgets)
        result.advice.push_back(advice_for_budget(result.points, result.measure, budget));
    for (const double error : errors)
        result.advice.push_back(advice_for_error(result.points, result.measure, error));
    return result;
}

class TradeoffFiles : public testing::Test {
  protected:
    void write(const std::vector<double>& budgets, const std::vector<double>& errors = {}) const {
        write_tradeoff(folder_.path(), run_of(budgets, errors));
    }
    /// Names of all files but the three that every run writes.
    [[nodiscard]] std::set<std::string> others() const {
        std::set<std::string> names;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path()))
            names.insert(entry.path().filename().string());
        for (const char* const name : {"index.html", "tradeoff.csv", "tradeoff.json"})
            EXPECT_EQ(names.erase(name), 1U) << name;
        return names;
    }
    [[nodiscard]] fs::path at(const std::string& name) const { return folder_.path() / name; }

    TemporaryFolder folder_;
};

using Names = std::set<std::string>;

TEST_F(TradeoffFiles, PresetsAreThoseOfTheAdvice) {
    write({5.0, 20.0, 2000.0}, {0.25, 0.001});
    // Nothing is as fast as the first and as good as the last.
    EXPECT_EQ(others(), (Names{"preset-20ms.json", "preset-2s.json", "preset-error-0.25.json"}));
    EXPECT_EQ(read_preset(at("preset-2s.json")).samples, 16U);
    EXPECT_EQ(read_preset(at("preset-error-0.25.json")).samples, 4U);
}

TEST_F(TradeoffFiles, AnotherRunRemovesThePresetsThatItDoesNotWrite) {
    write({20.0, 2000.0}, {0.25, 0.5});
    write({20.0, 50.0}, {0.5});
    EXPECT_EQ(others(), (Names{"preset-20ms.json", "preset-50ms.json", "preset-error-0.5.json"}));
    write({5.0});
    EXPECT_EQ(others(), Names{});
}

TEST_F(TradeoffFiles, NothingElseIsRemoved) {
    write({20.0, 50.0, 2000.0, 3000.0}, {0.25});
    const Names mine{"preset-mine.json", "preset-1s.json",  "preset-error-0.125.json",
                     "preset-20ms.txt",  "references.json", "preset-.json"};
    for (const std::string& name : mine) folder_.write(name, R"({"weft_preset": 1})");
    fs::create_directory(at("preset-4s.json"));
    // Changed since, replaced by something else, and gone.
    folder_.write("preset-20ms.json", R"({"weft_preset": 1, "spp": 7})");
    folder_.write("preset-50ms.json", "notes");
    fs::rename(at("preset-2s.json"), at("kept.json"));
    fs::create_symlink("kept.json", at("preset-2s.json"));
    fs::remove(at("preset-3s.json"));
    write({5.0});
    Names left = mine;
    left.insert(
        {"preset-4s.json", "preset-20ms.json", "preset-50ms.json", "preset-2s.json", "kept.json"});
    EXPECT_EQ(others(), left);
}

TEST_F(TradeoffFiles, AReportThatLeadsElsewhereIsNotFollowed) {
    const std::string outside = "outside.json";
    const json settings = preset_json({});
    const auto report = [&](const json& advice) {
        return json{{"weft_tradeoff", 1},
                    {"points", {{{"name", "a"}, {"preset", settings}}}},
                    {"advice", {advice}}}
            .dump();
    };
    fs::create_directory(at("run"));
    folder_.write(outside, settings.dump());
    folder_.write("run/mine.json", settings.dump());
    folder_.write("run/preset-1s.json", settings.dump());
    for (const char* const name :
         {"../outside.json", "mine.json", "preset-1s.json", "", ".", "/etc/passwd"}) {
        folder_.write("run/tradeoff.json",
                      report({{"budget_ms", 100.0}, {"point", "a"}, {"preset", name}}));
        EXPECT_TRUE(written_presets(at("run")).empty()) << name;
        folder_.write("run/tradeoff.json",
                      report({{"error", 0.1}, {"point", "a"}, {"preset", name}}));
        EXPECT_TRUE(written_presets(at("run")).empty()) << name;
    }
    folder_.write("run/tradeoff.json",
                  report({{"budget_ms", 1000.0}, {"point", "a"}, {"preset", "preset-1s.json"}}));
    EXPECT_EQ(written_presets(at("run")).size(), 1U);
}

TEST(TradeoffFilesText, HaveTheUnbiasedErrorAndTheFloor) {
    TradeoffResult result = run_of({20.0}, {});
    result.points[0].unbiased_relmse = ErrorEstimate{0.25, 0.125, 0.375};
    result.points[0].runs_unbiased.assign(2, ErrorEstimate{0.25, 0.1, 0.4});
    result.reference = {.samples = 64,
                        .noise_floor = std::vector<double>(error_measures, 0.25),
                        .noise_relmse = 0.001,
                        .image = {}};
    const json found = tradeoff_json(result);
    const json& point = found["points"][0];
    EXPECT_EQ(point["unbiased_relmse"], (json{{"value", 0.25}, {"low", 0.125}, {"high", 0.375}}));
    EXPECT_EQ(point["runs"][1]["unbiased_relmse"]["high"], 0.4);
    EXPECT_FALSE(point["within_floor"]);
    EXPECT_TRUE(found["points"][1]["within_floor"]);
    EXPECT_TRUE(found["points"][1]["unbiased_relmse"].is_null());
    EXPECT_EQ(found["reference"]["noise_relmse"], 0.001);
    const std::string csv = tradeoff_csv(result);
    EXPECT_NE(csv.find(",unbiased_relmse,unbiased_relmse_low,unbiased_relmse_high\n"),
              std::string::npos);
    EXPECT_NE(csv.find(",0.25,0.125,0.375\n"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",,,\n"), std::string::npos) << csv;
    const std::string text = tradeoff_text(result);
    EXPECT_NE(text.find("0.125 to 0.375"), std::string::npos) << text;
    EXPECT_NE(text.find("64 samples against the other: HDR-FLIP 0.250, HDR-VDP 75 % 0.250 %"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("where comparing says nothing: ais spp 4, ais spp 16."), std::string::npos)
        << text;
    EXPECT_EQ(text.find("too much noise"), std::string::npos) << text;
    result.reference.noise_relmse = 0.02;
    EXPECT_NE(tradeoff_text(result).find("the reference has too much noise for these intervals"),
              std::string::npos);
}

TEST_F(TradeoffFiles, ADamagedReportIsAsIfThereWereNone) {
    EXPECT_TRUE(written_presets(folder_.path()).empty());
    for (const char* const text :
         {"", "{", "[]", "3", "{}", R"({"weft_tradeoff": 2, "advice": []})",
          R"({"weft_tradeoff": 1})", R"({"weft_tradeoff": 1, "advice": [3]})",
          R"({"weft_tradeoff": 1, "advice": [{"preset": 3}]})",
          R"({"weft_tradeoff": 1, "advice": [{"preset": "preset-1s.json"}]})",
          R"({"weft_tradeoff": 1, "advice": [{"preset": "preset-1s.json", "point": "a"}]})",
          R"({"weft_tradeoff": 1, "points": 3,
              "advice": [{"preset": "preset-1s.json", "point": "a", "budget_ms": 1000}]})",
          R"({"weft_tradeoff": 1, "points": [{"name": "a"}],
              "advice": [{"preset": "preset-1s.json", "point": "a", "budget_ms": 1000}]})"}) {
        folder_.write("tradeoff.json", text);
        EXPECT_TRUE(written_presets(folder_.path()).empty()) << text;
    }
    EXPECT_NO_THROW(write({20.0}));
    EXPECT_EQ(others(), Names{"preset-20ms.json"});
}

TEST_F(TradeoffFiles, NothingIsRemovedBeforeAllIsWritten) {
    write({20.0, 2000.0});
    const std::string before = test::text_of_file(at("tradeoff.json"));
    // In the place of a file that a run replaces there is something that it cannot.
    fs::remove(at("index.html"));
    fs::create_directory(at("index.html"));
    EXPECT_THROW(write({20.0}), Error);
    EXPECT_TRUE(fs::exists(at("preset-2s.json")));
    EXPECT_EQ(test::text_of_file(at("tradeoff.json")), before);
    fs::remove(at("index.html"));
    write({20.0});
    EXPECT_EQ(others(), Names{"preset-20ms.json"});
}

}  // namespace
}  // namespace weft::tradeoff_files_test
