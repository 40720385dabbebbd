// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/compile_ahead.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "base/stopwatch.h"
#include "device/opencl/compile_estimate.h"
#include "device/opencl/compile_server.h"
#include "device/opencl/opencl_devices.h"

namespace weft {
namespace {

/// Most processes, since each has a compiler in memory and an image has about as many programs.
constexpr std::uint32_t most_processes = 16;

/// What tells `watch` how long it will take until workers have compiled all programs. They take
/// those with the longest source first.
std::function<void()> waiting(const std::vector<ProgramRecipe>& programs, std::uint32_t workers,
                              const ProgramCache& cache, const CompileHistory& history,
                              const CompileWatch& watch) {
    if (!watch) return {};
    std::vector<std::pair<std::size_t, double>> order;
    std::vector<std::string> keys;
    for (const ProgramRecipe& program : programs) {
        order.emplace_back(program.source.size(), history.expected_ms(program));
        keys.push_back(program.key);
    }
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<double> expected;
    for (const auto& [length, ms] : order) expected.push_back(ms);
    return [estimate = CompileEstimate(expected, workers), keys, &cache, &watch,
            clock = Stopwatch()]() mutable {
        const auto done = std::count_if(
            keys.begin(), keys.end(), [&](const std::string& key) { return cache.contains(key); });
        watch(keys.size(), estimate.left_ms(static_cast<std::size_t>(done), clock.total()));
    };
}

}  // namespace

CompileTimes compile_ahead(const std::vector<ProgramRecipe>& programs, const DeviceInfo& device,
                           const ProgramCache& cache, std::uint32_t processes,
                           CompileHistory& history, const CompileWatch& watch) {
    CompileTimes times(programs.size());
    CompileServer* const server = CompileServer::current();
    const std::uint32_t workers =
        std::min({processes, std::thread::hardware_concurrency(), most_processes});
    // Drivers of other devices compile with threads of their own; a simulator has to compile the
    // source in the process that it watches.
    if (server == nullptr || workers < 2 || !device.compiles_alone || is_simulator(device) ||
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
    const CompileTimes compiled =
        server->compile(request, waiting(request.programs, workers, cache, history, watch));
    for (std::size_t i = 0; i < positions.size(); ++i) {
        times[positions[i]] = compiled[i];
        if (compiled[i]) history.add(request.programs[i], *compiled[i]);
    }
    return times;
}

}  // namespace weft
