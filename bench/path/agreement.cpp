// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/agreement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::bench {
namespace {

constexpr double level = 0.01;
constexpr double rounding = 1e-5;  // relative; area lights that are seen have no variance

/// Means over the channels: those of a pixel come from the same paths.
Images grey(const Images& images) {
    Images result;
    for (const std::vector<float>& image : images) {
        const std::size_t size = image.size() / 3;
        std::vector<float> mean(size);
        for (std::size_t i = 0; i < size; ++i)
            mean[i] = (image[i] + image[size + i] + image[2 * size + i]) / 3.0F;
        result.push_back(std::move(mean));
    }
    return result;
}

/// Sums over some pixels, which z comes from.
struct Difference {
    double first = 0.0;
    double second = 0.0;
    double variance = 0.0;  ///< of the difference of both

    void add(const Difference& other) {
        first += other.first;
        second += other.second;
        variance += other.variance;
    }
    [[nodiscard]] double z() const {
        const double tolerance = rounding * std::max(std::abs(first), std::abs(second));
        const double beyond = std::abs(first - second) - tolerance;
        if (!(beyond > 0.0)) return 0.0;
        return beyond / std::sqrt(variance);  // infinite where neither has noise
    }
};

std::uint32_t blocks_along(std::uint32_t edge) {
    return (edge + agreement_block - 1) / agreement_block;
}

}  // namespace

std::size_t block_count(std::uint32_t width, std::uint32_t height) {
    return std::size_t{blocks_along(width)} * blocks_along(height);
}

Agreement compare_means(const Images& first, const Images& second, std::uint32_t width,
                        std::uint32_t height) {
    const Moments a = moments(grey(first));
    const Moments b = moments(grey(second));
    std::vector<Difference> blocks(block_count(width, height));
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t i = std::size_t{y} * width + x;
            const std::size_t block =
                std::size_t{y / agreement_block} * blocks_along(width) + x / agreement_block;
            blocks[block].add({a.mean[i], b.mean[i],
                               a.variance[i] / static_cast<double>(first.size()) +
                                   b.variance[i] / static_cast<double>(second.size())});
        }
    Agreement result;
    Difference whole;
    for (const Difference& block : blocks) {
        result.worst_z = std::max(result.worst_z, block.z());
        whole.add(block);
    }
    if (whole.first > 0.0) {
        result.difference = whole.second / whole.first - 1.0;
        result.error = std::sqrt(whole.variance) / whole.first;
    }
    return result;
}

double z_limit(std::size_t count) {
    const double wanted = level / static_cast<double>(std::max<std::size_t>(count, 1));
    double low = 0.0;
    double high = 40.0;  // beyond what a double's tail can tell
    for (int step = 0; step < 100; ++step) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::numbers::sqrt2) > wanted ? low : high) = middle;
    }
    return high;
}

}  // namespace weft::bench
