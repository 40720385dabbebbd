// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/convolve.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace weft {
namespace {

constexpr std::size_t block = 16;

/// target[i] = sum over k of taps[k] * source(k)[i], for a row. Sums of a fixed number of pixels
/// stay in vector registers.
template <typename Source>
void weigh(float* target, std::size_t count, std::span<const float> taps, const Source& source) {
    std::size_t i = 0;
    for (; i + block <= count; i += block) {
        std::array<float, block> sums{};
        for (std::size_t k = 0; k < taps.size(); ++k) {
            const float* values = source(k) + i;
            for (std::size_t j = 0; j < block; ++j) sums[j] += taps[k] * values[j];
        }
        std::copy(sums.begin(), sums.end(), target + i);
    }
    for (; i < count; ++i) {
        float sum = 0.0F;
        for (std::size_t k = 0; k < taps.size(); ++k) sum += taps[k] * source(k)[i];
        target[i] = sum;
    }
}

template <typename Row>
void for_rows(std::uint32_t height, const Row& row) {
    constexpr std::size_t grain = 16;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, height, grain),
        [&](const tbb::blocked_range<std::size_t>& range) { row(range.begin(), range.end()); });
}

}  // namespace

std::vector<float> convolve(std::span<const float> plane, std::uint32_t width, std::uint32_t height,
                            std::span<const float> across, std::span<const float> down) {
    const std::size_t margin = across.size() / 2;
    std::vector<float> rows(plane.size());
    for_rows(height, [&](std::size_t begin, std::size_t end) {
        std::vector<float> padded(width + 2 * margin);
        for (std::size_t y = begin; y < end; ++y) {
            const float* source = plane.data() + y * width;
            std::fill_n(padded.begin(), margin, source[0]);
            std::copy_n(source, width, padded.begin() + static_cast<std::ptrdiff_t>(margin));
            std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(margin), margin,
                        source[width - 1]);
            weigh(rows.data() + y * width, width, across,
                  [&](std::size_t k) { return padded.data() + k; });
        }
    });
    std::vector<float> result(plane.size());
    const std::size_t reach = down.size() / 2;
    for_rows(height, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            weigh(result.data() + y * width, width, down, [&](std::size_t k) {
                const std::size_t from = std::clamp<std::size_t>(y + k, reach, height - 1 + reach);
                return rows.data() + (from - reach) * width;
            });
    });
    return result;
}

}  // namespace weft
