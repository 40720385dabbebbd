// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "tradeoff/image_errors.h"
#include "tradeoff/noise_floor.h"
#include "tradeoff/page_values.h"
#include "tradeoff/stale_presets.h"
#include "tradeoff/tradeoff_page.h"

namespace weft {
namespace {

using Json = nlohmann::json;

ErrorMeasure measure_at(std::size_t index) {
    return static_cast<ErrorMeasure>(index);
}

Json errors_json(const std::vector<double>& errors) {
    Json json = Json::object();
    for (std::size_t i = 0; i < errors.size(); ++i) json[to_string(measure_at(i))] = errors[i];
    return json;
}

Json interval_json(const Interval& interval) {
    return {{"median", interval.median}, {"low", interval.low}, {"high", interval.high}};
}

Json unbiased_json(const std::optional<ErrorEstimate>& estimate) {
    return estimate ? estimate_json(*estimate) : Json();
}

Json point_json(const TradeoffPoint& point, const TradeoffResult& result) {
    Json errors = Json::object();
    for (std::size_t i = 0; i < point.errors.size(); ++i)
        errors[to_string(measure_at(i))] = interval_json(point.errors[i]);
    Json runs = Json::array();
    for (std::size_t i = 0; i < point.runs_ms.size(); ++i) {
        runs.push_back(
            {{"ms", point.runs_ms[i]}, {"errors", errors_json(point.runs_errors.at(i))}});
        if (i < point.runs_unbiased.size())
            runs.back()["unbiased_relmse"] = estimate_json(point.runs_unbiased[i]);
    }
    return {{"name", point.name},
            {"family", point.family},
            {"on_front", point.on_front},
            {"preset", preset_json(point.preset)},
            {"ms", interval_json(point.ms)},
            {"errors", errors},
            {"unbiased_relmse", unbiased_json(point.unbiased_relmse)},
            {"within_floor", within_floor(point, result)},
            {"rays", point.rays},
            {"runs", runs}};
}

Json spread_json(const TimeSpread& spread) {
    if (spread.deviations == 0) return {};
    return {
        {"factor", spread.factor}, {"degrees", spread.degrees}, {"deviations", spread.deviations}};
}

Json other_json(const OtherRendererPoint& other) {
    return {{"name", other.name},
            {"budget_s", other.budget_s},
            {"seconds", other.seconds},
            {"samples", other.samples},
            {"denoised", other.denoised},
            {"errors", errors_json(other.errors)},
            {"unbiased_relmse", unbiased_json(other.unbiased_relmse)}};
}

Json advice_json(const TradeoffAdvice& advice, const TradeoffResult& result) {
    Json json{{"sentence", advice.sentence}, {"point", nullptr}, {"preset", nullptr}};
    if (advice.budget_ms) json["budget_ms"] = *advice.budget_ms;
    if (advice.error) json["error"] = *advice.error;
    if (advice.point) {
        json["point"] = result.points.at(*advice.point).name;
        json["preset"] = advice.preset_file;
    }
    return json;
}

Json check_json(const FrontCheck& check, const TradeoffResult& result) {
    Json points = Json::array();
    for (const FrontCheck::Point& point : check.points)
        points.push_back({{"name", result.points.at(point.point).name},
                          {"ms", point.ms},
                          {"errors", point.errors}});
    const double images = check.images;
    return {{"pictures", check.images},
            {"times_within", check.times_within},
            {"errors_within", check.errors_within},
            {"share_of_times", check.images > 0 ? Json(check.times_within / images) : Json()},
            {"share_of_errors", check.images > 0 ? Json(check.errors_within / images) : Json()},
            {"points", points}};
}

/// A cell of CSV, in quotes where it has characters that would end it.
std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

/// The unbiased errors of the front.
std::string unbiased_text(const TradeoffResult& result) {
    std::string text;
    for (const TradeoffPoint& point : result.points) {
        if (!point.on_front || !point.unbiased_relmse) continue;
        if (text.empty())
            text = fmt::format("\n{:<32} {:>15} {:>22}\n", "without the reference's noise",
                               "unbiased relMSE", "95 %");
        const ErrorEstimate& error = *point.unbiased_relmse;
        text += fmt::format("{:<32} {:>15.3g} {:>22}\n", point.name, error.value,
                            fmt::format("{:.3g} to {:.3g}", error.low, error.high));
    }
    if (!text.empty() && result.reference.noise_relmse.value_or(0.0) > most_noise_relmse)
        text +=
            "the reference has too much noise for these intervals: --reference-spp has to be "
            "higher\n";
    return text.empty() ? text : text + "\n";
}

/// The floor by every measure, and which settings are within it.
std::string floor_text(const TradeoffResult& result) {
    const std::vector<double>& floor = result.reference.noise_floor;
    if (floor.empty()) return {};
    std::string text = fmt::format("one half of the reference's {} samples against the other:",
                                   result.reference.samples);
    for (std::size_t i = 0; i < floor.size(); ++i)
        text += fmt::format("{} {} {}", i > 0 ? "," : "", label(measure_at(i)),
                            error_figure(measure_at(i), floor[i]));
    return text + "\n" + floor_sentence(result) + "\n";
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    write_file_atomically(file, std::as_bytes(std::span(text)));
}

/// JSON as text. Names of files need not be valid UTF-8; bytes that are not are replaced.
std::string document(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

Json tradeoff_json(const TradeoffResult& result) {
    Json points = Json::array();
    for (const TradeoffPoint& point : result.points) points.push_back(point_json(point, result));
    Json others = Json::array();
    for (const OtherRendererPoint& other : result.others) others.push_back(other_json(other));
    Json advice = Json::array();
    for (const TradeoffAdvice& item : result.advice) advice.push_back(advice_json(item, result));
    return {{"weft_tradeoff", 1},
            {"scene", result.scene},
            {"size", {result.width, result.height}},
            {"exposure_ev", result.exposure_ev},
            {"repetitions", result.repetitions},
            {"measure", to_string(result.measure)},
            {"machine", result.machine},
            {"command", result.command},
            {"reference",
             {{"samples", result.reference.samples},
              {"noise_floor", errors_json(result.reference.noise_floor)},
              {"noise_relmse",
               result.reference.noise_relmse ? Json(*result.reference.noise_relmse) : Json()}}},
            {"points", points},
            {"time_spread", spread_json(result.time_spread)},
            {"skipped", result.skipped},
            {"peers", others},
            {"peer_notes", result.other_notes},
            {"advice", advice},
            {"check", result.check ? check_json(*result.check, result) : Json()}};
}

std::string tradeoff_csv(const TradeoffResult& result) {
    std::string text = "name,family,on_front,spp,ms,ms_low,ms_high,rays";
    for (std::size_t i = 0; i < error_measures; ++i) {
        const char* const name = to_string(measure_at(i));
        text += fmt::format(",{},{}_low,{}_high", name, name, name);
    }
    text += ",unbiased_relmse,unbiased_relmse_low,unbiased_relmse_high\n";
    for (const TradeoffPoint& point : result.points) {
        text += fmt::format("{},{},{},{},{},{},{},{}", cell(point.name), cell(point.family),
                            point.on_front ? 1 : 0, point.preset.samples, point.ms.median,
                            point.ms.low, point.ms.high, point.rays);
        for (const Interval& error : point.errors)
            text += fmt::format(",{},{},{}", error.median, error.low, error.high);
        const auto& unbiased = point.unbiased_relmse;
        text += unbiased
                    ? fmt::format(",{},{},{}\n", unbiased->value, unbiased->low, unbiased->high)
                    : ",,,\n";
    }
    return text;
}

std::string tradeoff_text(const TradeoffResult& result) {
    const auto kind = static_cast<std::size_t>(result.measure);
    std::string text = fmt::format("{:<32} {:>10} {:>22} {:>12} {:>24}\n", "on the front", "ms",
                                   "95 %", label(result.measure), "95 %");
    for (const TradeoffPoint& point : result.points) {
        if (!point.on_front) continue;
        const Interval& error = point.errors.at(kind);
        const std::string times = fmt::format("{:.4g} to {:.4g}", point.ms.low, point.ms.high);
        const std::string errors = fmt::format("{:.3g} to {:.3g}", error.low, error.high);
        text += fmt::format("{:<32} {:>10.4g} {:>22} {:>12.3g} {:>24}\n", point.name,
                            point.ms.median, times, error.median, errors);
    }
    if (result.time_spread.deviations > 0)
        text += fmt::format(
            "one more time lies within a factor of {:.3g} of its median, by {} times of all "
            "settings\n",
            result.time_spread.factor, result.time_spread.deviations);
    text += unbiased_text(result) + floor_text(result);
    for (const std::string& name : result.skipped)
        text += fmt::format("{} was too slow to measure\n", name);
    text += "\n";
    for (const TradeoffAdvice& advice : result.advice) {
        text += advice.sentence;
        text += advice.point ? fmt::format(" ({})\n", advice.preset_file) : "\n";
    }
    if (result.check)
        text += fmt::format(
            "\nof {} images made again, {} lie within the interval of time and {} within that of "
            "error\n",
            result.check->images, result.check->times_within, result.check->errors_within);
    return text;
}

void prepare_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder, error))
        throw Error(ExitCode::output, folder.string(), "is no folder, expected one to write to");
    const std::filesystem::path probe = folder / ".weft-probe";
    write_file_atomically(probe, std::span<const std::byte>{});
    std::filesystem::remove(probe, error);
}

void write_tradeoff(const std::filesystem::path& folder, const TradeoffResult& result) {
    const std::vector<WrittenPreset> earlier = written_presets(folder);
    std::set<std::string> names;
    for (const TradeoffAdvice& advice : result.advice) {
        if (!advice.point) continue;
        write_text(folder / advice.preset_file,
                   document(preset_json(result.points.at(*advice.point).preset)));
        names.insert(advice.preset_file);
    }
    write_text(folder / "tradeoff.csv", tradeoff_csv(result));
    write_text(folder / "index.html", tradeoff_page(result));
    // Last, because it lists the presets of the run: until then it lists those of the earlier one.
    write_text(folder / "tradeoff.json", document(tradeoff_json(result)));
    remove_presets(folder, earlier, names);
}

}  // namespace weft
