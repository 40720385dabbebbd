// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/executor.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/error.h"

namespace weft {
namespace {

struct KernelEntry {
    std::string_view name;
    std::uint32_t chunk;
};

constexpr std::array kernel_entries{
#define WEFT_KERNEL_ENTRY(name, chunk, work) KernelEntry{#name, chunk},
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY
};

}  // namespace

std::string_view kernel_name(KernelId kernel) {
    return kernel_entries.at(static_cast<std::size_t>(kernel)).name;
}

std::uint32_t kernel_chunk(KernelId kernel) {
    return kernel_entries.at(static_cast<std::size_t>(kernel)).chunk;
}

void check_update(const TracedGeometry& made_of, const TracedGeometry& given) {
    const auto same = [](const auto& a, const auto& b) {
        return a.data() == b.data() && a.size() == b.size();
    };
    if (!same(made_of.positions, given.positions) || !same(made_of.triangles, given.triangles) ||
        made_of.first_moving != given.first_moving)
        throw Error(ExitCode::device,
                    "a scene cannot be brought up to date with geometry it was not made of");
}

std::unique_ptr<Buffer> upload_bytes(Executor& executor, std::span<const std::byte> bytes,
                                     std::string_view what) {
    auto buffer = executor.allocate(std::max<std::size_t>(bytes.size(), 16), what);
    write_buffer(executor, *buffer, bytes);
    return buffer;
}

std::uint32_t lanes_from_environment() {
    const char* const text = std::getenv("WEFT_LANES");
    if (text == nullptr || *text == '\0') return 0;
    for (const std::uint32_t lanes : {1U, 4U, 8U, 16U})
        if (text == std::to_string(lanes)) return lanes;
    throw Error(ExitCode::usage,
                "WEFT_LANES is \"" + std::string(text) + "\", expected 1, 4, 8 or 16");
}

}  // namespace weft
