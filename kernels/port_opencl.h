// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// OpenCL C half of port.h.
#ifndef WEFT_PORT_OPENCL_H
#define WEFT_PORT_OPENCL_H

#pragma OPENCL FP_CONTRACT OFF

#ifndef LOCAL_SIZE
#define LOCAL_SIZE 8
#endif

#define GLOBAL __global
#define CONSTANT_TABLE __constant
#define PARAMS const Params params
#define WEFT_KERNEL(name) __kernel __attribute__((reqd_work_group_size(LOCAL_SIZE, 1, 1))) void name
#define GLOBAL_ID ((uint)get_global_id(0))

#define f3(x, y, z) ((float3)((x), (y), (z)))
#define f4(x, y, z, w) ((float4)((x), (y), (z), (w)))
#define as_bits(f) as_uint(f)
#define from_bits(u) as_float(u)
#define square_root(f) sqrt(f)
#define absolute(f) fabs(f)

// Built-in select() takes the second value where the mask is set; for scalars where it is not 0.
#define SELECT(mask, a, b) select((b), (a), (mask))

#if LANES == 1
typedef float WFloat;
typedef int WMask;
#define WIDE(x) ((float)(x))
#define wide_load(p, i) ((p)[i])
#define wide_store(v, p, i) ((p)[i] = (v))
#define mask_any(m) ((m) != 0)
#define mask_all(m) ((m) != 0)
#define mask_not(m) ((m) == 0)
#define mask_none_set 0
#define wide_lowest(v) (v)
#define wide_highest(v) (v)
#define mask_count(m) ((uint)(m))
#elif LANES == 4
typedef float4 WFloat;
typedef int4 WMask;
#define WIDE(x) ((float4)(x))
#define wide_load(p, i) vload4(0, (p) + (i))
#define wide_store(v, p, i) vstore4((v), 0, (p) + (i))
#define mask_none_set ((int4)(0))
#elif LANES == 8
typedef float8 WFloat;
typedef int8 WMask;
#define WIDE(x) ((float8)(x))
#define wide_load(p, i) vload8(0, (p) + (i))
#define wide_store(v, p, i) vstore8((v), 0, (p) + (i))
#define mask_none_set ((int8)(0))
#elif LANES == 16
typedef float16 WFloat;
typedef int16 WMask;
#define WIDE(x) ((float16)(x))
#define wide_load(p, i) vload16(0, (p) + (i))
#define wide_store(v, p, i) vstore16((v), 0, (p) + (i))
#define mask_none_set ((int16)(0))
#else
#error "LANES must be 1, 4, 8 or 16"
#endif

#if LANES > 1
#define mask_any(m) any(m)
#define mask_all(m) all(m)
#define mask_not(m) (~(m))

static inline float lowest_of_4(float4 v) {
    float2 h = select(v.hi, v.lo, v.lo < v.hi);
    return h.x < h.y ? h.x : h.y;
}
static inline float highest_of_4(float4 v) {
    float2 h = select(v.hi, v.lo, v.lo > v.hi);
    return h.x > h.y ? h.x : h.y;
}
static inline uint sum_of_4(int4 v) {
    int2 h = v.lo + v.hi;
    return (uint)(h.x + h.y);
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

/// Number of lanes that are set.
static inline uint mask_count(WMask m) {
#if LANES == 16
    int8 a = (m & 1).lo + (m & 1).hi;
    return sum_of_4(a.lo + a.hi);
#elif LANES == 8
    return sum_of_4((m & 1).lo + (m & 1).hi);
#else
    return sum_of_4(m & 1);
#endif
}
#endif

#define wide_square_root(v) sqrt(v)

typedef float8 NFloat;
typedef int8 NMask;
#define NODE(x) ((float8)(x))
#define node_load(p) vload8(0, (p))
#define node_store(v, p) vstore8((v), 0, (p))

/// One bit per child, child 0 in bit 0.
static inline uint node_mask_bits(NMask m) {
    int8 bit = m & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    int4 a = bit.lo | bit.hi;
    int2 b = a.lo | a.hi;
    return (uint)(b.x | b.y);
}

/// Index of the lowest set bit; `x` is not 0.
static inline uint lowest_bit(uint x) {
    return 31u - clz(x & (0u - x));
}

#define atomic_add_uint(p, x) atomic_add((p), (x))
#define atomic_min_uint(p, x) atomic_min((p), (x))

#endif
