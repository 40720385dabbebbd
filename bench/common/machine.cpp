// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/machine.h"

#include <fmt/format.h>

#include <cstdlib>
#include <thread>

#include "base/file.h"
#include "bench/common/compact_json.h"
#include "device/native/embree_scene.h"
#include "device/native/native_executor.h"

namespace weft::bench {

nlohmann::json machine_json(int threads) {
    const DeviceInfo host = native_device_info(NativeTraversal::own_bvh);
    double load[1] = {0.0};
    const bool known = getloadavg(load, 1) == 1;
    return {{"processor", host.name},
            {"hardware_threads", std::thread::hardware_concurrency()},
            {"threads", threads},
            {"memory", host.memory},
            {"vector_width", host.native_width},
            {"load", known ? nlohmann::json(load[0]) : nlohmann::json()}};
}

nlohmann::json versions_json() {
    return {{"weft", WEFT_VERSION}, {"compiler", __VERSION__}, {"embree", embree_version()}};
}

nlohmann::json device_json(const Executor& executor) {
    const DeviceInfo& device = executor.device();
    return {{"backend", device.backend}, {"name", device.name},
            {"driver", device.driver},   {"version", device.version},
            {"lanes", executor.lanes()}, {"compute_units", device.compute_units}};
}

void write_json(const std::filesystem::path& path, const nlohmann::json& json) {
    const std::string text = compact_json(json) + "\n";
    write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace weft::bench
