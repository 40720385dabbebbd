// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/native/native_variants.h"

#include <fmt/format.h>

#include <string_view>

#include "base/error.h"

namespace weft {

#define WEFT_NATIVE_VARIANT(isa, lanes, function) const NativeVariant& function();
#include "native_variants.def"
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

}  // namespace

std::vector<IsaVariant> runnable_variants() {
    std::vector<IsaVariant> variants;
#define WEFT_NATIVE_VARIANT(isa, lanes, function) \
    if (processor_runs(#isa)) variants.push_back({#isa, &function()});
#include "native_variants.def"
#undef WEFT_NATIVE_VARIANT
    return variants;
}

IsaVariant choose_variant(std::uint32_t lanes) {
    const std::vector<IsaVariant> variants = runnable_variants();
    std::uint32_t wanted = lanes;
    if (wanted == 0) {
        // The base instruction set is compiled at every width; its vectors hold 4 floats.
        wanted = 4;
        for (const IsaVariant& variant : variants)
            if (variant.isa != "base") wanted = static_cast<std::uint32_t>(variant.kernels->lanes);
    }
    IsaVariant chosen{{}, nullptr};
    for (const IsaVariant& variant : variants)
        if (variant.kernels->lanes == static_cast<int>(wanted)) chosen = variant;
    if (chosen.kernels == nullptr)
        throw Error(ExitCode::device,
                    fmt::format("no native kernels are compiled for {} lanes", wanted));
    return chosen;
}

}  // namespace weft
