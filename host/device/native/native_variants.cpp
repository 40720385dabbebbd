// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/native/native_variants.h"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "device/kernel_signature.h"

namespace weft {

#define WEFT_NATIVE_ITEMS(isa, items) std::span<const NativeKernel> items();
#define WEFT_NATIVE_VARIANT(isa, lanes, items, packets) std::span<const NativeKernel> packets();
#include "native_variants.def"
#undef WEFT_NATIVE_ITEMS
#undef WEFT_NATIVE_VARIANT

namespace {

bool processor_runs(std::string_view isa) {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (isa == "x86_64_v4")
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
    if (isa == "x86_64_v3")
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
               __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
#endif
    return isa != "x86_64_v3" && isa != "x86_64_v4";
}

/// The kernels of both parts in the order of KernelId; each is in one of them.
std::vector<NativeKernel> in_order(std::span<const NativeKernel> items,
                                   std::span<const NativeKernel> packets) {
    std::vector<NativeKernel> kernels(items.size() + packets.size());
    for (const std::span<const NativeKernel> part : {items, packets})
        for (const NativeKernel& kernel : part)
            kernels.at(static_cast<std::size_t>(kernel_of(kernel.name).value())) = kernel;
    return kernels;
}

}  // namespace

std::vector<NativeVariant> runnable_variants() {
    std::vector<NativeVariant> variants;
#define WEFT_NATIVE_ITEMS(isa, items)
#define WEFT_NATIVE_VARIANT(isa, lanes, items, packets) \
    if (processor_runs(#isa)) variants.push_back({#isa, lanes, in_order(items(), packets())});
#include "native_variants.def"
#undef WEFT_NATIVE_ITEMS
#undef WEFT_NATIVE_VARIANT
    return variants;
}

NativeVariant choose_variant(std::uint32_t lanes) {
    std::vector<NativeVariant> variants = runnable_variants();
    std::uint32_t wanted = lanes;
    if (wanted == 0) {
        // The base instruction set is compiled at every width; its vectors hold 4 floats.
        wanted = 4;
        for (const NativeVariant& variant : variants)
            if (variant.isa != "base") wanted = variant.lanes;
    }
    NativeVariant* chosen = nullptr;
    for (NativeVariant& variant : variants)
        if (variant.lanes == wanted) chosen = &variant;
    if (chosen == nullptr)
        throw Error(ExitCode::device,
                    fmt::format("no native kernels are compiled for {} lanes", wanted));
    return std::move(*chosen);
}

}  // namespace weft
