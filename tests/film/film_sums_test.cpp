// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/film_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

#define NATIVE_KERNELS "kernels/film/film_sums.h"
#include "tests/testing/native_kernels.h"

// The film's sums against other integer arithmetic on the host, and what is made of them against
// double precision.
namespace weft::film_sums_test {
namespace {

__extension__ typedef unsigned __int128 Wide;

/// round(value * 2^shift), halves away from zero, modulo 2^128.
Wide fixed(float value, int shift) {
    int exponent = 0;
    const double scaled = std::ldexp(std::abs(static_cast<double>(value)), shift);
    const double fraction = std::frexp(std::round(scaled), &exponent);
    // Exact: the value has 24 bits, and no more of them are left after rounding.
    const auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
    Wide magnitude = 0;
    if (exponent >= 53 + 128)
        magnitude = 0;
    else if (exponent >= 53)
        magnitude = Wide{mantissa} << (exponent - 53);
    else
        magnitude = mantissa >> (53 - exponent);
    return std::signbit(value) ? Wide{0} - magnitude : magnitude;
}

/// Any finite float, each exponent as often.
float any_float(std::mt19937& random) {
    for (;;) {
        const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (std::isfinite(value)) return value;
    }
}

Wide wide_of(const std::uint32_t* words, std::size_t count) {
    Wide result = 0;
    for (std::size_t k = count; k-- > 0;) result = (result << 32) | words[k];
    return result;
}

Wide low_bits(Wide value, std::size_t words) {
    return words == 4 ? value : value & ((Wide{1} << (32 * words)) - 1);
}

TEST(FilmSums, AddingIsExact) {
    std::mt19937 random(1);
    for (const auto& [count, shift] :
         {std::pair<std::uint32_t, int>{FILM_SUM_WORDS, FILM_SUM_SHIFT},
          std::pair<std::uint32_t, int>{FILM_SQUARE_WORDS, FILM_SQUARE_SHIFT},
          std::pair<std::uint32_t, int>{FILM_SUM_WORDS, 0}}) {
        std::array<std::uint32_t, 6> words{};
        Wide expected = 0;
        for (int i = 0; i < 1'000'000; ++i) {
            const float value = any_float(random);
            native::add_to_sum(words.data() + 1, count, value, shift);
            expected = low_bits(expected + fixed(value, shift), count);
            ASSERT_TRUE(wide_of(words.data() + 1, count) == expected) << value << " at " << i;
        }
        for (std::size_t i = 0; i < words.size(); ++i)
            ASSERT_TRUE((i >= 1 && i <= count) || words[i] == 0) << "beside the sum";
    }
}

TEST(FilmSums, SingleValues) {
    const auto sum_of = [](float value) {
        std::array<std::uint32_t, FILM_SUM_WORDS> words{};
        native::add_to_sum(words.data(), FILM_SUM_WORDS, value, FILM_SUM_SHIFT);
        return wide_of(words.data(), FILM_SUM_WORDS);
    };
    const Wide unit = Wide{1} << 52;
    EXPECT_TRUE(sum_of(1.0F) == unit);
    EXPECT_TRUE(sum_of(-1.0F) == low_bits(Wide{0} - unit, FILM_SUM_WORDS));
    EXPECT_TRUE(sum_of(0.0F) == 0 && sum_of(-0.0F) == 0);
    EXPECT_TRUE(sum_of(0x1p-52F) == 1);
    EXPECT_TRUE(sum_of(0x1p-53F) == 1) << "a half is rounded up";
    EXPECT_TRUE(sum_of(0x1.fffffep-54F) == 0) << "less is not";
    EXPECT_TRUE(sum_of(-0x1p-53F) == low_bits(Wide{0} - 1, FILM_SUM_WORDS));
    EXPECT_TRUE(sum_of(0x1.8p-52F) == 2);
    EXPECT_TRUE(sum_of(std::numeric_limits<float>::denorm_min()) == 0);
    EXPECT_TRUE(sum_of(0x1.fffffep+42F) == Wide{0xFFFFFF} << (43 + 52 - 24)) << "the largest";
    // A carry through all words, forth and back.
    std::array<std::uint32_t, 3> words{0xFFFFFFFF, 0xFFFFFFFF, 0};
    native::add_to_sum(words.data(), 3, 1.0F, 0);
    EXPECT_EQ(words, (std::array<std::uint32_t, 3>{0, 0, 1}));
    native::add_to_sum(words.data(), 3, -1.0F, 0);
    EXPECT_EQ(words, (std::array<std::uint32_t, 3>{0xFFFFFFFF, 0xFFFFFFFF, 0}));
}

TEST(FilmSums, OrderDoesNotMatter) {
    std::mt19937 random(2);
    std::vector<float> values;
    for (int i = 0; i < 10'000; ++i) values.push_back(any_float(random));
    std::vector<std::array<std::uint32_t, 3>> results;
    for (int order = 0; order < 10; ++order) {
        std::array<std::uint32_t, 3> words{};
        for (const float value : values) native::add_to_sum(words.data(), 3, value, 52);
        results.push_back(words);
        std::shuffle(values.begin(), values.end(), random);
    }
    for (const auto& result : results) EXPECT_EQ(result, results.front());
    // And what is added is taken away again.
    std::array<std::uint32_t, 3> words = results.front();
    for (const float value : values) native::add_to_sum(words.data(), 3, -value, 52);
    EXPECT_EQ(words, (std::array<std::uint32_t, 3>{}));
}

constexpr std::uint32_t width = 5;
constexpr std::uint32_t height = 3;
constexpr std::size_t pixels = std::size_t{width} * height;

/// Values of one sample of one pixel by film plane, beauty being the sum of the first nine.
using Sample = std::array<float, FILM_PLANES>;

/// Makes sample `index` of a pixel: light of a wide range, normals of either sign.
Sample sample_of(std::size_t pixel, std::uint32_t index) {
    std::mt19937 random(static_cast<std::uint32_t>(pixel * 1000 + index));
    Sample sample{};
    const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
    for (std::size_t plane = 0; plane < FILM_PLANES; ++plane) {
        sample[plane] = uniform();
        if (plane < FILM_ALBEDO) sample[plane] *= std::exp2(20.0F * uniform() - 12.0F);
        if (plane >= FILM_NORMAL && plane < FILM_DEPTH) sample[plane] = 2.0F * uniform() - 1.0F;
        if (plane == FILM_DEPTH) sample[plane] *= 1000.0F;
    }
    return sample;
}

float beauty_of(const Sample& sample, std::size_t channel) {
    return sample[FILM_EMISSION + channel] + sample[FILM_DIRECT + channel] +
           sample[FILM_INDIRECT + channel];
}

FilmSums empty_sums() {
    FilmSums sums;
    sums.width = width;
    sums.height = height;
    sums.identity = "an image";
    sums.words.assign(FILM_PIXEL_WORDS * pixels, 0);
    return sums;
}

void add_sample(FilmSums& sums, std::size_t pixel, const Sample& sample) {
    std::uint32_t* const words = sums.words.data() + pixel * FILM_PIXEL_WORDS;
    for (std::size_t plane = 0; plane < FILM_PLANES; ++plane)
        native::add_to_sum(words + plane * FILM_SUM_WORDS, FILM_SUM_WORDS, sample[plane],
                           FILM_SUM_SHIFT);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const float value = beauty_of(sample, channel);
        native::add_to_sum(words + FILM_PLANES * FILM_SUM_WORDS + channel * FILM_SQUARE_WORDS,
                           FILM_SQUARE_WORDS, value * value, FILM_SQUARE_SHIFT);
    }
}

FilmSums sums_of_samples(SampleRange range) {
    FilmSums sums = empty_sums();
    sums.ranges = {range};
    for (std::uint32_t index = range.first; index < range.end; ++index)
        for (std::size_t pixel = 0; pixel < pixels; ++pixel)
            add_sample(sums, pixel, sample_of(pixel, index));
    return sums;
}

/// That `use` throws an Error with exit code 2.
template <class Use>
void expect_refused(const Use& use) {
    try {
        use();
        FAIL() << "was not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST(FilmSums, PartsAddUpToTheWholeInAnyOrder) {
    const FilmSums whole = sums_of_samples({0, 60});
    const FilmSums parts[] = {sums_of_samples({0, 7}), sums_of_samples({7, 40}),
                              sums_of_samples({40, 60})};
    std::array<int, 3> order{0, 1, 2};
    do {
        FilmSums sum = parts[order[0]];
        add_sums(sum, parts[order[1]]);
        add_sums(sum, parts[order[2]]);
        EXPECT_EQ(sum.words, whole.words);
        EXPECT_EQ(sum.ranges, whole.ranges);
        EXPECT_EQ(sum.samples(), 60U);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(FilmSums, PartsOfDifferentImagesOrSharedSamplesAreRefused) {
    const FilmSums part = sums_of_samples({10, 20});
    for (const SampleRange range : {SampleRange{10, 20}, SampleRange{0, 11}, SampleRange{19, 30},
                                    SampleRange{12, 13}, SampleRange{0, 100}}) {
        FilmSums whole = empty_sums();
        whole.ranges = {range};
        const FilmSums before = whole;
        expect_refused([&] { add_sums(whole, part); });
        EXPECT_EQ(whole.words, before.words) << "added all the same";
        EXPECT_EQ(whole.ranges, before.ranges);
    }
    const auto other = [&](const auto& change) {
        FilmSums whole = empty_sums();
        change(whole);
        expect_refused([&] { add_sums(whole, part); });
    };
    other([](FilmSums& sums) { sums.identity = "another"; });
    other([](FilmSums& sums) { std::swap(sums.width, sums.height); });
    other([](FilmSums& sums) { sums.light_exponent = 1; });
}

TEST(FilmSums, RangesAreJoinedWhereTheyTouch) {
    using Ranges = std::vector<SampleRange>;
    EXPECT_EQ(joined({{5, 9}, {0, 5}, {20, 30}, {9, 10}}), (Ranges{{0, 10}, {20, 30}}));
    EXPECT_EQ(joined({{3, 3}, {0, 1}}), (Ranges{{0, 1}}));
    EXPECT_EQ(joined({}), Ranges{});
    constexpr std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
    EXPECT_EQ(joined({{1, last}, {0, 1}}), (Ranges{{0, last}}));
    expect_refused([] { (void)joined({{0, 5}, {4, 6}}); });
    expect_refused([] { (void)joined({{4, 6}, {0, 10}}); });
}

/// Means and the variance of the mean in double precision.
struct Reference {
    std::array<double, FILM_PLANES> mean{};
    std::array<double, 3> beauty{}, variance{};
};

Reference reference_of(std::size_t pixel, std::uint32_t n) {
    Reference result;
    std::array<std::vector<double>, 3> beauties;
    for (std::uint32_t i = 0; i < n; ++i) {
        const Sample sample = sample_of(pixel, i);
        for (std::size_t plane = 0; plane < FILM_PLANES; ++plane)
            result.mean[plane] += static_cast<double>(sample[plane]) / n;
        for (std::size_t c = 0; c < 3; ++c)
            beauties[c].push_back(static_cast<double>(beauty_of(sample, c)));
    }
    for (std::size_t c = 0; c < 3; ++c) {
        for (const double value : beauties[c]) result.beauty[c] += value / n;
        for (const double value : beauties[c])
            result.variance[c] += (value - result.beauty[c]) * (value - result.beauty[c]);
        result.variance[c] /= n > 1 ? double(n) * (n - 1) : 1.0;
    }
    return result;
}

TEST(FilmSums, MeansAndVariancesAreThoseOfDoublePrecision) {
    for (const std::uint32_t n : {1U, 2U, 100U})
        for (const int exponent : {0, 3, -5}) {
            FilmSums sums = sums_of_samples({0, n});
            sums.light_exponent = exponent;
            sums.depth_unit = 0.25;
            const Image image = resolve_sums(sums);
            const double light = std::ldexp(1.0, exponent);
            const auto expect = [&](const char* layer, std::size_t c, std::size_t pixel,
                                    double expected) {
                ASSERT_NE(image.find(layer), nullptr) << layer;
                const auto found =
                    static_cast<double>(image.find(layer)->values.at(c * pixels + pixel));
                // Means of either sign may cancel: what is left is rounded to a float, the samples
                // to 2^-52, and beauty to a float once for each sample.
                EXPECT_NEAR(found, expected, 3e-7 * std::abs(expected) + 1e-15) << layer;
            };
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
                const Reference reference = reference_of(pixel, n);
                for (std::size_t c = 0; c < 3; ++c) {
                    expect("", c, pixel, light * reference.beauty[c]);
                    expect("emission", c, pixel, light * reference.mean[FILM_EMISSION + c]);
                    expect("direct", c, pixel, light * reference.mean[FILM_DIRECT + c]);
                    expect("indirect", c, pixel, light * reference.mean[FILM_INDIRECT + c]);
                    expect("albedo", c, pixel, reference.mean[FILM_ALBEDO + c]);
                    expect("normal", c, pixel, reference.mean[FILM_NORMAL + c]);
                    const auto found =
                        static_cast<double>(image.find("variance")->values[c * pixels + pixel]);
                    // Beauty and its square are rounded to floats, which counts where samples
                    // agree.
                    const double square =
                        reference.beauty[c] * reference.beauty[c] / n + reference.variance[c] * n;
                    EXPECT_NEAR(found, light * light * reference.variance[c],
                                light * light * (1e-6 * reference.variance[c] + 4e-7 * square / n));
                }
                expect("depth", 0, pixel, reference.mean[FILM_DEPTH] / 0.25);
                expect("alpha", 0, pixel, reference.mean[FILM_ALPHA]);
            }
        }
}

TEST(FilmSums, NothingYetIsBlack) {
    const Image image = resolve_sums(empty_sums());
    for (const Layer& layer : image.layers)
        for (const float value : layer.values) EXPECT_EQ(value, 0.0F) << layer.name;
}

/// Sums of n samples that are alike for all pixels: light for `share` of them, else darkness.
FilmSums flashes(std::uint32_t n, std::uint32_t bright, float light) {
    FilmSums sums = empty_sums();
    sums.ranges = {{0, n}};
    for (std::uint32_t i = 0; i < n; ++i) {
        Sample sample{};
        if (i < bright) sample[FILM_DIRECT] = sample[FILM_DIRECT + 1] = light;
        if (i < bright) sample[FILM_DIRECT + 2] = light;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) add_sample(sums, pixel, sample);
    }
    return sums;
}

double error_of_mean(const FilmSums& sums) {
    return relative_error(sums, PixelNoise::independent);
}

TEST(FilmSums, RelativeErrorIsThatOfTheMean) {
    // Of n samples b are 1: the mean is b / n, its variance b (n - b) / (n^2 (n - 1)), and pixels
    // are independent.
    for (const auto& [n, bright] :
         {std::pair{16U, 8U}, std::pair{100U, 1U}, std::pair{100U, 99U}, std::pair{2000U, 7U}})
        for (const float light : {1.0F, 1e-3F, 1e4F}) {
            const double b = bright;
            const double expected =
                std::sqrt(b * (n - b) / (double(n) * n * (n - 1.0)) / double(pixels)) / (b / n);
            EXPECT_NEAR(error_of_mean(flashes(n, bright, light)), expected, 1e-5 * expected);
            // These flash all at once, which is what shared noise is taken to do.
            EXPECT_NEAR(relative_error(flashes(n, bright, light), PixelNoise::shared),
                        expected * std::sqrt(double(pixels)), 1e-5 * expected * pixels);
        }
}

TEST(FilmSums, RelativeErrorIsNotDeceived) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(error_of_mean(empty_sums()), infinity);
    EXPECT_EQ(error_of_mean(flashes(1, 1, 1.0F)), infinity);
    EXPECT_EQ(error_of_mean(flashes(15, 7, 1.0F)), infinity) << "too few samples";
    EXPECT_LT(error_of_mean(flashes(16, 7, 1.0F)), 1.0);
    // Samples that agree may only not have met the light yet.
    EXPECT_EQ(error_of_mean(flashes(16, 0, 1.0F)), infinity);
    EXPECT_EQ(error_of_mean(flashes(1023, 0, 1.0F)), infinity);
    EXPECT_EQ(error_of_mean(flashes(1024, 0, 1.0F)), 0.0);
    EXPECT_EQ(error_of_mean(flashes(1023, 1023, 1.0F)), infinity);
    EXPECT_LT(error_of_mean(flashes(1024, 1024, 1.0F)), 1e-12);
    // Nor does it count for a variance that squares are rounded.
    for (const float light : {0.3F, 0.1F, 0.7F, 1e-3F, 123.4F}) {
        EXPECT_EQ(error_of_mean(flashes(16, 16, light)), infinity) << light;
        EXPECT_EQ(error_of_mean(flashes(1023, 1023, light)), infinity) << light;
        EXPECT_LT(error_of_mean(flashes(1024, 1024, light)), 1e-4) << light;
    }
    // Where squares are too faint for their sum, the error is never said to be smaller than it is.
    for (int exponent = -48; exponent <= 0; ++exponent) {
        const double found = error_of_mean(flashes(1024, 512, std::ldexp(1.0F, exponent)));
        const double truth = std::sqrt(1.0 / 1023.0 / static_cast<double>(pixels));
        EXPECT_GT(found, 0.999 * truth) << exponent;
        if (exponent > -30) {
            EXPECT_LT(found, 1.001 * truth) << exponent;
        }
    }
}

}  // namespace
}  // namespace weft::film_sums_test
