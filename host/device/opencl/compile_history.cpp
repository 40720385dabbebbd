// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/compile_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <span>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/cache_folder.h"
#include "base/error.h"
#include "base/file.h"
#include "device/opencl/program_cache.h"

namespace weft {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 16;
constexpr double longest_ms = 1e6;

/// Milliseconds for the square of a source's length in bytes. Times of 13 kernels, of which the
/// longest took ten times as long as the shortest, were within a third of the square at PoCL 3.1:
/// a kernel that includes more also calls more, and inlines it more often.
constexpr double ms_per_square = 35e-9;

bool is_time(double ms) {
    return std::isfinite(ms) && ms > 0.0 && ms <= longest_ms;
}

}  // namespace

CompileHistory::CompileHistory(const std::filesystem::path& folder, const DeviceInfo& device) {
    if (folder.empty()) return;
    constexpr std::size_t digits = 16;
    const std::array<std::string_view, 2> parts{device.name, device.driver};
    file_ = folder / ("compile-times-" + ProgramCache::key(parts).substr(0, digits) + ".txt");
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_, error)) return;
    std::vector<std::byte> bytes;
    try {
        bytes = read_file(file_, most_bytes);
    } catch (const Error&) {
        return;
    }
    std::istringstream text(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    for (std::string line; std::getline(text, line);) {
        std::istringstream fields(line);
        std::string kernel;
        double ms = 0.0;
        if (fields >> kernel >> ms && is_time(ms)) times_[kernel] = ms;
    }
}

double CompileHistory::expected_ms(const ProgramRecipe& recipe) const {
    const auto found = times_.find(recipe.name);
    if (found != times_.end()) return found->second;
    const auto length = static_cast<double>(recipe.source.size());
    return std::max(1.0, ms_per_square * length * length);
}

void CompileHistory::add(const ProgramRecipe& recipe, double ms) {
    constexpr double least_share = 0.25;
    if (!is_time(ms) || ms < least_share * expected_ms(recipe)) return;
    times_[recipe.name] = ms;
    changed_ = true;
}

void CompileHistory::store() const {
    if (file_.empty() || !changed_) return;
    std::string text;
    for (const auto& [kernel, ms] : times_) text += fmt::format("{} {:.1f}\n", kernel, ms);
    try {
        make_cache_folder(file_.parent_path());
        write_file_atomically(file_, std::as_bytes(std::span(text)), WriteMode::unflushed);
    } catch (const std::exception&) {
        return;
    }
}

}  // namespace weft
