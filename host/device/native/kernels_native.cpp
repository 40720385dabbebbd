// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The kernels as C++, of which one part is compiled at a time (WEFT_NATIVE_WORK, see kernels.def):
// PACKETS once per instruction set and number of lanes (WEFT_LANES), ITEMS once per instruction
// set. Each part lives in a namespace of its own, so that no code of one instruction set can be
// linked into another.
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "device/native/native_kernel.h"
#include "device/native/native_scene.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#define LANES WEFT_LANES

namespace WEFT_NATIVE_NAMESPACE {
namespace {

#include "kernels/core/kernel.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"

// The .cl files of this part: native_packets.def or native_items.def.
#define WEFT_TEXT_OF(word) #word
#define WEFT_TEXT(word) WEFT_TEXT_OF(word)
#include WEFT_TEXT(WEFT_NATIVE_KERNELS)

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

// An entry of kernels.def becomes WEFT_ENTRY(name) where the kernel is of this part. The word for
// the part is put together with the entry's: of the four, two are empty.
#define WEFT_ENTRY_OF_PACKETS_IN_PACKETS(name) WEFT_ENTRY(name)
#define WEFT_ENTRY_OF_ITEMS_IN_ITEMS(name) WEFT_ENTRY(name)
#define WEFT_ENTRY_OF_PACKETS_IN_ITEMS(name)
#define WEFT_ENTRY_OF_ITEMS_IN_PACKETS(name)
#define WEFT_ENTRY_OF(work, part) WEFT_ENTRY_OF_##work##_IN_##part
#define WEFT_ENTRY_HERE(work, part) WEFT_ENTRY_OF(work, part)
#define WEFT_KERNEL_ENTRY(name, chunk, work) WEFT_ENTRY_HERE(work, WEFT_NATIVE_WORK)(name)

#define WEFT_ENTRY(name)                                                             \
    static_assert(std::is_same_v<decltype(name), void(WEFT_KERNEL_ARGUMENTS(name))>, \
                  "kernel " #name " is not defined as signatures.h declares it");
#include "kernels/core/kernels.def"
#undef WEFT_ENTRY

constexpr weft::NativeKernel kernel_table[] = {
#define WEFT_ENTRY(name) {#name, &Adapter<&name>::run},
#include "kernels/core/kernels.def"
#undef WEFT_ENTRY
};

}  // namespace
}  // namespace WEFT_NATIVE_NAMESPACE

namespace weft {

/// The kernels of this part; declared where variants are listed.
std::span<const NativeKernel> WEFT_NATIVE_TABLE();
std::span<const NativeKernel> WEFT_NATIVE_TABLE() {
    return WEFT_NATIVE_NAMESPACE::kernel_table;
}

}  // namespace weft
