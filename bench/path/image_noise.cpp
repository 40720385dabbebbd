// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/image_noise.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace weft::bench {
namespace {

constexpr double floor_share = 0.01;  // of the squared mean of the image, as in docs/validation.md

/// The unbiased variance of `count` values with these sums of differences to one of them.
double unbiased(double sum, double squares, double count) {
    return std::max(0.0, (squares - sum * sum / count) / (count - 1.0));
}

/// Sums over images of the differences of value `i` to that of the first image: squares of values
/// that differ by rounding would cancel.
struct Differences {
    double origin;
    double sum = 0.0;
    double squares = 0.0;

    Differences(const Images& images, std::size_t i) : origin(images.front()[i]) {
        for (const std::vector<float>& image : images) {
            const double value = image[i] - origin;
            sum += value;
            squares += value * value;
        }
    }
};

}  // namespace

Moments moments(const Images& images) {
    const std::size_t size = images.front().size();
    const auto count = static_cast<double>(images.size());
    Moments found{std::vector<double>(size), std::vector<double>(size)};
    for (std::size_t i = 0; i < size; ++i) {
        const Differences all(images, i);
        found.mean[i] = all.origin + all.sum / count;
        found.variance[i] = unbiased(all.sum, all.squares, count);
    }
    return found;
}

std::vector<double> noise_scale(const std::vector<std::vector<double>>& means) {
    std::vector<double> scale(means.front().size());
    for (const std::vector<double>& mean : means)
        for (std::size_t i = 0; i < scale.size(); ++i)
            scale[i] += mean[i] / static_cast<double>(means.size());
    const double overall =
        std::accumulate(scale.begin(), scale.end(), 0.0) / static_cast<double>(scale.size());
    for (double& value : scale) value = value * value + floor_share * overall * overall;
    return scale;
}

Ratio relative_variance(const Images& images, const std::vector<double>& scale) {
    const auto count = static_cast<double>(images.size());
    double all = 0.0;
    std::vector<double> without(images.size());
    for (std::size_t i = 0; i < scale.size(); ++i) {
        if (!(scale[i] > 0.0)) continue;
        const Differences found(images, i);
        all += unbiased(found.sum, found.squares, count) / scale[i];
        for (std::size_t r = 0; r < images.size(); ++r) {
            const double value = images[r][i] - found.origin;
            without[r] +=
                unbiased(found.sum - value, found.squares - value * value, count - 1.0) / scale[i];
        }
    }
    const auto size = static_cast<double>(scale.size());
    for (double& value : without) value /= size;
    return jackknife(all / size, without);
}

}  // namespace weft::bench
