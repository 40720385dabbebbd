// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "bench/tables/column_means.h"
#include "bench/tables/tables_report.h"

namespace weft::bench {
namespace {

struct Table {
    const char* key;
    const char* title;
    int decimals;
    std::vector<const char*> columns;
};

/// As they are printed: what is published first.
std::vector<Table> tables() {
    const std::vector<const char*> shares{"A_75",   "A_95",  "AMAX_75", "AMAX_95",  "IGI_75",
                                          "IGI_95", "IC_75", "IC_95",   "floor_75", "floor_95"};
    const std::vector<const char*> each{"A", "AMAX", "IGI", "IC"};
    return {{"fps",
             "frames/s",
             2,
             {"ID_A", "ID_AMAX", "SS_A", "SS_AMAX", "PM_A", "PM_AMAX", "FULL_A", "FULL_AMAX",
              "FULL_IGI", "FULL_IC", "FULL_TIC"}},
            {"speedup",
             "times as fast",
             2,
             {"ID", "SS", "PM", "FULL", "FULL_A_vs_IGI", "FULL_A_vs_IC", "TIC_vs_IC"}},
            {"hdrvdp_percent_of_pixels", "HDR-VDP, %", 2, shares},
            {"hdrvdp_display", "on a display, %", 2, shares},
            {"hdrflip", "HDR-FLIP", 4, {"A", "AMAX", "IGI", "IC", "floor"}},
            {"relmse", "relMSE", 4, {"A", "AMAX", "IGI", "IC", "noise"}},
            {"unbiased_relmse", "unbiased relMSE", 4, each},
            {"unbiased_relmse_low", "  95 %, from", 4, each},
            {"unbiased_relmse_high", "  95 %, to", 4, each}};
}

const nlohmann::json* find(const nlohmann::json& object, const std::string& key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found != object.end() ? &*found : nullptr;
}

/// The published rows of a table, or null.
nlohmann::json published_rows(const nlohmann::json& published, const char* table) {
    const nlohmann::json* const found = find(published, table);
    const nlohmann::json* const rows = found != nullptr ? find(*found, "rows") : nullptr;
    return rows != nullptr ? *rows : nlohmann::json();
}

std::string cells(const Table& table, const nlohmann::json& row) {
    std::string line;
    for (const char* const column : table.columns) {
        const nlohmann::json* const value = find(row, column);
        line += value != nullptr && value->is_number()
                    ? fmt::format(" {:>13.{}f}", value->get<double>(), table.decimals)
                    : fmt::format(" {:>13}", "-");
    }
    return line + "\n";
}

/// A table of one row, and what is published below it where there is anything.
std::string lines(const Table& table, const nlohmann::json& row, const nlohmann::json& published) {
    std::string text = fmt::format("  {:16}", table.title);
    for (const char* const column : table.columns) text += fmt::format(" {:>13}", column);
    text += fmt::format("\n  {:16}", "") + cells(table, row);
    if (published.is_object())
        text += fmt::format("  {:16}", "published") + cells(table, published);
    return text;
}

/// The rows of a table by their published names, which no two scenes of a set share; rows without
/// one are left out.
nlohmann::json named_rows(const std::vector<const nlohmann::json*>& scenes, const char* table) {
    nlohmann::json rows = nlohmann::json::object();
    for (const nlohmann::json* const scene : scenes)
        if (scene->at("published").is_string() && find(scene->at("rows"), table) != nullptr)
            rows[scene->at("published").get<std::string>()] = scene->at("rows").at(table);
    return rows;
}

nlohmann::json set_summary(const std::vector<const nlohmann::json*>& scenes,
                           const nlohmann::json& published) {
    nlohmann::json summary{{"scenes", nlohmann::json::array()}};
    for (const nlohmann::json* const scene : scenes)
        summary["scenes"].push_back(scene->at("scene"));
    for (const Table& table : tables()) {
        nlohmann::json rows = nlohmann::json::array();
        for (const nlohmann::json* const scene : scenes)
            if (const nlohmann::json* const row = find(scene->at("rows"), table.key))
                rows.push_back(*row);
        if (rows.empty()) continue;
        summary[table.key] = column_means(rows);
        const nlohmann::json own = named_rows(scenes, table.key);
        const nlohmann::json theirs = published_rows(published, table.key);
        const nlohmann::json common = common_cells(own, theirs);
        if (common.empty()) continue;
        summary["common"][table.key] = column_means(common);
        summary["published"][table.key] = column_means(common_cells(theirs, own));
    }
    return summary;
}

}  // namespace

std::string tables_legend() {
    return "A: ais, AMAX: amax, IGI: igi, IC: ic; TIC: tic in frames in which a box moves.\n"
           "ID, SS, PM: the stages of indirect and of direct light and of light that media\n"
           "scatter, on the device; FULL: wall time of whole frames. Frames per second are those\n"
           "of median times, and speed-ups are medians of the ratios within repetitions, over\n"
           "amax unless another is named. Errors are those of whole frames against references\n"
           "with a box filter: HDR-VDP, percent of the pixels seen to differ with a probability\n"
           "of 75 and 95 percent, at 1 cd/m2 of value 1 and on a display at 100; HDR-FLIP;\n"
           "relMSE, and relMSE without the noise of the reference, with its interval. floor: one\n"
           "half of the reference's samples against the other; errors as small as that say\n"
           "nothing. noise: what the noise of all samples adds to relMSE; above 0.005 intervals\n"
           "are too narrow.\n";
}

std::string table_scene_text(const nlohmann::json& scene, const nlohmann::json& published) {
    std::string text =
        fmt::format("\n{}, {}: {} triangles\n", scene.at("scene").get<std::string>(),
                    scene.at("set").get<std::string>(), scene.at("triangles").get<std::size_t>());
    for (const Table& table : tables()) {
        const nlohmann::json* const row = find(scene.at("rows"), table.key);
        if (row == nullptr) continue;
        nlohmann::json theirs;
        if (scene.at("published").is_string())
            if (const nlohmann::json all = published_rows(published, table.key);
                const auto* const found = find(all, scene.at("published").get<std::string>()))
                theirs = *found;
        text += lines(table, *row, theirs);
    }
    return text;
}

nlohmann::json tables_summary(const nlohmann::json& scenes, const nlohmann::json& published) {
    nlohmann::json summary = nlohmann::json::object();
    for (const char* const set : {"shipped", "real"}) {
        std::vector<const nlohmann::json*> of_set;
        for (const nlohmann::json& scene : scenes)
            if (scene.at("set") == set) of_set.push_back(&scene);
        if (!of_set.empty()) summary[set] = set_summary(of_set, published);
    }
    return summary;
}

std::string tables_summary_text(const nlohmann::json& summary, const nlohmann::json& published) {
    std::string text;
    for (const auto& [set, means] : summary.items()) {
        text += fmt::format("\nmeans of {} scenes, {}\n", means.at("scenes").size(), set);
        for (const Table& table : tables()) {
            const nlohmann::json* const row = find(means, table.key);
            if (row == nullptr) continue;
            const nlohmann::json theirs = published_rows(published, table.key);
            text += lines(table, *row, theirs.is_object() ? column_means(theirs) : theirs);
        }
    }
    return text;
}

}  // namespace weft::bench
