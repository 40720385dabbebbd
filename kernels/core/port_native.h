// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// C++ half of port.h. Included inside the namespace of one native variant, after the
// file that includes it has brought in the compiler's intrinsics.
#ifndef WEFT_KERNELS_CORE_PORT_NATIVE_H
#define WEFT_KERNELS_CORE_PORT_NATIVE_H

typedef unsigned int uint;
typedef unsigned char uchar;

#define GLOBAL
#define CONSTANT_TABLE static constexpr
#define CONSTANT_POINTER const
#define VALUE_ARGUMENT(type, name) const type& name
#define KERNEL_ENTRY static
// Has all that a kernel calls compiled into it, as OpenCL compilers do: a quarter faster where work
// is scalar, and slow to compile.
#define INLINES_ALL __attribute__((flatten))
#define GLOBAL_ID current_global_id
#define WORK_ITEM(range) GLOBAL_ID

static thread_local uint current_global_id;

struct float3 {
    float x, y, z;
};
struct alignas(16) float4 {
    float x, y, z, w;
};

static inline float3 f3(float x, float y, float z) {
    return float3{x, y, z};
}
static inline float4 f4(float x, float y, float z, float w) {
    return float4{x, y, z, w};
}
static inline float3 operator+(float3 a, float3 b) {
    return f3(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline float3 operator-(float3 a, float3 b) {
    return f3(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline float3 operator*(float3 a, float3 b) {
    return f3(a.x * b.x, a.y * b.y, a.z * b.z);
}
static inline float3 operator*(float3 a, float s) {
    return f3(a.x * s, a.y * s, a.z * s);
}
static inline float3 operator*(float s, float3 a) {
    return f3(s * a.x, s * a.y, s * a.z);
}
static inline float3 operator/(float3 a, float s) {
    return f3(a.x / s, a.y / s, a.z / s);
}
static inline float3 operator-(float3 a) {
    return f3(-a.x, -a.y, -a.z);
}
static inline float3& operator+=(float3& a, float3 b) {
    return a = a + b;
}
static inline float3& operator*=(float3& a, float3 b) {
    return a = a * b;
}

static inline uint as_bits(float f) {
    return __builtin_bit_cast(uint, f);
}
static inline float from_bits(uint u) {
    return __builtin_bit_cast(float, u);
}
static inline float square_root(float f) {
    return __builtin_sqrtf(f);
}
static inline float absolute(float f) {
    return __builtin_fabsf(f);
}

#define SELECT(mask, a, b) ((mask) ? (a) : (b))

template <int N>
struct WideOf {
    typedef float Float __attribute__((vector_size(4 * N)));
    typedef int Mask __attribute__((vector_size(4 * N)));
    typedef float Unaligned __attribute__((vector_size(4 * N), aligned(4), may_alias));
    typedef int Words __attribute__((vector_size(4 * N), aligned(4), may_alias));
};

template <int N>
static inline uint vector_mask_bits(typename WideOf<N>::Mask m) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
    if constexpr (N == 16) return static_cast<uint>(_mm512_movepi32_mask((__m512i)m));
#endif
#if defined(__AVX__)
    if constexpr (N == 8)
        return static_cast<uint>(_mm256_movemask_ps(_mm256_castsi256_ps((__m256i)m)));
#endif
#if defined(__SSE2__)
    uint bits = 0;
    __m128i part[N / 4];
    __builtin_memcpy(part, &m, sizeof(m));
    for (int i = 0; i < N / 4; ++i)
        bits |= static_cast<uint>(_mm_movemask_ps(_mm_castsi128_ps(part[i]))) << (4 * i);
    return bits;
#else
    uint bits = 0;
    for (int i = 0; i < N; ++i) bits |= (m[i] != 0 ? 1u : 0u) << i;
    return bits;
#endif
}

// Halves are compared with each other, lane by lane, until four lanes are left: as SELECT of
// port_opencl.h does it, so that NaN takes the same ways.
template <int N>
static inline float lowest_lane(typename WideOf<N>::Float v) {
    if constexpr (N == 4) {
        const float a = v[0] < v[2] ? v[0] : v[2];
        const float b = v[1] < v[3] ? v[1] : v[3];
        return a < b ? a : b;
    } else {
        typename WideOf<N / 2>::Float lanes[2];
        __builtin_memcpy(lanes, &v, sizeof(v));
        return lowest_lane<N / 2>(lanes[0] < lanes[1] ? lanes[0] : lanes[1]);
    }
}
template <int N>
static inline float highest_lane(typename WideOf<N>::Float v) {
    if constexpr (N == 4) {
        const float a = v[0] > v[2] ? v[0] : v[2];
        const float b = v[1] > v[3] ? v[1] : v[3];
        return a > b ? a : b;
    } else {
        typename WideOf<N / 2>::Float lanes[2];
        __builtin_memcpy(lanes, &v, sizeof(v));
        return highest_lane<N / 2>(lanes[0] > lanes[1] ? lanes[0] : lanes[1]);
    }
}

#if LANES == 1
typedef float WFloat;
typedef int WMask;
static inline WFloat WIDE(float x) {
    return x;
}
static inline WFloat wide_load(const float* p, uint i) {
    return p[i];
}
static inline void wide_store(WFloat v, float* p, uint i) {
    p[i] = v;
}
static inline WMask load_words(const uint* p, uint i) {
    return static_cast<WMask>(p[i]);
}
static inline void store_words(WMask v, uint* p, uint i) {
    p[i] = static_cast<uint>(v);
}
static inline uint mask_bits(WMask m) {
    return static_cast<uint>(m);
}
static inline WMask mask_of(uint bits) {
    return static_cast<WMask>(bits);
}
static inline bool mask_any(WMask m) {
    return m != 0;
}
static inline bool mask_all(WMask m) {
    return m != 0;
}
static inline WMask mask_not(WMask m) {
    return m == 0;
}
static inline uint mask_count(WMask m) {
    return static_cast<uint>(m);
}
static inline float wide_lowest(WFloat v) {
    return v;
}
static inline float wide_highest(WFloat v) {
    return v;
}
static inline WFloat wide_square_root(WFloat v) {
    return square_root(v);
}
static inline WFloat wide_power_of_two(WFloat n) {
    return from_bits(static_cast<uint>(static_cast<int>(n) + 127) << 23);
}
#define mask_none_set 0
#else
typedef WideOf<LANES>::Float WFloat;
typedef WideOf<LANES>::Mask WMask;
static inline WFloat WIDE(float x) {
    return x - WFloat{};
}
static inline WFloat wide_load(const float* p, uint i) {
    return *reinterpret_cast<const WideOf<LANES>::Unaligned*>(p + i);
}
static inline void wide_store(WFloat v, float* p, uint i) {
    *reinterpret_cast<WideOf<LANES>::Unaligned*>(p + i) = v;
}
static inline WMask load_words(const uint* p, uint i) {
    return *reinterpret_cast<const WideOf<LANES>::Words*>(p + i);
}
static inline void store_words(WMask v, uint* p, uint i) {
    *reinterpret_cast<WideOf<LANES>::Words*>(p + i) = v;
}
static inline uint mask_bits(WMask m) {
    return vector_mask_bits<LANES>(m);
}
static inline WMask mask_of(uint bits) {
    WMask bit;
    for (int i = 0; i < LANES; ++i) bit[i] = 1 << i;
    return (bit & static_cast<int>(bits)) != 0;
}
static inline bool mask_any(WMask m) {
    return mask_bits(m) != 0u;
}
static inline bool mask_all(WMask m) {
    return mask_bits(m) == (1u << LANES) - 1u;
}
static inline WMask mask_not(WMask m) {
    return ~m;
}
static inline uint mask_count(WMask m) {
    return static_cast<uint>(__builtin_popcount(mask_bits(m)));
}
static inline float wide_lowest(WFloat v) {
    return lowest_lane<LANES>(v);
}
static inline float wide_highest(WFloat v) {
    return highest_lane<LANES>(v);
}
static inline WFloat wide_square_root(WFloat v) {
    WFloat r;
    for (int i = 0; i < LANES; ++i) r[i] = square_root(v[i]);
    return r;
}
static inline WFloat wide_power_of_two(WFloat n) {
    return reinterpret_cast<WFloat>((__builtin_convertvector(n, WMask) + 127) << 23);
}
#define mask_none_set (WMask{})
#endif

// Words of 32 bits, one a lane (load_words); &, |, ^ and ~ only.
typedef WMask WWords;

typedef WideOf<NODE_WIDTH>::Float NFloat;
typedef WideOf<NODE_WIDTH>::Mask NMask;
static inline NFloat NODE(float x) {
    return x - NFloat{};
}
static inline NFloat node_load(const float* p) {
    return *reinterpret_cast<const WideOf<NODE_WIDTH>::Unaligned*>(p);
}
static inline void node_store(NFloat v, float* p) {
    *reinterpret_cast<WideOf<NODE_WIDTH>::Unaligned*>(p) = v;
}
static inline NFloat node_square_root(NFloat v) {
    NFloat r;
    for (int i = 0; i < NODE_WIDTH; ++i) r[i] = square_root(v[i]);
    return r;
}
static inline uint node_mask_bits(NMask m) {
    return vector_mask_bits<NODE_WIDTH>(m);
}
static inline uint lowest_bit(uint x) {
    return static_cast<uint>(__builtin_ctz(x));
}

#define PREFETCH(p) __builtin_prefetch(p)

static inline uint bit_count(uint x) {
    return static_cast<uint>(__builtin_popcount(x));
}

static inline uint atomic_add_uint(uint* p, uint x) {
    return __atomic_fetch_add(p, x, __ATOMIC_RELAXED);
}
static inline uint atomic_min_uint(uint* p, uint x) {
    uint seen = __atomic_load_n(p, __ATOMIC_RELAXED);
    while (x < seen &&
           !__atomic_compare_exchange_n(p, &seen, x, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
    return seen;
}

#endif
