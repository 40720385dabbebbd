// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/launch_pacer.h"

#include <algorithm>

namespace weft {
namespace {

/// The first launch of an unknown workload has this fraction (1 / first_share) of its most items.
constexpr std::uint32_t first_share = 16;
/// How many times as large as any measured launch the next one may be.
constexpr std::uint32_t most_growth = 4;
/// Weight of an older, longer time: costs differ from place to place in an image.
constexpr double memory = 0.7;
/// Workloads that are kept; those whose most depends on the frame would add up without end.
constexpr std::size_t most_workloads = 1024;

}  // namespace

std::uint32_t LaunchPacer::items(KernelId kernel, std::uint32_t most) {
    if (paces_.size() >= most_workloads) paces_.clear();
    const Pace& pace = paces_[{kernel, most}];
    const std::uint32_t least = std::min(least_, most);
    if (pace.largest == 0) return std::max(least, most / first_share);
    const double grown = static_cast<double>(pace.largest) * most_growth;
    const double wanted =
        pace.ms_per_item > 0.0 ? std::min(grown, launch_ms / pace.ms_per_item) : grown;
    if (wanted >= static_cast<double>(most)) return most;
    // A multiple of the least keeps all of the device busy to the end.
    const std::uint32_t count = static_cast<std::uint32_t>(wanted) / least * least;
    return std::max(least, count);
}

void LaunchPacer::took(KernelId kernel, std::uint32_t most, std::uint32_t items, double ms) {
    if (items == 0 || !(ms >= 0.0)) return;
    Pace& pace = paces_[{kernel, most}];
    const double now = ms / items;
    const double before = pace.ms_per_item;
    pace.ms_per_item = std::max(now, memory * before + (1.0 - memory) * now);
    pace.largest = std::max(pace.largest, items);
}

}  // namespace weft
