// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/texture_statistics.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "scene/mip_levels.h"

namespace weft {
namespace {

constexpr std::size_t channels = 4;
constexpr std::size_t bytes = 256;
constexpr double weights[] = {0.2126, 0.7152, 0.0722};  // of the luminance

std::size_t number_of(Channel channel) {
    switch (channel) {
        case Channel::green:
            return 1;
        case Channel::blue:
            return 2;
        case Channel::alpha:
            return 3;
        case Channel::red:
        case Channel::rgb:
        case Channel::luminance:
            break;
    }
    return 0;
}

/// The linear value of each byte, by channel.
using ByteValues = std::array<std::array<double, bytes>, channels>;

ByteValues byte_values(bool srgb) {
    const std::vector<float> table = srgb_table();
    ByteValues values{};
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t b = 0; b < bytes; ++b)
            values[c][b] =
                srgb && c < 3 ? static_cast<double>(table[b]) : static_cast<double>(b) / 255.0;
    return values;
}

/// How often each byte occurs in each channel. Sums of whole numbers are the same in any order.
struct Census {
    std::array<std::array<std::uint64_t, bytes>, channels> counts{};
    ValueRange luminance{std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity()};
};

Census census_of(const Texture& texture, const ByteValues& values) {
    ByteValues weighted = values;
    for (std::size_t c = 0; c < 3; ++c)
        for (double& value : weighted[c]) value *= weights[c];
    const auto count = [&](const tbb::blocked_range<std::size_t>& texels, Census census) {
        for (std::size_t i = texels.begin(); i != texels.end(); ++i) {
            const std::uint8_t* const texel = &texture.rgba[channels * i];
            for (std::size_t c = 0; c < channels; ++c) ++census.counts[c][texel[c]];
            const double y = weighted[0][texel[0]] + weighted[1][texel[1]] + weighted[2][texel[2]];
            census.luminance.least = std::min(census.luminance.least, y);
            census.luminance.most = std::max(census.luminance.most, y);
        }
        return census;
    };
    const auto joined = [](Census a, const Census& b) {
        for (std::size_t c = 0; c < channels; ++c)
            for (std::size_t i = 0; i < bytes; ++i) a.counts[c][i] += b.counts[c][i];
        a.luminance.least = std::min(a.luminance.least, b.luminance.least);
        a.luminance.most = std::max(a.luminance.most, b.luminance.most);
        return a;
    };
    constexpr std::size_t at_once = std::size_t{1} << 16;
    const tbb::blocked_range<std::size_t> all(0, texture.rgba.size() / channels, at_once);
    return tbb::parallel_reduce(all, Census{}, count, joined);
}

}  // namespace

double TextureStatistics::mean_of(Channel channel) const {
    if (channel == Channel::luminance)
        return weights[0] * mean.r + weights[1] * mean.g + weights[2] * mean.b;
    return mean[static_cast<int>(number_of(channel))];
}

ValueRange TextureStatistics::range_of(Channel channel) const {
    return channel == Channel::luminance ? luminance : ranges[number_of(channel)];
}

TextureStatistics measure_texture(const Texture& texture) {
    const std::size_t texels = texture.rgba.size() / channels;
    TextureStatistics statistics;
    if (texels == 0) return statistics;
    const ByteValues values = byte_values(texture.srgb);
    const Census census = census_of(texture, values);
    for (std::size_t c = 0; c < channels; ++c) {
        const auto& counts = census.counts[c];
        double sum = 0.0;
        for (std::size_t b = 0; b < bytes; ++b)
            sum += static_cast<double>(counts[b]) * values[c][b];
        statistics.mean[static_cast<int>(c)] = sum / static_cast<double>(texels);
        std::size_t least = 0;
        std::size_t most = bytes - 1;
        while (counts[least] == 0) ++least;
        while (counts[most] == 0) --most;
        statistics.ranges[c] = {values[c][least], values[c][most]};
    }
    statistics.luminance = census.luminance;
    return statistics;
}

std::vector<TextureStatistics> measure_textures(std::span<const Texture> textures,
                                                const std::vector<bool>& shown) {
    std::vector<TextureStatistics> all(textures.size());
    for (std::size_t t = 0; t < textures.size(); ++t)
        if (shown[t]) all[t] = measure_texture(textures[t]);
    return all;
}

}  // namespace weft
