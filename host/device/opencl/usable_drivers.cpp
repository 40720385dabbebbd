// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/usable_drivers.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/boot_id.h"
#include "base/cache_folder.h"
#include "base/content_digest.h"
#include "base/file.h"
#include "base/json_file.h"
#include "base/memory_limit.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX declares it nowhere

namespace weft {
namespace {

namespace fs = std::filesystem;

/// How long drivers may take, s: WEFT_DRIVER_SECONDS, or else 20. Those that work need about three,
/// most of them to compile two kernels.
double trial_seconds() {
    constexpr double usual = 20.0;
    constexpr double most = 3600.0;
    const char* const text = std::getenv("WEFT_DRIVER_SECONDS");
    const double given = text != nullptr ? std::strtod(text, nullptr) : 0.0;
    return given > 0.0 && given <= most ? given : usual;
}

/// Changes when other drivers would pass than before.
constexpr std::string_view trial_version = "2";
constexpr std::size_t most_record_bytes = std::size_t{1} << 20;
constexpr std::string_view record_prefix = "trial-";
constexpr std::string_view mark_prefix = "crashed-";
constexpr std::chrono::days kept_for{60};

std::vector<DriverTrial>& admitted() {
    static std::vector<DriverTrial> trials;
    return trials;
}

/// Where what is known of drivers is kept; empty where there is no cache folder.
fs::path record_folder() {
    const fs::path cache = default_cache_folder();
    return cache.empty() ? cache : fs::absolute(cache) / "drivers";
}

void add_file(ContentDigest& digest, const fs::path& file) {
    struct stat is {};
    if (::stat(file.c_str(), &is) != 0) return digest.add("missing");
    digest.add_value(is.st_size);
    digest.add_value(is.st_mtim.tv_sec);
    digest.add_value(is.st_mtim.tv_nsec);
}

/// What a driver may do depends on: its files, as far as they can be named without opening it, the
/// libraries installed, the variables that drivers read, and the running system.
std::string state_of(const DriverFile& driver) {
    constexpr std::array<std::string_view, 15> prefixes{
        "POCL_", "RUSTICL_", "MESA_", "LP_",         "GALLIUM_",
        "OCL_",  "CL_",      "CUDA_", "ROC",         "HSA_",
        "HIP_",  "AMD_",     "LD_",   "WEFT_LANES=", "WEFT_SIMULATE_GPU="};
    ContentDigest digest;
    digest.add(WEFT_VERSION);
    digest.add(trial_version);
    add_file(digest, driver.file);
    if (driver.library.starts_with('/')) add_file(digest, driver.library);
    add_file(digest, "/etc/ld.so.cache");
    digest.add(boot_id());
    std::vector<std::string_view> variables;
    for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
        const std::string_view text(*variable);
        // Which drivers there are is known, and this changes with it.
        if (text.starts_with("OCL_ICD_") || text.starts_with("POCL_CACHE_DIR")) continue;
        if (std::ranges::any_of(prefixes,
                                [&](std::string_view prefix) { return text.starts_with(prefix); }))
            variables.push_back(text);
    }
    std::ranges::sort(variables);
    for (const std::string_view variable : variables) digest.add(variable);
    return digest.text();
}

/// The file that keeps the trial of a driver in the state that it is in; empty where there is no
/// folder. Machines that share a folder are in different states, each booted at its own time.
fs::path record_of(const DriverFile& driver, const fs::path& folder) {
    if (folder.empty()) return {};
    ContentDigest digest;
    digest.add(driver.file.string());
    digest.add(driver.library);
    digest.add(state_of(driver));
    return folder / (std::string(record_prefix) + digest.text() + ".json");
}

/// A trial of an earlier run. What cannot be read is as if it had never been.
std::optional<DriverTrial> remembered(const DriverFile& driver, const fs::path& record) {
    if (record.empty()) return {};
    try {
        const nlohmann::json json = read_json_file(record, most_record_bytes);
        DriverTrial trial;
        trial.driver = driver;
        trial.failure = json.at("failure").get<std::string>();
        for (const nlohmann::json& device : json.at("devices"))
            trial.devices.push_back({device.at("name").get<std::string>(),
                                     device.at("driver").get<std::string>(),
                                     device.at("failure").get<std::string>()});
        return trial;
    } catch (const std::exception&) {
        return {};
    }
}

/// Keeps a trial for later runs, where that can be done.
void remember(const DriverTrial& trial, const fs::path& record) {
    if (record.empty()) return;
    nlohmann::json devices = nlohmann::json::array();
    for (const DeviceTrial& device : trial.devices)
        devices.push_back(
            {{"name", device.name}, {"driver", device.driver}, {"failure", device.failure}});
    const nlohmann::json json{{"file", trial.driver.file.string()},
                              {"library", trial.driver.library},
                              {"failure", trial.failure},
                              {"devices", devices}};
    try {
        make_cache_folder(record.parent_path());
        const std::string text =
            json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
        write_file_atomically(record, std::as_bytes(std::span(text)), WriteMode::unflushed);
    } catch (const std::exception&) {
        return;
    }
}

/// Removes what was noted of states that have long not come back.
void remove_old_records(const fs::path& folder) {
    std::error_code error;
    const auto now = fs::file_time_type::clock::now();
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        const std::string name = at->path().filename().string();
        if ((name.starts_with(record_prefix) || name.starts_with(mark_prefix)) &&
            now - at->last_write_time(ignored) > kept_for)
            fs::remove(at->path(), ignored);
    }
}

/// Fails devices whose driver has crashed after their trial, or forgets that.
void heed_marks(std::vector<DriverTrial>& trials, TrialUse use) {
    std::map<std::pair<std::string, std::string>, std::size_t> before;
    for (DriverTrial& trial : trials) {
        if (!trial.failure.empty()) continue;
        for (DeviceTrial& device : trial.devices) {
            const fs::path mark =
                crash_mark(device.name, device.driver, before[{device.name, device.driver}]++);
            std::error_code error;
            if (mark.empty() || !fs::exists(mark, error)) continue;
            if (use == TrialUse::fresh)
                fs::remove(mark, error);
            else if (device.failure.empty())
                device.failure = "its driver has ended the program in an earlier run";
        }
    }
}

}  // namespace

void admit_drivers(TrialUse use) {
    const std::vector<DriverFile> drivers = driver_files();
    if (drivers.empty()) return;
    const fs::path folder = record_folder();
    // One of them has crashed while all were opened, nobody knows which.
    std::error_code none;
    const bool crashed = !folder.empty() && fs::remove(opening_mark(), none);
    const bool all_again = use == TrialUse::fresh || crashed;
    std::vector<std::optional<DriverTrial>> known;
    std::vector<DriverFile> untried;
    for (const DriverFile& driver : drivers) {
        known.push_back(all_again ? std::optional<DriverTrial>()
                                  : remembered(driver, record_of(driver, folder)));
        if (!known.back()) untried.push_back(driver);
    }
    std::vector<DriverTrial> tried = try_drivers(untried, folder, trial_seconds());
    for (const DriverTrial& trial : tried)
        // With more memory, or undisturbed, the same driver may pass.
        if (!trial.momentary && !memory_limit()) remember(trial, record_of(trial.driver, folder));
    if (!tried.empty()) remove_old_records(folder);
    std::vector<DriverTrial>& trials = admitted();
    trials.clear();
    std::vector<DriverFile> usable;
    auto next = tried.begin();
    for (std::optional<DriverTrial>& trial : known) {
        trials.push_back(trial ? *std::move(trial) : *next++);
        if (trials.back().failure.empty()) usable.push_back(trials.back().driver);
    }
    heed_marks(trials, use);
    if (usable.size() < trials.size()) open_only(list_drivers(usable, folder));
}

const std::vector<DriverTrial>& driver_trials() noexcept {
    return admitted();
}

std::string known_failure(const std::string& name, const std::string& driver, std::size_t before) {
    for (const DriverTrial& trial : admitted()) {
        if (!trial.failure.empty()) continue;
        for (const DeviceTrial& device : trial.devices)
            if (device.name == name && device.driver == driver && before-- == 0)
                return device.failure;
    }
    return {};
}

fs::path crash_mark(const std::string& name, const std::string& driver, std::size_t before) {
    const fs::path folder = record_folder();
    if (folder.empty()) return {};
    ContentDigest digest;
    digest.add(boot_id());  // another machine's device may be a sound one
    digest.add(name);
    digest.add(driver);
    digest.add_value(before);
    return folder / (std::string(mark_prefix) + digest.text());
}

fs::path opening_mark() {
    const fs::path folder = record_folder();
    if (folder.empty()) return {};
    ContentDigest digest;
    digest.add(boot_id());
    return folder / (std::string(mark_prefix) + "opening-" + digest.text());
}

std::string refused_drivers() {
    std::string text;
    for (const DriverTrial& trial : admitted())
        if (!trial.failure.empty())
            text += fmt::format("{}driver {}: {}", text.empty() ? "" : "; ", trial.driver.place(),
                                trial.failure);
    return text;
}

}  // namespace weft
