// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/kernel_signature.h"

#include <fmt/format.h>

#include <array>

#include "base/error.h"
#include "kernels/core/signatures.h"

namespace weft {
namespace {

using namespace shared;

#define WEFT_INFO(mode, kind, name) WEFT_INFO_##mode(kind, name)
#define WEFT_INFO_READS(kind, name) ArgumentInfo{#name, false, sizeof(void*)},
#define WEFT_INFO_WRITES(kind, name) WEFT_INFO_READS(kind, name)
#define WEFT_INFO_MAY_READ(kind, name) WEFT_INFO_READS(kind, name)
#define WEFT_INFO_MAY_WRITE(kind, name) WEFT_INFO_READS(kind, name)
#define WEFT_INFO_VALUE(type, name) ArgumentInfo{#name, true, sizeof(type)},
#define WEFT_INFO_TRACES(kind, name)
#define WEFT_INFO_GROUP(group, name) GROUP_##group(WEFT_INFO_MEMBER)
#define WEFT_INFO_MEMBER(mode, kind, name) WEFT_INFO_##mode(kind, name)

#define WEFT_TRACES(mode, kind, name) WEFT_TRACES_##mode
#define WEFT_TRACES_READS
#define WEFT_TRACES_WRITES
#define WEFT_TRACES_MAY_READ
#define WEFT_TRACES_MAY_WRITE
#define WEFT_TRACES_VALUE
#define WEFT_TRACES_GROUP
#define WEFT_TRACES_TRACES +1

/// Bytes that the arguments take: `params`, `range`, the two buffers of a BVH where rays are
/// traced, and the others.
template <std::size_t N>
constexpr std::size_t bytes_of(const std::array<ArgumentInfo, N>& arguments, bool traces) {
    std::size_t bytes = sizeof(RenderParams) + sizeof(LaunchRange);
    if (traces) bytes += 2 * sizeof(void*);
    for (const ArgumentInfo& argument : arguments) bytes += argument.bytes;
    return bytes;
}

#define WEFT_KERNEL_ENTRY(kernel, chunk, work)                                          \
    constexpr std::array arguments_##kernel{ARGUMENTS_##kernel(WEFT_INFO)};             \
    constexpr bool traces_##kernel = (0 ARGUMENTS_##kernel(WEFT_TRACES)) != 0;          \
    static_assert(bytes_of(arguments_##kernel, traces_##kernel) <= most_argument_bytes, \
                  "the arguments of kernel " #kernel " take more than 1024 bytes together");
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY

struct Signature {
    std::string_view name;
    std::span<const ArgumentInfo> arguments;
    bool traces;
};

constexpr std::array signatures{
#define WEFT_KERNEL_ENTRY(kernel, chunk, work) \
    Signature{#kernel, arguments_##kernel, traces_##kernel},
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY
};

[[noreturn]] void refuse(const Launch& launch, const std::string& what) {
    throw Error(ExitCode::device,
                fmt::format("kernel {} was launched {}", kernel_name(launch.kernel), what));
}

}  // namespace

std::span<const ArgumentInfo> kernel_arguments(KernelId kernel) {
    return signatures.at(static_cast<std::size_t>(kernel)).arguments;
}

bool kernel_traces(KernelId kernel) {
    return signatures.at(static_cast<std::size_t>(kernel)).traces;
}

std::optional<KernelId> kernel_of(std::string_view name) {
    for (std::size_t i = 0; i < signatures.size(); ++i)
        if (signatures.at(i).name == name) return static_cast<KernelId>(i);
    return {};
}

const LaunchArgument& argument_of(const Launch& launch, std::string_view name) {
    const std::span<const ArgumentInfo> declared = kernel_arguments(launch.kernel);
    for (std::size_t i = 0; i < declared.size() && i < launch.arguments.size(); ++i)
        if (declared[i].name == name) return launch.arguments[i];
    refuse(launch, fmt::format("without its argument {}", name));
}

void check_arguments(const Launch& launch) {
    const std::span<const ArgumentInfo> declared = kernel_arguments(launch.kernel);
    if ((launch.scene != nullptr) != kernel_traces(launch.kernel))
        refuse(launch, launch.scene != nullptr ? "with a scene, expected none"
                                               : "without the scene that it traces in");
    if (launch.arguments.size() != declared.size())
        refuse(launch, fmt::format("with {} arguments, expected {}", launch.arguments.size(),
                                   declared.size()));
    for (std::size_t i = 0; i < declared.size(); ++i) {
        const LaunchArgument& given = launch.arguments[i];
        if ((given.value != nullptr) != declared[i].is_value ||
            (declared[i].is_value && given.bytes != declared[i].bytes))
            refuse(launch, fmt::format("with something else as its argument {}, expected {}",
                                       declared[i].name,
                                       declared[i].is_value
                                           ? fmt::format("a value of {} bytes", declared[i].bytes)
                                           : "a buffer"));
    }
}

}  // namespace weft
