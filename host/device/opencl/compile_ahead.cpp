// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/compile_ahead.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <thread>

#include "device/opencl/compile_server.h"
#include "device/opencl/opencl_devices.h"

namespace weft {
namespace {

/// Most processes, since each has a compiler in memory and an image has about as many programs.
constexpr std::uint32_t most_processes = 16;

}  // namespace

CompileTimes compile_ahead(const std::vector<ProgramRecipe>& programs, const DeviceInfo& device,
                           const ProgramCache& cache, std::uint32_t processes) {
    CompileTimes times(programs.size());
    CompileServer* const server = CompileServer::current();
    const std::uint32_t workers =
        std::min({processes, std::thread::hardware_concurrency(), most_processes});
    // Drivers of other devices compile with threads of their own; a simulator has to compile the
    // source in the process that it watches.
    if (server == nullptr || workers < 2 || !device.is_cpu || is_simulator(device) ||
        cache.folder().empty())
        return times;
    CompileRequest request;
    std::vector<std::size_t> positions;
    std::set<std::string> keys;
    for (std::size_t i = 0; i < programs.size(); ++i) {
        if (cache.contains(programs[i].key) || !keys.insert(programs[i].key).second) continue;
        request.programs.push_back(programs[i]);
        positions.push_back(i);
    }
    std::error_code error;
    request.cache_folder = std::filesystem::absolute(cache.folder(), error).string();
    if (request.programs.size() < 2 || error) return times;
    request.device = static_cast<std::uint32_t>(device.index);
    request.workers = workers;
    const CompileTimes compiled = server->compile(request);
    for (std::size_t i = 0; i < positions.size(); ++i) times[positions[i]] = compiled[i];
    return times;
}

}  // namespace weft
