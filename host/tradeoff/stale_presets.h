// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_STALE_PRESETS_H
#define WEFT_TRADEOFF_STALE_PRESETS_H

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// A file of settings that a run wrote beside its page.
struct WrittenPreset {
    std::string name;         ///< as advice names it
    nlohmann::json settings;  ///< what the run wrote into it
};

/// The presets that the run wrote whose tradeoff.json lies in a folder; none where there is no such
/// file or it is damaged. Names other than those that advice gives are left out.
[[nodiscard]] std::vector<WrittenPreset> written_presets(const std::filesystem::path& folder);

/// Removes those of the files that have not changed since the run wrote them, except the ones named
/// in `kept`. Throws Error (exit code 5) where one cannot be removed.
void remove_presets(const std::filesystem::path& folder, std::span<const WrittenPreset> written,
                    const std::set<std::string>& kept);

}  // namespace weft

#endif
