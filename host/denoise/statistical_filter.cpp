// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/statistical_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "denoise/layer_values.h"
#include "denoise/noisy_light.h"
#include "denoise/padded_rows.h"
#include "denoise/pixel_surfaces.h"
#include "denoise/welch_test.h"

namespace weft {
namespace {

constexpr std::size_t strip = Padding::strip;
constexpr int radius = Padding::margin;  // of a pixel's window
constexpr std::size_t places = (2 * radius + 1) * (2 * radius + 1);
// Deviation of the weights in a window, in pixels: far pixels add little, so that it leaves no
// squares.
constexpr float deviation = 3.0F;
// A pixel whose standard error is more than so many times the mean over a window counts less there,
// by the square of the ratio: single bright paths would leave blots, since no test tells them
// apart.
constexpr float most_error = 5.0F;

using Strip = std::array<float, strip>;
using Channels = std::array<Strip, 3>;

/// Means that are compared, with what Welch's test takes of each.
struct TestedMeans {
    std::array<PaddedPlane, 3> mean;
    std::array<PaddedPlane, 3> variance;  ///< below 0: unknown, like any other
    PaddedPlane one, drop;                ///< WelchTerm

    explicit TestedMeans(std::size_t size) : one(size), drop(size) {
        for (std::size_t c = 0; c < 3; ++c) {
            mean[c].resize(size);
            variance[c].resize(size, -1.0F);
        }
    }
};

// By value: of references to array elements compilers make branches, which loops of vectors cannot
// have.
constexpr float least(float a, float b) {
    return a < b ? a : b;
}
constexpr float most(float a, float b) {
    return a > b ? a : b;
}

/// Sets those weights of a strip to 0 where Welch's test tells two means apart.
void keep_equal(const float* a, const float* v, const float* one_a, const float* drop_a,
                const float* b, const float* w, const float* one_b, const float* drop_b,
                float* __restrict weights) {
    for (std::size_t k = 0; k < strip; ++k) {
        const float difference = a[k] - b[k];
        const float limit = welch_limit({one_a[k], drop_a[k]}, v[k], {one_b[k], drop_b[k]}, w[k]);
        const float weight = weights[k];
        const float equal = difference * difference <= limit ? weight : 0.0F;
        weights[k] = least(v[k], w[k]) < 0.0F ? weight : equal;
    }
}

class StatisticalFilter {
  public:
    StatisticalFilter(const Image& image, std::uint64_t samples, const DenoiseView& view)
        : image_(image),
          media_(view.media),
          padding_(image.width, image.height),
          degrees_(static_cast<double>(samples) - 1.0),
          light_(image, view, padding_),
          surfaces_(image, view, padding_),
          around_(padding_.size()) {
        pixel_one_.fill(welch_term(limits_, degrees_).one);
        pixel_drop_.fill(welch_term(limits_, degrees_).drop);
        for (int k = -radius; k <= radius; ++k)
            weight_[static_cast<std::size_t>(k + radius)] =
                std::exp(-0.5F * static_cast<float>(k * k) / (deviation * deviation));
    }

    std::vector<float> filtered() {
        for_each_strip([&](std::size_t x, std::size_t y) { find_surroundings(padding_.at(x, y)); });
        const std::span<const float> beauty = layer_values(image_, "", 3);
        std::vector<float> result(beauty.begin(), beauty.end());
        for_each_strip([&](std::size_t x, std::size_t y) { filter_strip(x, y, result); });
        return result;
    }

  private:
    template <class Work>
    void for_each_strip(const Work& work) const {
        for_each_row(padding_, [&](std::size_t y) {
            for (std::size_t x = 0; x < padding_.width(); x += strip) work(x, y);
        });
    }

    /// Sets those weights to 0 whose pixel and the one at that distance are not both lit, show
    /// different surfaces, or have light that a test tells apart.
    void keep_alike(std::size_t i, int dx, int dy, float* __restrict weights) const {
        const std::size_t j = padding_.beside(i, dx, dy);
        const float* const here = &light_.lit[i];
        const float* const there = &light_.lit[j];
        for (std::size_t k = 0; k < strip; ++k) weights[k] *= here[k] * there[k];
        surfaces_.keep_same(i, dx, dy, weights);
        for (std::size_t c = 0; c < 3; ++c)
            keep_equal(&light_.mean[c][i], &light_.variance[c][i], pixel_one_.data(),
                       pixel_drop_.data(), &light_.mean[c][j], &light_.variance[c][j],
                       pixel_one_.data(), pixel_drop_.data(), weights);
    }

    /// The same for the light around pixels, which has less noise: a test tells apart there what it
    /// cannot from pixel to pixel.
    void keep_alike_around(std::size_t i, int dx, int dy, float* weights) const {
        const std::size_t j = padding_.beside(i, dx, dy);
        for (std::size_t c = 0; c < 3; ++c)
            keep_equal(&around_.mean[c][i], &around_.variance[c][i], &around_.one[i],
                       &around_.drop[i], &around_.mean[c][j], &around_.variance[c][j],
                       &around_.one[j], &around_.drop[j], weights);
    }

    /// Averages each pixel of a strip over 3 x 3 pixels. By Satterthwaite the sum of variances v of
    /// d degrees of freedom each has d (sum v)^2 / sum v^2; the channel that has fewest counts.
    void find_surroundings(std::size_t i) {
        Channels count{}, sum{}, variance{}, squares{};
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                Strip weights;
                weights.fill(1.0F);
                keep_alike(i, dx, dy, weights.data());
                const std::size_t j = padding_.beside(i, dx, dy);
                for (std::size_t c = 0; c < 3; ++c)
                    for (std::size_t k = 0; k < strip; ++k) {
                        const float variance_of_mean = light_.variance[c][j + k];
                        const float weight = weights[k];
                        const float known = variance_of_mean < 0.0F ? 0.0F : weight;
                        const float v = known * variance_of_mean;
                        count[c][k] += known;
                        sum[c][k] += known * light_.mean[c][j + k];
                        variance[c][k] += v;
                        squares[c][k] += v * v;
                    }
            }
        for (std::size_t k = 0; k < strip; ++k) {
            if (light_.lit[i + k] == 0.0F) continue;
            double degrees = 9.0 * degrees_;
            for (std::size_t c = 0; c < 3; ++c) {
                const float n = count[c][k];
                if (!(n > 0.0F)) continue;
                around_.mean[c][i + k] = sum[c][k] / n;
                around_.variance[c][i + k] = variance[c][k] / (n * n);
                if (squares[c][k] > 0.0F)
                    degrees = std::min(degrees, degrees_ * variance[c][k] *
                                                    (double{variance[c][k]} / squares[c][k]));
            }
            const WelchTerm term = welch_term(limits_, std::max(degrees, degrees_));
            around_.one[i + k] = term.one;
            around_.drop[i + k] = term.drop;
        }
    }

    /// Calls `work` with each place of a window: its distance, and the weights of the pixels there.
    template <class Work>
    static void for_each_place(std::vector<float>& weights, const Work& work) {
        float* of_place = weights.data();
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx, of_place += strip) work(dx, dy, of_place);
    }

    void filter_strip(std::size_t x, std::size_t y, std::vector<float>& result) const {
        const std::size_t i = padding_.at(x, y);
        std::vector<float> weights(places * strip);
        Channels error{}, sum{};
        for_each_place(weights, [&](int dx, int dy, float* __restrict weight) {
            std::fill_n(weight, strip,
                        weight_[static_cast<std::size_t>(dx + radius)] *
                            weight_[static_cast<std::size_t>(dy + radius)]);
            keep_alike(i, dx, dy, weight);
            keep_alike_around(i, dx, dy, weight);
            const std::size_t j = padding_.beside(i, dx, dy);
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t k = 0; k < strip; ++k) {
                    const float v = light_.variance[c][j + k];
                    const float w = weight[k];
                    const float known = v < 0.0F ? 0.0F : w;
                    error[c][k] += known * std::sqrt(most(v, 0.0F));
                    sum[c][k] += known;
                }
        });
        Channels limit{};
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < strip; ++k) {
                const float mean = sum[c][k] > 0.0F ? error[c][k] / sum[c][k] : 0.0F;
                limit[c][k] = most_error * most_error * mean * mean;
            }
        store(x, y, average(i, weights, limit), result);
    }

    /// The mean difference of a window to its pixel, for the pixels of a strip. `limit`: variance
    /// above which a pixel of the window counts less.
    [[nodiscard]] Channels average(std::size_t i, std::vector<float>& weights,
                                   const Channels& limit) const {
        constexpr float above_zero = std::numeric_limits<float>::min();
        Channels change{}, sum{};
        for_each_place(weights, [&](int dx, int dy, float* __restrict weight) {
            const std::size_t j = padding_.beside(i, dx, dy);
            Strip share;
            share.fill(1.0F);
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t k = 0; k < strip; ++k) {
                    const float bound = most(limit[c][k], above_zero);
                    // The least of the channels, so that colours do not change.
                    share[k] = least(share[k], bound / most(light_.variance[c][j + k], bound));
                }
            for (std::size_t k = 0; k < strip; ++k) weight[k] *= share[k];
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t k = 0; k < strip; ++k) {
                    const float v = least(light_.variance[c][i + k], light_.variance[c][j + k]);
                    const float w = weight[k];
                    const float known = v < 0.0F ? 0.0F : w;
                    change[c][k] += known * (light_.mean[c][j + k] - light_.mean[c][i + k]);
                    sum[c][k] += known;
                }
        });
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < strip; ++k)
                change[c][k] = sum[c][k] > 0.0F ? change[c][k] / sum[c][k] : 0.0F;
        return change;
    }

    /// Adds changes to the light that the pixels of a strip reflect.
    void store(std::size_t x, std::size_t y, const Channels& change,
               std::vector<float>& result) const {
        const std::span<const float> albedo = layer_values(image_, "albedo", 3);
        const std::size_t pixels = padding_.width() * padding_.height();
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < std::min(strip, padding_.width() - x); ++k) {
                if (change[c][k] == 0.0F) continue;
                const std::size_t at = c * pixels + y * padding_.width() + x + k;
                const double reflected = media_ ? 1.0 : double{albedo[at]};
                result[at] = static_cast<float>(
                    std::max(0.0, result[at] + reflected * (change[c][k] / light_.scale)));
            }
    }

    const Image& image_;
    bool media_;
    Padding padding_;
    double degrees_;  ///< of freedom of a pixel's variance
    NoisyLight light_;
    PixelSurfaces surfaces_;
    TestedMeans around_;
    StudentLimits limits_;
    Strip pixel_one_{}, pixel_drop_{};  ///< WelchTerm of each pixel
    std::array<float, 2 * radius + 1> weight_{};
};

}  // namespace

std::vector<float> statistical_filter(const Image& image, std::uint64_t samples,
                                      const DenoiseView& view) {
    return StatisticalFilter(image, samples, view).filtered();
}

}  // namespace weft
