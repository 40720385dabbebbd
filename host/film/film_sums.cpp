// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/film_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "film/for_each_pixel.h"
#include "shared/shared_types.h"

namespace weft {
namespace {

// Variances estimated from fewer than least_samples are not trusted, nor is a variance of 0 with
// fewer than samples_without_variance: where few samples meet light, none of the first ones may.
constexpr std::uint64_t least_samples = 16;
constexpr std::uint64_t samples_without_variance = 1024;
// Variance, relative to the square, that remains from rounding beauty and its square to floats
// where all samples agree.
constexpr double rounding = 0x1p-21;
// Variance that the rounding of a square to the sum's unit may hide.
constexpr double resolution = 0x1p-73;
static_assert(FILM_SQUARE_SHIFT == 72);

/// The two's complement integer of `count` words of one pixel, times 2^-shift.
double value_of(const FilmSums& sums, std::size_t first_word, std::size_t count, std::size_t pixel,
                int shift) {
    const std::uint32_t* const words = &sums.words[pixel * FILM_PIXEL_WORDS + first_word];
    const auto word = [&](std::size_t k) { return k < count ? words[k] : 0U; };
    const bool negative = (word(count - 1) >> 31) != 0;
    // The magnitude, since the halves of a small negative number are large.
    double magnitude = 0.0;
    std::uint64_t carry = negative ? 1 : 0;
    for (std::size_t k = 0; k < count; ++k) {
        carry += negative ? std::uint32_t{~word(k)} : word(k);
        magnitude += std::ldexp(static_cast<double>(static_cast<std::uint32_t>(carry)),
                                32 * static_cast<int>(k) - shift);
        carry >>= 32;
    }
    return negative ? -magnitude : magnitude;
}

double plane_sum(const FilmSums& sums, std::size_t plane, std::size_t pixel) {
    return value_of(sums, plane * FILM_SUM_WORDS, FILM_SUM_WORDS, pixel, FILM_SUM_SHIFT);
}

/// Sum of beauty over the samples of a pixel, in units of the light.
double beauty_sum(const FilmSums& sums, std::size_t channel, std::size_t pixel) {
    return plane_sum(sums, FILM_EMISSION + channel, pixel) +
           plane_sum(sums, FILM_DIRECT + channel, pixel) +
           plane_sum(sums, FILM_INDIRECT + channel, pixel);
}

/// Variance of a pixel's mean, in units of the light squared.
double variance_of_mean(const FilmSums& sums, std::size_t channel, std::size_t pixel) {
    const auto n = static_cast<double>(sums.samples());
    if (n < 2.0) return 0.0;
    const double sum = beauty_sum(sums, channel, pixel);
    const double squares =
        value_of(sums, FILM_PLANES * FILM_SUM_WORDS + channel * FILM_SQUARE_WORDS,
                 FILM_SQUARE_WORDS, pixel, FILM_SQUARE_SHIFT);
    return std::max(0.0, squares - sum * sum / n) / (n * (n - 1.0));
}

void add_words(FilmSums& whole, const FilmSums& part, std::size_t first, std::size_t count) {
    const std::size_t pixels = std::size_t{whole.width} * whole.height;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        std::uint64_t carry = 0;
        const std::size_t begin = pixel * FILM_PIXEL_WORDS + first;
        for (std::size_t at = begin; at < begin + count; ++at) {
            const std::uint64_t sum = std::uint64_t{whole.words[at]} + part.words[at] + carry;
            whole.words[at] = static_cast<std::uint32_t>(sum);
            carry = sum >> 32;
        }
    }
}

}  // namespace

std::uint64_t FilmSums::samples() const {
    std::uint64_t count = 0;
    for (const SampleRange& range : ranges) count += range.end - range.first;
    return count;
}

std::vector<SampleRange> joined(std::vector<SampleRange> ranges) {
    std::sort(ranges.begin(), ranges.end(),
              [](const SampleRange& a, const SampleRange& b) { return a.first < b.first; });
    std::vector<SampleRange> result;
    for (const SampleRange& range : ranges) {
        if (range.first >= range.end) continue;
        if (!result.empty() && range.first < result.back().end)
            throw Error(ExitCode::bad_input, "samples " + std::to_string(range.first) + " to " +
                                                 std::to_string(result.back().end - 1) +
                                                 " are there twice, expected each once");
        if (!result.empty() && range.first == result.back().end)
            result.back().end = range.end;
        else
            result.push_back(range);
    }
    return result;
}

void add_sums(FilmSums& whole, const FilmSums& part) {
    if (whole.width != part.width || whole.height != part.height ||
        whole.identity != part.identity || whole.light_exponent != part.light_exponent)
        throw Error(ExitCode::bad_input,
                    "the parts are not of one image, expected the same scene, size, camera, seed "
                    "and options");
    std::vector<SampleRange> ranges = whole.ranges;
    ranges.insert(ranges.end(), part.ranges.begin(), part.ranges.end());
    whole.ranges = joined(std::move(ranges));
    whole.backends.insert(part.backends.begin(), part.backends.end());
    for (std::size_t plane = 0; plane < FILM_PLANES; ++plane)
        add_words(whole, part, plane * FILM_SUM_WORDS, FILM_SUM_WORDS);
    for (std::size_t channel = 0; channel < 3; ++channel)
        add_words(whole, part, FILM_PLANES * FILM_SUM_WORDS + channel * FILM_SQUARE_WORDS,
                  FILM_SQUARE_WORDS);
}

Image resolve_sums(const FilmSums& sums) {
    const std::size_t pixels = std::size_t{sums.width} * sums.height;
    const double share = 1.0 / static_cast<double>(std::max<std::uint64_t>(1, sums.samples()));
    const double light = std::ldexp(1.0, sums.light_exponent);
    Image image;
    image.width = sums.width;
    image.height = sums.height;
    const auto add = [&](std::string_view name, const char* channels, const auto& value,
                         bool half = false) {
        Layer layer{std::string(name), channels, {}, false, half};
        layer.values.resize(layer.channels.size() * pixels);
        for (std::size_t c = 0; c < layer.channels.size(); ++c)
            for_each_pixel(pixels, [&](std::size_t pixel) {
                layer.values[c * pixels + pixel] = static_cast<float>(value(c, pixel));
            });
        image.layers.push_back(std::move(layer));
    };
    const auto mean = [&](std::size_t plane, double unit) {
        return [&sums, plane, scale = unit * share](std::size_t c, std::size_t pixel) {
            return plane_sum(sums, plane + c, pixel) * scale;
        };
    };
    add("", "RGB", [&](std::size_t c, std::size_t pixel) {
        return beauty_sum(sums, c, pixel) * (light * share);
    });
    // Samples behind coloured media may have more than 1 or less than 0, but not their mean.
    add(alpha_layer_name, "A", [alpha = mean(FILM_ALPHA, 1.0)](std::size_t c, std::size_t pixel) {
        return std::clamp(alpha(c, pixel), 0.0, 1.0);
    });
    add("direct", "RGB", mean(FILM_DIRECT, light));
    add("indirect", "RGB", mean(FILM_INDIRECT, light));
    add("emission", "RGB", mean(FILM_EMISSION, light));
    add("albedo", "RGB", mean(FILM_ALBEDO, 1.0), true);
    add("normal", "XYZ", mean(FILM_NORMAL, 1.0), true);
    add("depth", "Z", mean(FILM_DEPTH, 1.0 / sums.depth_unit));
    add("variance", "RGB", [&](std::size_t c, std::size_t pixel) {
        return variance_of_mean(sums, c, pixel) * light * light;
    });
    return image;
}

double relative_error(const FilmSums& sums, PixelNoise noise,
                      const std::function<bool()>& keep_going) {
    const auto n = static_cast<double>(sums.samples());
    if (sums.samples() < least_samples) return std::numeric_limits<double>::infinity();
    constexpr double weight[3] = {0.2126, 0.7152, 0.0722};
    double total = 0.0;
    double variance = 0.0;  // of the sum over pixels
    double deviations = 0.0;
    bool varies = false;
    for (std::size_t pixel = 0; pixel < std::size_t{sums.width} * sums.height; ++pixel) {
        constexpr std::size_t asked_after = 4096;  // pixels: about a millisecond
        if (pixel % asked_after == 0 && keep_going && !keep_going())
            return std::numeric_limits<double>::infinity();
        double deviation = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double mean = beauty_sum(sums, c, pixel) / n;
            const double of_mean = variance_of_mean(sums, c, pixel);
            varies = varies || of_mean * (n - 1.0) > rounding * mean * mean;
            total += weight[c] * mean;
            // Channels of a sample are taken as fully correlated, so their deviations add up.
            deviation += weight[c] * std::sqrt(of_mean + resolution / (n - 1.0));
        }
        variance += deviation * deviation;
        deviations += deviation;
    }
    if (!varies && sums.samples() < samples_without_variance)
        return std::numeric_limits<double>::infinity();
    if (!(total > 0.0)) return varies ? std::numeric_limits<double>::infinity() : 0.0;
    return (noise == PixelNoise::independent ? std::sqrt(variance) : deviations) / total;
}

}  // namespace weft
