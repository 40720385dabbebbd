// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/reference_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "base/cache_folder.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

std::optional<std::uint32_t> count_in(std::string_view digits) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    return value;
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

void put_most_first(std::vector<SampledFile>& files) {
    std::stable_sort(files.begin(), files.end(), [](const SampledFile& a, const SampledFile& b) {
        return a.samples > b.samples;
    });
}

}  // namespace

fs::path default_references_folder() {
    const fs::path cache = default_cache_folder();
    return cache.empty() ? fs::path() : cache / "references" / WEFT_VERSION;
}

std::vector<SampledFile> files_by_samples(const fs::path& folder, std::string_view prefix,
                                          std::string_view suffix) {
    std::vector<SampledFile> found;
    for (const fs::path& file : files_in(folder)) {
        const std::string name = file.filename().string();
        if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) ||
            !name.ends_with(suffix))
            continue;
        const auto samples = count_in(std::string_view(name).substr(
            prefix.size(), name.size() - prefix.size() - suffix.size()));
        if (samples) found.push_back({*samples, file});
    }
    put_most_first(found);
    return found;
}

std::vector<SampledFile> files_by_samples(const fs::path& folder, std::string_view suffix) {
    std::vector<SampledFile> found;
    for (const fs::path& file : files_in(folder)) {
        const std::string name = file.filename().string();
        if (!name.ends_with(suffix)) continue;
        const std::string_view begin =
            std::string_view(name).substr(0, name.size() - suffix.size());
        const std::size_t dash = begin.rfind('-');
        if (dash == std::string_view::npos) continue;
        if (const auto samples = count_in(begin.substr(dash + 1)))
            found.push_back({*samples, file});
    }
    put_most_first(found);
    return found;
}

std::optional<fs::path> file_ending_with(const fs::path& folder, std::string_view suffix) {
    for (const fs::path& file : files_in(folder)) {
        const std::string name = file.filename().string();
        if (name.size() > suffix.size() && name.ends_with(suffix)) return file;
    }
    return std::nullopt;
}

std::optional<double> metadata_number(const Image& image, const std::string& key) {
    const auto found = image.metadata.find(key);
    if (found == image.metadata.end()) return std::nullopt;
    const std::string& text = found->second;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

}  // namespace weft
