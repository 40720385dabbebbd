// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "app/choose_executor.h"
#include "app/commands.h"
#include "app/print.h"
#include "app/stats_json.h"

namespace weft {

void devices_command(const DevicesOptions& options) {
    const std::vector<DeviceInfo> devices = all_devices();
    if (options.json) {
        nlohmann::json list = nlohmann::json::array();
        for (const DeviceInfo& device : devices) list.push_back(device_json(device));
        print_result(json_document(list));
        return;
    }
    std::string text;
    for (const DeviceInfo& device : devices)
        text += fmt::format("{:>2}  {:<7} {} ({}; {} units, {:.1f} GiB)\n",
                            device.index >= 0 ? std::to_string(device.index) : "-", device.backend,
                            device.name, device.driver, device.compute_units,
                            static_cast<double>(device.memory) / (1 << 30));
    print_result(text);
}

}  // namespace weft
