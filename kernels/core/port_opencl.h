// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// OpenCL C half of port.h.
#ifndef WEFT_KERNELS_CORE_PORT_OPENCL_H
#define WEFT_KERNELS_CORE_PORT_OPENCL_H

#pragma OPENCL FP_CONTRACT OFF

#ifndef LOCAL_SIZE
#define LOCAL_SIZE 8
#endif

#define GLOBAL __global
#define CONSTANT_TABLE __constant
#define CONSTANT_POINTER __constant
#define VALUE_ARGUMENT(type, name) const type name
#define KERNEL_ENTRY __kernel __attribute__((reqd_work_group_size(LOCAL_SIZE, 1, 1)))
#define INLINES_ALL
#define GLOBAL_ID ((uint)get_global_id(0))
// Which item of its range a work-item takes. A launch of few items starts a work group for each.
// Drivers for processors give each thread groups that are neighbours, so that a longer launch that
// leaves groups without items would keep few threads busy: work group g takes the items of group
// (g * spread) mod (number of groups).
#define GROUP_RANK(range) ((uint)get_group_id(0) * (range).spread % (uint)get_num_groups(0))
#define WORK_ITEM(range)                                                       \
    ((range).count <= (uint)get_num_groups(0)                                  \
         ? GROUP_RANK(range) + (uint)get_local_id(0) * (uint)get_num_groups(0) \
         : GROUP_RANK(range) * (uint)LOCAL_SIZE + (uint)get_local_id(0))

#define f3(x, y, z) ((float3)((x), (y), (z)))
#define f4(x, y, z, w) ((float4)((x), (y), (z), (w)))
#define as_bits(f) as_uint(f)
#define from_bits(u) as_float(u)
#define square_root(f) sqrt(f)
#define absolute(f) fabs(f)

// Words of 32 bits, one a lane (load_words); &, |, ^ and ~ only.
#define WWords WMask

// Built-in select() takes the second value where the mask is set; for scalars where it is not 0.
#define SELECT(mask, a, b) select((b), (a), (mask))

#if LANES == 1
typedef float WFloat;
typedef int WMask;
#define WIDE(x) ((float)(x))
#define wide_load(p, i) ((p)[i])
#define wide_store(v, p, i) ((p)[i] = (v))
#define load_words(p, i) ((int)(p)[i])
#define store_words(v, p, i) ((p)[i] = (uint)(v))
#define mask_any(m) ((m) != 0)
#define mask_all(m) ((m) != 0)
#define mask_not(m) ((m) == 0)
#define mask_none_set 0
#define wide_lowest(v) (v)
#define wide_highest(v) (v)
#define mask_bits(m) ((uint)(m))
#define mask_of(bits) ((int)(bits))
#define mask_count(m) ((uint)(m))
#define wide_power_of_two(n) as_float(((int)(n) + 127) << 23)
#elif LANES == 4
typedef float4 WFloat;
typedef int4 WMask;
#define WIDE(x) ((float4)(x))
#define wide_load(p, i) vload4(0, (p) + (i))
#define wide_store(v, p, i) vstore4((v), 0, (p) + (i))
#define load_words(p, i) as_int4(vload4(0, (p) + (i)))
#define store_words(v, p, i) vstore4(as_uint4(v), 0, (p) + (i))
#define wide_power_of_two(n) as_float4((convert_int4(n) + 127) << 23)
#define mask_none_set ((int4)(0))
#elif LANES == 8
typedef float8 WFloat;
typedef int8 WMask;
#define WIDE(x) ((float8)(x))
#define wide_load(p, i) vload8(0, (p) + (i))
#define wide_store(v, p, i) vstore8((v), 0, (p) + (i))
#define load_words(p, i) as_int8(vload8(0, (p) + (i)))
#define store_words(v, p, i) vstore8(as_uint8(v), 0, (p) + (i))
#define wide_power_of_two(n) as_float8((convert_int8(n) + 127) << 23)
#define mask_none_set ((int8)(0))
#elif LANES == 16
typedef float16 WFloat;
typedef int16 WMask;
#define WIDE(x) ((float16)(x))
#define wide_load(p, i) vload16(0, (p) + (i))
#define wide_store(v, p, i) vstore16((v), 0, (p) + (i))
#define load_words(p, i) as_int16(vload16(0, (p) + (i)))
#define store_words(v, p, i) vstore16(as_uint16(v), 0, (p) + (i))
#define wide_power_of_two(n) as_float16((convert_int16(n) + 127) << 23)
#define mask_none_set ((int16)(0))
#else
#error "LANES must be 1, 4, 8 or 16"
#endif

// Compilers based on clang offer what x86 processors can do and OpenCL C has no name for: telling
// which lanes are set, and asking for memory ahead.
#if defined(__clang__) && defined(__AVX__)
#define X86_BUILTINS
#endif

#ifdef X86_BUILTINS
#define bits_of_8(m) ((uint)__builtin_ia32_movmskps256(as_float8(m)))
#else
static inline uint bits_of_8(int8 m) {
    int8 bit = m & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    int4 a = bit.lo | bit.hi;
    int2 b = a.lo | a.hi;
    return (uint)(b.x | b.y);
}
#endif

#if LANES > 1
#define mask_not(m) (~(m))
#define mask_any(m) (mask_bits(m) != 0u)
#define mask_all(m) (mask_bits(m) == (1u << LANES) - 1u)
#define mask_count(m) popcount(mask_bits(m))

/// One bit per lane, lane 0 in bit 0.
static inline uint mask_bits(WMask m) {
#if LANES == 4
    int4 bit = m & (int4)(1, 2, 4, 8);
    int2 b = bit.lo | bit.hi;
    return (uint)(b.x | b.y);
#elif LANES == 8
    return bits_of_8(m);
#elif defined(X86_BUILTINS) && defined(__AVX512DQ__)
    return (uint)__builtin_ia32_cvtd2mask512(m) & 0xFFFFu;
#else
    return bits_of_8(m.lo) | bits_of_8(m.hi) << 8;
#endif
}

static inline float lowest_of_4(float4 v) {
    float2 h = select(v.hi, v.lo, v.lo < v.hi);
    return h.x < h.y ? h.x : h.y;
}
static inline float highest_of_4(float4 v) {
    float2 h = select(v.hi, v.lo, v.lo > v.hi);
    return h.x > h.y ? h.x : h.y;
}

/// The mask with these lanes set; see mask_bits.
static inline WMask mask_of(uint bits) {
#if LANES == 4
    return ((int4)((int)bits) & (int4)(1, 2, 4, 8)) != 0;
#elif LANES == 8
    return ((int8)((int)bits) & (int8)(1, 2, 4, 8, 16, 32, 64, 128)) != 0;
#else
    return ((int16)((int)bits) & (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096,
                                         8192, 16384, 32768)) != 0;
#endif
}

/// Smallest lane.
static inline float wide_lowest(WFloat v) {
#if LANES == 16
    float8 a = select(v.hi, v.lo, v.lo < v.hi);
    return lowest_of_4(select(a.hi, a.lo, a.lo < a.hi));
#elif LANES == 8
    return lowest_of_4(select(v.hi, v.lo, v.lo < v.hi));
#else
    return lowest_of_4(v);
#endif
}

/// Largest lane.
static inline float wide_highest(WFloat v) {
#if LANES == 16
    float8 a = select(v.hi, v.lo, v.lo > v.hi);
    return highest_of_4(select(a.hi, a.lo, a.lo > a.hi));
#elif LANES == 8
    return highest_of_4(select(v.hi, v.lo, v.lo > v.hi));
#else
    return highest_of_4(v);
#endif
}
#endif

#ifdef X86_BUILTINS
#define PREFETCH(p) __builtin_prefetch((const void*)(size_t)(p))
#else
#define PREFETCH(p) ((void)(p))
#endif

#define bit_count(x) popcount(x)
#define wide_square_root(v) sqrt(v)

typedef float8 NFloat;
typedef int8 NMask;
#define NODE(x) ((float8)(x))
#define node_load(p) vload8(0, (p))
#define node_store(v, p) vstore8((v), 0, (p))
#define node_square_root(v) sqrt(v)

/// One bit per child, child 0 in bit 0.
#define node_mask_bits(m) bits_of_8(m)

/// Index of the lowest set bit; `x` is not 0.
static inline uint lowest_bit(uint x) {
#ifdef X86_BUILTINS
    return (uint)__builtin_ctz(x);
#else
    return 31u - clz(x & (0u - x));
#endif
}

#define atomic_add_uint(p, x) atomic_add((p), (x))
#define atomic_min_uint(p, x) atomic_min((p), (x))

#endif
