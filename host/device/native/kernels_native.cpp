// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The kernels as C++. Compiled once per instruction set and packet width (WEFT_LANES), each in a
// namespace of its own, so that no code of one instruction set can be linked into another.
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>
#include <utility>

#include "device/native/native_scene.h"
#include "device/native/native_variant.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#define LANES WEFT_LANES

namespace WEFT_NATIVE_NAMESPACE {
namespace {

#include "kernels/core/kernel.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"

// Every .cl file of kernels/.
#include "native_kernels.def"

template <class T>
constexpr bool is_buffer = std::is_pointer_v<T>;

template <class T>
inline T take(const void* argument) {
    if constexpr (is_buffer<T>)
        return static_cast<T>(const_cast<void*>(argument));
    else
        return *static_cast<const std::remove_cvref_t<T>*>(argument);
}

/// Adapts a kernel function to the untyped entry of NativeKernel.
template <auto Function>
struct Adapter;

template <class... Arguments, void (*Function)(Arguments...)>
struct Adapter<Function> {
    static void run(const void* const* values, std::uint32_t begin, std::uint32_t end) {
        run_with(values, begin, end, std::index_sequence_for<Arguments...>{});
    }

    template <std::size_t... I>
    static void run_with(const void* const* values, std::uint32_t begin, std::uint32_t end,
                         std::index_sequence<I...>) {
        for (std::uint32_t item = begin; item < end; ++item) {
            current_global_id = item;
            Function(take<Arguments>(values[I])...);
        }
    }
};

#define WEFT_KERNEL_ENTRY(name, chunk)                                               \
    static_assert(std::is_same_v<decltype(name), void(WEFT_KERNEL_ARGUMENTS(name))>, \
                  "kernel " #name " is not defined as signatures.h declares it");
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY

constexpr weft::NativeKernel kernel_table[] = {
#define WEFT_KERNEL_ENTRY(name, chunk) {#name, &Adapter<&name>::run},
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY
};

}  // namespace
}  // namespace WEFT_NATIVE_NAMESPACE

namespace weft {

/// This variant's kernels; declared where variants are listed.
const NativeVariant& WEFT_NATIVE_TABLE();
const NativeVariant& WEFT_NATIVE_TABLE() {
    static const NativeVariant variant{WEFT_LANES, WEFT_NATIVE_NAMESPACE::kernel_table,
                                       std::size(WEFT_NATIVE_NAMESPACE::kernel_table)};
    return variant;
}

}  // namespace weft
