// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/references/references_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace weft::bench {
namespace {

constexpr double first_turn = 5.0;  // minutes
constexpr std::uint32_t most_doublings = 20;

nlohmann::json or_null(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json();
}

std::string figure(const std::optional<double>& value, int width, int decimals) {
    return value && std::isfinite(*value) ? fmt::format("{:{}.{}f}", *value, width, decimals)
                                          : fmt::format("{:>{}}", "-", width);
}

std::string small_figure(const std::optional<double>& value, int width) {
    return value && std::isfinite(*value) ? fmt::format("{:{}.2e}", *value, width)
                                          : fmt::format("{:>{}}", "-", width);
}

std::string table_line(const ReferenceRow& row) {
    const auto part = [&](double ReferenceFloor::*of) {
        return row.floor ? std::optional((*row.floor).*of) : std::nullopt;
    };
    std::string line = fmt::format("{:>20} {:>6} {:>9} {:>8} {:>9.0f}", row.scene, row.filter,
                                   row.algorithm, row.samples, row.seconds) +
                       figure(part(&ReferenceFloor::published), 13, 3) +
                       figure(part(&ReferenceFloor::display), 11, 3) + figure(row.hdrflip, 10, 4) +
                       small_figure(row.noise_relmse, 11) + (row.reached ? "  yes" : "  no");
    if (!row.failure.empty()) line += ": " + row.failure;
    return line + "\n";
}

}  // namespace

nlohmann::json row_json(const ReferenceRow& row) {
    nlohmann::json json{{"scene", row.scene},
                        {"filter", row.filter},
                        {"algorithm", row.algorithm},
                        {"file", row.file},
                        {"samples", row.samples},
                        {"seconds", row.seconds},
                        {"minutes_of_run", row.minutes},
                        {"floor_published", nullptr},
                        {"floor_display", nullptr},
                        {"floor_hdrflip", or_null(row.hdrflip)},
                        {"floor_relmse", or_null(row.relmse)},
                        {"noise_relmse", or_null(row.noise_relmse)},
                        {"reached", row.reached}};
    if (row.floor) {
        json["floor_published"] = row.floor->published;
        json["floor_display"] = row.floor->display;
    }
    if (!row.failure.empty()) json["failure"] = row.failure;
    return json;
}

nlohmann::json references_summary(const std::vector<ReferenceRow>& rows) {
    std::size_t reached = 0;
    double seconds = 0.0;
    ReferenceFloor worst;
    for (const ReferenceRow& row : rows) {
        if (row.reached) ++reached;
        seconds += row.seconds;
        if (!row.floor) continue;
        worst.published = std::max(worst.published, row.floor->published);
        worst.display = std::max(worst.display, row.floor->display);
    }
    return {{"references", rows.size()},
            {"reached", reached},
            {"all_reached", reached == rows.size()},
            {"floor_published_max", worst.published},
            {"floor_display_max", worst.display},
            {"seconds", seconds}};
}

std::string references_table(const std::vector<ReferenceRow>& rows, const ReferenceFloor& goal) {
    std::string text = fmt::format(
        "\n{:>20} {:>6} {:>9} {:>8} {:>9}{:>13}{:>11}{:>10}{:>11}  reached\n", "scene", "filter",
        "by", "samples", "seconds", "published %", "display %", "HDR-FLIP", "noise");
    std::size_t reached = 0;
    for (const ReferenceRow& row : rows) {
        text += table_line(row);
        if (row.reached) ++reached;
    }
    return text + fmt::format(
                      "{} of {} reached: the halves differ at no more than {} % of the "
                      "pixels (published) and {} % (display)\n",
                      reached, rows.size(), goal.published, goal.display);
}

double turn_minutes(std::uint32_t turn, double used, double limit) {
    const double wanted = std::ldexp(first_turn, static_cast<int>(std::min(turn, most_doublings)));
    return std::clamp(limit - used, 0.0, wanted);
}

}  // namespace weft::bench
