// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>

#define NATIVE_KERNELS "kernels/core/vector.h"
#include "tests/testing/native_kernels.h"

namespace {

using namespace native;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float tiny = std::numeric_limits<float>::denorm_min();
constexpr float huge = std::numeric_limits<float>::max();
constexpr long double pi = 3.14159265358979323846264338327950288L;

/// Distance of `got` from `exact` in units of the last place of `exact`.
double ulp_error(float got, long double exact) {
    const float rounded = static_cast<float>(exact);
    if (std::isnan(rounded)) return std::isnan(got) ? 0.0 : infinity;
    if (std::isnan(got)) return infinity;
    if (std::isinf(got) || std::isinf(rounded)) {
        // The exact value may lie just short of Inf.
        if (std::isinf(got) && std::isinf(rounded)) return got == rounded ? 0.0 : infinity;
        return std::abs(std::isinf(got) ? rounded : got) == huge ? 1.0 : infinity;
    }
    int exponent = 0;
    std::frexp(exact, &exponent);
    const int unit = exact == 0.0L ? -149 : std::max(exponent - 24, -149);
    return static_cast<double>(std::ldexp(std::abs(static_cast<long double>(got) - exact), -unit));
}

struct Worst {
    double error = -1.0;
    float x = 0.0f, y = 0.0f;

    void add(float got, long double exact, float at, float at_y = 0.0f) {
        const double e = ulp_error(got, exact);
        if (e > error) *this = Worst{e, at, at_y};
    }
};

/// Position of `x` among all floats in rising order; both zeros are 0.
std::int64_t rank_of(float x) {
    const std::int64_t magnitude = as_bits(x) & 0x7FFFFFFFu;
    return std::signbit(x) ? -magnitude : magnitude;
}

float of_rank(std::int64_t rank) {
    const float x = from_bits(static_cast<std::uint32_t>(rank < 0 ? -rank : rank));
    return rank < 0 ? -x : x;
}

/// Compares on every `stride`-th of the floats from low to high.
template <typename Function, typename Exact>
Worst sweep(float low, float high, Function function, Exact exact, int stride = 499) {
    Worst worst;
    for (std::int64_t rank = rank_of(low); rank <= rank_of(high); rank += stride) {
        const float x = of_rank(rank);
        worst.add(function(x), exact(x), x);
    }
    return worst;
}

#define EXPECT_WITHIN(worst, bound)                                         \
    do {                                                                    \
        const Worst w = (worst);                                            \
        EXPECT_GE(w.error, 0.0) << "nothing was compared";                  \
        EXPECT_LE(w.error, (bound)) << "at x = " << w.x << ", y = " << w.y; \
    } while (false)

bool same_bits(float a, float b) {
    return as_bits(a) == as_bits(b);
}

float sine(float x) {
    float s, c;
    m_sincos(x, &s, &c);
    return s;
}

float cosine(float x) {
    float s, c;
    m_sincos(x, &s, &c);
    return c;
}

/// A small generator of reproducible floats.
struct Random {
    std::uint64_t state = 1;

    std::uint32_t bits() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::uint32_t>(state >> 32);
    }
    float between(float low, float high) {
        return low + (high - low) * (static_cast<float>(bits() >> 8) * 0x1p-24f);
    }
    /// Any float but NaN.
    float any() {
        for (;;) {
            const float x = std::bit_cast<float>(bits());
            if (!std::isnan(x)) return x;
        }
    }
};

TEST(Maths, SincosIsWithinOneUlp) {
    EXPECT_WITHIN(sweep(-12800.0f, 12800.0f, sine, [](float x) { return sinl(x); }), 1.0);
    EXPECT_WITHIN(sweep(-12800.0f, 12800.0f, cosine, [](float x) { return cosl(x); }), 1.0);
}

TEST(Maths, SincosIsWithinOneUlpAtItsZeros) {
    Worst worst_sine, worst_cosine;
    for (int n = 1; n < 8149; ++n) {
        float x = static_cast<float>(n * (pi / 2));
        for (int step = 0; step < 3; ++step) x = std::nextafter(x, 0.0f);
        for (int step = 0; step < 7; ++step) {
            worst_sine.add(sine(x), sinl(x), x);
            worst_cosine.add(cosine(x), cosl(x), x);
            x = std::nextafter(x, infinity);
        }
    }
    EXPECT_WITHIN(worst_sine, 1.0);
    EXPECT_WITHIN(worst_cosine, 1.0);
}

TEST(Maths, SincosIsAUnitVectorForEveryFiniteInput) {
    double worst = 0.0;
    for (std::int64_t rank = rank_of(-huge); rank <= rank_of(huge); rank += 499) {
        const double s = sine(of_rank(rank)), c = cosine(of_rank(rank));
        worst = std::max(worst, std::abs(s * s + c * c - 1.0));
    }
    EXPECT_GT(worst, 0.0);
    EXPECT_LE(worst, 1.5e-7);
}

TEST(Maths, SincosOfSpecialValues) {
    EXPECT_TRUE(same_bits(sine(0.0f), 0.0f));
    EXPECT_TRUE(same_bits(sine(-0.0f), -0.0f));
    EXPECT_EQ(cosine(-0.0f), 1.0f);
    EXPECT_EQ(sine(tiny), tiny);
    EXPECT_TRUE(same_bits(sine(-1e30f), -0.0f));
    EXPECT_EQ(cosine(1e30f), 1.0f);
    for (float x : {infinity, -infinity, nan}) {
        EXPECT_TRUE(std::isnan(sine(x)));
        EXPECT_TRUE(std::isnan(cosine(x)));
    }
}

TEST(Maths, ExpIsWithinOneUlp) {
    EXPECT_WITHIN(sweep(-infinity, infinity, m_exp, [](float x) { return expl(x); }), 1.0);
    EXPECT_WITHIN(sweep(
                      -105.0f, -80.0f, m_exp, [](float x) { return expl(x); }, 7),
                  1.0);
    EXPECT_EQ(m_exp(0.0f), 1.0f);
    EXPECT_EQ(m_exp(-0.0f), 1.0f);
    EXPECT_EQ(m_exp(infinity), infinity);
    EXPECT_EQ(m_exp(88.73f), infinity);
    EXPECT_LT(m_exp(88.72f), infinity);
    EXPECT_TRUE(same_bits(m_exp(-infinity), 0.0f));
    EXPECT_TRUE(same_bits(m_exp(-104.0f), 0.0f));
    EXPECT_EQ(m_exp(-103.0f), tiny);
    EXPECT_TRUE(std::isnan(m_exp(nan)));
}

/// Whether the function never falls over some runs of adjacent floats within [low, high].
template <typename Function>
bool rises(float low, float high, Function function) {
    constexpr int runs = 500, run_length = 4000;
    const std::int64_t first = rank_of(low), last = rank_of(high);
    for (int run = 0; run < runs; ++run) {
        std::int64_t rank = first + (last - first - run_length) / (runs - 1) * run;
        float previous = function(of_rank(rank));
        for (int i = 0; i < run_length; ++i) {
            const float value = function(of_rank(++rank));
            if (value < previous) return false;
            previous = value;
        }
    }
    return true;
}

TEST(Maths, ExpAndLogNeverFall) {
    EXPECT_TRUE(rises(1e-8f, 89.0f, m_exp));
    EXPECT_TRUE(rises(-105.0f, -1e-8f, m_exp));
    EXPECT_TRUE(rises(-18.5f, 89.0f, m_expm1));
    EXPECT_TRUE(rises(tiny, infinity, m_log));
    EXPECT_TRUE(rises(-1.0f, infinity, m_log1p));
    EXPECT_FALSE(rises(0.1f, 1.0f, [](float x) { return -m_exp(x); }));
}

TEST(Maths, Expm1IsWithinOneAndAHalfUlp) {
    EXPECT_WITHIN(sweep(-infinity, infinity, m_expm1, [](float x) { return expm1l(x); }), 1.5);
    EXPECT_TRUE(same_bits(m_expm1(-0.0f), -0.0f));
    for (float x : {tiny, -tiny, 1e-38f, 1e-20f, -1e-20f}) EXPECT_EQ(m_expm1(x), x);
    EXPECT_EQ(m_expm1(-infinity), -1.0f);
    EXPECT_EQ(m_expm1(-18.5f), -1.0f);
    EXPECT_EQ(m_expm1(infinity), infinity);
    EXPECT_TRUE(std::isnan(m_expm1(nan)));
}

TEST(Maths, LogIsWithinOneUlp) {
    EXPECT_WITHIN(sweep(0.0f, infinity, m_log, [](float x) { return logl(x); }), 1.0);
    EXPECT_WITHIN(sweep(
                      0.5f, 2.0f, m_log, [](float x) { return logl(x); }, 11),
                  1.0);
    EXPECT_TRUE(same_bits(m_log(1.0f), 0.0f));
    EXPECT_EQ(m_log(0.0f), -infinity);
    EXPECT_EQ(m_log(-0.0f), -infinity);
    EXPECT_EQ(m_log(infinity), infinity);
    for (float x : {-tiny, -1.0f, -infinity, nan}) EXPECT_TRUE(std::isnan(m_log(x)));
}

TEST(Maths, Log1pIsWithinOneUlp) {
    EXPECT_WITHIN(sweep(-1.0f, infinity, m_log1p, [](float x) { return log1pl(x); }), 1.0);
    EXPECT_TRUE(same_bits(m_log1p(-0.0f), -0.0f));
    for (float x : {tiny, -tiny, 1e-38f, 1e-20f, -1e-20f}) EXPECT_EQ(m_log1p(x), x);
    EXPECT_EQ(m_log1p(-1.0f), -infinity);
    EXPECT_EQ(m_log1p(infinity), infinity);
    for (float x : {-1.0000001f, -infinity, nan}) EXPECT_TRUE(std::isnan(m_log1p(x)));
}

TEST(Maths, PowIsWithinOneUlp) {
    Random random;
    Worst worst;
    for (int i = 0; i < 2'000'000; ++i) {
        float x = std::abs(random.any()), y = random.any();
        if (i % 4 == 1) x = random.between(0.0f, 2.0f), y = random.between(-200.0f, 200.0f);
        if (i % 4 == 2) x = random.between(0.9999f, 1.0001f), y = random.between(-1e6f, 1e6f);
        if (i % 4 == 3) x = random.between(0.0f, 100.0f), y = random.between(-3.0f, 3.0f);
        worst.add(m_pow(x, y), powl(x, y), x, y);
    }
    EXPECT_WITHIN(worst, 1.0);
}

TEST(Maths, PowOfOneIsExactAndSpecialValuesAreDefined) {
    EXPECT_WITHIN(sweep(
                      0.0f, infinity, [](float x) { return m_pow(x, 1.0f); },
                      [](float x) { return static_cast<long double>(x); }),
                  0.0);
    for (float x : {0.0f, tiny, 1.0f, huge, infinity, nan}) EXPECT_EQ(m_pow(x, 0.0f), 1.0f);
    for (float y : {-infinity, -1.0f, infinity, nan}) EXPECT_EQ(m_pow(1.0f, y), 1.0f);
    for (float y : {-infinity, -huge, -0.5f, 0.5f, 3.0f, huge, infinity}) {
        for (float x : {0.0f, tiny, 0.5f, 2.0f, huge, infinity}) {
            EXPECT_LE(ulp_error(m_pow(x, y), powl(x, y)), 1.0) << x << "^" << y;
        }
    }
    EXPECT_EQ(m_pow(-0.0f, 2.0f), 0.0f);
    EXPECT_TRUE(std::isnan(m_pow(-1.0f, 2.0f)));
    EXPECT_TRUE(std::isnan(m_pow(nan, 2.0f)));
    EXPECT_TRUE(std::isnan(m_pow(2.0f, nan)));
}

TEST(Maths, Atan2IsWithinTwoAndAHalfUlp) {
    for (float x : {1.0f, -1.0f, 3e38f, 1e-40f}) {
        EXPECT_WITHIN(sweep(
                          -infinity, infinity, [x](float y) { return m_atan2(y, x); },
                          [x](float y) { return atan2l(y, x); }, 997),
                      2.5);
    }
    Random random;
    Worst worst;
    for (int i = 0; i < 2'000'000; ++i) {
        const float scale = std::ldexp(1.0f, static_cast<int>(random.bits() % 250) - 125);
        const float x = i % 2 == 0 ? random.any() : scale * random.between(-1.0f, 1.0f);
        const float y = i % 2 == 0 ? random.any() : scale * random.between(-1.0f, 1.0f);
        worst.add(m_atan2(y, x), atan2l(y, x), x, y);
    }
    EXPECT_WITHIN(worst, 2.5);
}

TEST(Maths, Atan2OfSpecialValues) {
    for (float y : {0.0f, tiny, 1.0f, huge, infinity}) {
        for (float x : {0.0f, tiny, 1.0f, huge, infinity}) {
            for (int signs = 0; signs < 4; ++signs) {
                const float sy = (signs & 1) != 0 ? -y : y, sx = (signs & 2) != 0 ? -x : x;
                const float got = m_atan2(sy, sx);
                EXPECT_LE(ulp_error(got, atan2l(sy, sx)), 1.0) << sy << " " << sx;
                EXPECT_EQ(std::signbit(got), std::signbit(sy));
            }
        }
    }
    EXPECT_TRUE(std::isnan(m_atan2(nan, 1.0f)));
    EXPECT_TRUE(std::isnan(m_atan2(1.0f, nan)));
}

TEST(Maths, AsinAndAcosAreWithinThreeUlpAndClamp) {
    EXPECT_WITHIN(sweep(-1.0f, 1.0f, m_asin, [](float x) { return asinl(x); }), 3.0);
    EXPECT_WITHIN(sweep(-1.0f, 1.0f, m_acos, [](float x) { return acosl(x); }), 3.0);
    EXPECT_WITHIN(sweep(
                      0.99f, 1.0f, m_acos, [](float x) { return acosl(x); }, 1),
                  3.0);
    EXPECT_TRUE(same_bits(m_asin(-0.0f), -0.0f));
    EXPECT_EQ(m_asin(2.0f), m_asin(1.0f));
    EXPECT_TRUE(same_bits(m_acos(1.0f), 0.0f));
    EXPECT_TRUE(same_bits(m_acos(infinity), 0.0f));
    EXPECT_EQ(m_acos(-1.5f), M_ONE_PI);
    EXPECT_TRUE(std::isnan(m_asin(nan)));
    EXPECT_TRUE(std::isnan(m_acos(nan)));
}

TEST(Maths, FloorMinMaxClamp) {
    for (std::int64_t rank = rank_of(-infinity); rank <= rank_of(infinity); rank += 499) {
        const float x = of_rank(rank);
        ASSERT_TRUE(same_bits(m_floor(x), std::floor(x))) << x;
    }
    EXPECT_TRUE(std::isnan(m_floor(nan)));
    for (float x : {-0.0f, -1.0f, -0.5f, 0.99999994f, 8388607.5f, -8388607.5f}) {
        EXPECT_TRUE(same_bits(m_floor(x), std::floor(x))) << x;
    }
    EXPECT_EQ(m_min(1.0f, 2.0f), 1.0f);
    EXPECT_EQ(m_max(1.0f, 2.0f), 2.0f);
    EXPECT_EQ(m_min(nan, 2.0f), 2.0f);
    EXPECT_EQ(m_max(nan, 2.0f), 2.0f);
    EXPECT_EQ(m_clamp(5.0f, 0.0f, 1.0f), 1.0f);
    EXPECT_EQ(m_clamp(-5.0f, 0.0f, 1.0f), 0.0f);
    EXPECT_EQ(m_clamp(0.5f, 0.0f, 1.0f), 0.5f);
    EXPECT_EQ(m_clamp(nan, 0.25f, 1.0f), 0.25f);
}

}  // namespace
