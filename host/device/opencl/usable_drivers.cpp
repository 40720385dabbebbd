// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/usable_drivers.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <system_error>

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
constexpr std::string_view trial_version = "1";
constexpr std::size_t most_record_bytes = std::size_t{1} << 20;
constexpr std::size_t most_remembered = 32;

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
    std::string boot;
    std::getline(std::ifstream("/proc/sys/kernel/random/boot_id") >> std::ws, boot);
    digest.add(boot);
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

/// Fails a device whose driver has crashed after its trial, or forgets that.
void heed_mark(DeviceTrial& device, TrialUse use) {
    const fs::path mark = crash_mark(device.name, device.driver);
    std::error_code error;
    if (mark.empty() || !fs::exists(mark, error)) return;
    if (use == TrialUse::fresh)
        fs::remove(mark, error);
    else if (device.failure.empty())
        device.failure = "its driver has ended the program in an earlier run";
}

/// Trials of earlier runs, newest first, in a file of the cache folder. What cannot be read or
/// written is as if it had never been.
class TrialRecord {
  public:
    explicit TrialRecord(const fs::path& folder) {
        if (folder.empty()) return;
        file_ = folder / "trials.json";
        try {
            for (const nlohmann::json& entry : read_json_file(file_, most_record_bytes))
                entries_.push_back({entry.at("state").get<std::string>(), trial_of(entry)});
        } catch (const std::exception&) {
            entries_.clear();
        }
    }

    [[nodiscard]] std::optional<DriverTrial> find(const DriverFile& driver,
                                                  const std::string& state) const {
        for (const Entry& entry : entries_)
            if (entry.state == state && entry.trial.driver == driver) return entry.trial;
        return {};
    }

    void add(const std::string& state, const DriverTrial& trial) {
        std::erase_if(entries_, [&](const Entry& entry) {
            return entry.state == state && entry.trial.driver == trial.driver;
        });
        entries_.insert(entries_.begin(), {state, trial});
    }

    void store() {
        if (file_.empty()) return;
        nlohmann::json list = nlohmann::json::array();
        for (std::size_t i = 0; i < std::min(entries_.size(), most_remembered); ++i)
            list.push_back(json_of(entries_[i]));
        try {
            make_cache_folder(file_.parent_path());
            const std::string text =
                list.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
            write_file_atomically(file_, std::as_bytes(std::span(text)), WriteMode::unflushed);
        } catch (const std::exception&) {
            return;
        }
    }

  private:
    struct Entry {
        std::string state;
        DriverTrial trial;
    };

    static DriverTrial trial_of(const nlohmann::json& entry) {
        DriverTrial trial;
        trial.driver = {entry.at("file").get<std::string>(),
                        entry.at("library").get<std::string>()};
        trial.failure = entry.at("failure").get<std::string>();
        for (const nlohmann::json& device : entry.at("devices"))
            trial.devices.push_back({device.at("name").get<std::string>(),
                                     device.at("driver").get<std::string>(),
                                     device.at("failure").get<std::string>()});
        return trial;
    }
    static nlohmann::json json_of(const Entry& entry) {
        nlohmann::json devices = nlohmann::json::array();
        for (const DeviceTrial& device : entry.trial.devices)
            devices.push_back(
                {{"name", device.name}, {"driver", device.driver}, {"failure", device.failure}});
        return {{"state", entry.state},
                {"file", entry.trial.driver.file.string()},
                {"library", entry.trial.driver.library},
                {"failure", entry.trial.failure},
                {"devices", devices}};
    }

    fs::path file_;
    std::vector<Entry> entries_;
};

}  // namespace

void admit_drivers(TrialUse use) {
    const std::vector<DriverFile> drivers = driver_files();
    if (drivers.empty()) return;
    const fs::path folder = record_folder();
    TrialRecord record(folder);
    std::vector<DriverTrial>& trials = admitted();
    trials.clear();
    std::vector<DriverFile> untried;
    for (const DriverFile& driver : drivers)
        if (use == TrialUse::fresh || !record.find(driver, state_of(driver)))
            untried.push_back(driver);
    bool whole = true;
    for (const DriverTrial& trial : try_drivers(untried, folder, trial_seconds())) {
        record.add(state_of(trial.driver), trial);
        whole = whole && !trial.disturbed;
    }
    // With more memory, or undisturbed, the same drivers may pass.
    if (!untried.empty() && whole && !memory_limit()) record.store();
    std::vector<DriverFile> usable;
    for (const DriverFile& driver : drivers) {
        trials.push_back(record.find(driver, state_of(driver)).value());
        if (trials.back().failure.empty()) usable.push_back(driver);
        for (DeviceTrial& device : trials.back().devices) heed_mark(device, use);
    }
    if (usable.size() < trials.size()) open_only(usable, folder);
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

fs::path crash_mark(const std::string& name, const std::string& driver) {
    const fs::path folder = record_folder();
    if (folder.empty()) return {};
    ContentDigest digest;
    digest.add(name);
    digest.add(driver);
    return folder / ("crashed-" + digest.text());
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
