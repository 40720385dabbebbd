// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "app/choose_executor.h"
#include "app/commands.h"
#include "app/print.h"
#include "app/stats_json.h"

namespace weft {
namespace {

nlohmann::json checked_json(const DeviceInfo& device) {
    nlohmann::json json = device_json(device);
    json["failure"] = device.failure;
    json["lacks"] = device.lacks;
    return json;
}

/// A device, or a driver that could not be opened, in one line; with `check` further lines say how
/// it did.
std::string lines_of(const DeviceInfo& device, bool check) {
    constexpr const char* indented = "             {}\n";
    const bool is_driver = device.name.empty() && !device.failure.empty();
    std::string text = fmt::format(
        "{:>2}  {:<7} ", device.index >= 0 ? std::to_string(device.index) : "-", device.backend);
    text += is_driver
                ? fmt::format("driver {}\n", device.driver)
                : fmt::format("{} ({}; {} units, {:.1f} GiB)\n", device.name, device.driver,
                              device.compute_units, static_cast<double>(device.memory) / (1 << 30));
    if (!device.failure.empty())
        text += fmt::format(indented, "not usable: " + device.failure);
    else if (check)
        text += fmt::format(indented, "works");
    if (check)
        for (const std::string& lack : device.lacks) text += fmt::format(indented, "lacks " + lack);
    return text;
}

}  // namespace

ExitCode devices_command(const DevicesOptions& options) {
    const std::vector<DeviceInfo> devices = all_devices();
    if (options.json) {
        nlohmann::json list = nlohmann::json::array();
        for (const DeviceInfo& device : devices) list.push_back(checked_json(device));
        print_result(json_document(list));
    } else {
        std::string text;
        for (const DeviceInfo& device : devices) text += lines_of(device, options.check);
        print_result(text);
    }
    const bool all_work =
        std::ranges::all_of(devices, [](const auto& device) { return device.failure.empty(); });
    return !options.check || all_work ? ExitCode::success : ExitCode::device;
}

}  // namespace weft
