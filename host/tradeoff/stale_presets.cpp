// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/stale_presets.h"

#include <cstddef>
#include <system_error>

#include "base/error.h"
#include "base/json_file.h"
#include "base/limits.h"
#include "tradeoff/advice.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t max_preset_bytes = std::size_t{1} << 20;

/// Whether `name` is the one that advice gives its preset: tradeoff.json must not make a run remove
/// any other file.
bool is_its_name(const JsonValue& advice, const std::string& name) {
    if (const auto budget = advice.find("budget_ms"))
        return name == preset_file_for_budget(budget->as_number());
    return name == preset_file_for_error(advice.at("error").as_number());
}

/// The settings of the point of that name.
const Json* settings_of(const Json& report, const std::string& point) {
    for (const Json& other : report.at("points"))
        if (other.at("name") == point) return &other.at("preset");
    return nullptr;
}

std::vector<WrittenPreset> presets_in(const Json& report, const std::string& place) {
    const JsonValue value(report, place);
    std::vector<WrittenPreset> found;
    if (value.at("weft_tradeoff").as_integer() != 1) return found;
    const JsonValue answers = value.at("advice");
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const JsonValue advice = answers.element(i);
        if (report.at("advice")[i].at("preset").is_null()) continue;
        const std::string name = advice.at("preset").as_string();
        const Json* const settings = settings_of(report, advice.at("point").as_string());
        if (settings != nullptr && is_its_name(advice, name)) found.push_back({name, *settings});
    }
    return found;
}

/// Whether the file exists and still has these settings.
bool is_unchanged(const fs::path& file, const Json& settings) {
    std::error_code error;
    if (fs::symlink_status(file, error).type() != fs::file_type::regular) return false;
    try {
        return read_json_file(file, max_preset_bytes) == settings;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

std::vector<WrittenPreset> written_presets(const fs::path& folder) {
    const fs::path file = folder / "tradeoff.json";
    try {
        return presets_in(read_json_file(file, limits::max_text_file_bytes), file.string() + "#");
    } catch (const Error&) {
        return {};  // a damaged file counts as absent
    } catch (const Json::exception&) {
        return {};
    }
}

void remove_presets(const fs::path& folder, std::span<const WrittenPreset> written,
                    const std::set<std::string>& kept) {
    for (const WrittenPreset& preset : written) {
        const fs::path file = folder / preset.name;
        if (kept.contains(preset.name) || !is_unchanged(file, preset.settings)) continue;
        std::error_code error;
        fs::remove(file, error);
        if (error)
            throw Error(ExitCode::output, file.string(),
                        "is of an earlier run and cannot be removed: " + error.message());
    }
}

}  // namespace weft
