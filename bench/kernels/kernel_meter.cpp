// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/kernels/kernel_meter.h"

#include <algorithm>
#include <set>
#include <utility>

namespace weft::bench {
namespace {

/// Bytes of the buffers among these; one that is given twice counts once.
std::uint64_t bytes_of(std::span<const LaunchArgument> arguments) {
    std::set<const Buffer*> different;
    for (const LaunchArgument& argument : arguments)
        if (argument.buffer != nullptr) different.insert(argument.buffer);
    std::uint64_t bytes = 0;
    for (const Buffer* const buffer : different) bytes += buffer->bytes();
    return bytes;
}

}  // namespace

void KernelUse::add(const KernelUse& other) {
    launches += other.launches;
    items += other.items;
    bound_bytes += other.bound_bytes;
    ms += other.ms;
    rays += other.rays;
}

void KernelMeter::with_mapped(Buffer& buffer, Access access,
                              const std::function<void(std::span<std::byte>)>& use) {
    (access == Access::read ? read_bytes_ : written_bytes_) += buffer.bytes();
    inner().with_mapped(buffer, access, use);
}

bool KernelMeter::run(const Launch& launch, const std::function<bool(double)>& keep_going) {
    double* const wanted = launch.options.milliseconds;
    if (wanted != nullptr) wanted_.push_back({runs_.size(), wanted});
    KernelUse& use = runs_.emplace_back();
    use.kernel = launch.kernel;
    use.items = launch.items;
    use.bound_bytes = bytes_of(launch.arguments);
    Launch passed = launch;
    passed.options.milliseconds = &use.ms;
    return inner().run(passed, [&](double done) {
        ++use.launches;
        return !keep_going || keep_going(done);
    });
}

double KernelMeter::take_milliseconds() {
    // Where waiting fails, what a run took has nowhere to be added.
    const std::vector<Wanted> wanted = std::exchange(wanted_, {});
    const double ms = inner().take_milliseconds();
    for (const auto& [run, milliseconds] : wanted) *milliseconds += runs_[run].ms;
    return ms;
}

Metered KernelMeter::take() {
    (void)take_milliseconds();
    const std::deque<KernelUse> runs = std::exchange(runs_, {});
    return {{runs.begin(), runs.end()},
            std::exchange(read_bytes_, 0),
            std::exchange(written_bytes_, 0)};
}

bool add_rays(const FrameStats& frame, std::span<KernelUse> runs) {
    std::size_t next = 0;
    std::uint64_t rays = 0;
    for (const StageStats& stage : frame.stages) {
        if (next == runs.size()) break;
        if (stage.ms != runs[next].ms) continue;
        runs[next++].rays = stage.rays;
        rays += stage.rays;
    }
    return next == runs.size() && rays == frame.rays;
}

std::vector<KernelUse> by_kernel(std::span<const KernelUse> runs) {
    std::vector<KernelUse> uses;
    for (const KernelUse& run : runs) {
        const auto same = std::find_if(uses.begin(), uses.end(), [&](const KernelUse& use) {
            return use.kernel == run.kernel;
        });
        if (same == uses.end())
            uses.push_back(run);
        else
            same->add(run);
    }
    std::stable_sort(uses.begin(), uses.end(),
                     [](const KernelUse& a, const KernelUse& b) { return a.ms > b.ms; });
    return uses;
}

}  // namespace weft::bench
