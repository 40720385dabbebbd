// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mip_levels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/srgb.h"

namespace weft {
namespace {

/// Source texels [from, to) that texel `i` of `size` covers in a level of `larger` texels. Odd
/// sizes leave one over, which the last texel takes in.
struct Span {
    std::uint32_t from, to;
};

Span covered(std::uint32_t i, std::uint32_t size, std::uint32_t larger) {
    if (larger == 1) return {0, 1};
    return {2 * i, i + 1 == size ? larger : 2 * i + 2};
}

/// A level of `channels` floats a texel, row by row.
template <std::size_t channels>
struct Level {
    std::uint32_t width, height;
    std::vector<float> values;

    [[nodiscard]] bool is_last() const { return width == 1 && height == 1; }
    [[nodiscard]] std::size_t texels() const { return std::size_t{width} * height; }
    [[nodiscard]] float at(std::size_t texel, std::size_t channel) const {
        return values[channels * texel + channel];
    }
};

/// The averages of a level of width x height texels, whose values `at(texel, channel)` gives.
template <std::size_t channels, class At>
Level<channels> halved(std::uint32_t width, std::uint32_t height, const At& at) {
    Level<channels> half{std::max(1U, width / 2), std::max(1U, height / 2), {}};
    half.values.resize(channels * half.texels());
    tbb::parallel_for(std::uint32_t{0}, half.height, [&](std::uint32_t y) {
        const Span rows = covered(y, half.height, height);
        float* value = &half.values[channels * std::size_t{y} * half.width];
        for (std::uint32_t x = 0; x < half.width; ++x) {
            const Span columns = covered(x, half.width, width);
            const float share =
                1.0F / static_cast<float>((rows.to - rows.from) * (columns.to - columns.from));
            for (std::size_t c = 0; c < channels; ++c) {
                float sum = 0.0F;
                for (std::uint32_t row = rows.from; row < rows.to; ++row)
                    for (std::uint32_t column = columns.from; column < columns.to; ++column)
                        sum += at(std::size_t{row} * width + column, c);
                *value++ = sum * share;
            }
        }
    });
    return half;
}

template <std::size_t channels>
Level<channels> halved(const Level<channels>& level) {
    return halved<channels>(level.width, level.height, [&](std::size_t texel, std::size_t channel) {
        return level.at(texel, channel);
    });
}

/// Calls visit(level) for the averages of a texture, whose values `at(texel, channel)` gives, down
/// to one texel.
template <std::size_t channels, class At, class Visit>
void for_averages(const Texture& texture, const At& at, const Visit& visit) {
    if (texture.width == 1 && texture.height == 1) return;
    Level<channels> level = halved<channels>(texture.width, texture.height, at);
    visit(level);
    while (!level.is_last()) {
        level = halved(level);
        visit(level);
    }
}

/// The linear value of each byte of a colour.
std::vector<float> colour_table(const Texture& texture) {
    if (texture.srgb) return srgb_table();
    std::vector<float> table;
    for (int i = 0; i < 256; ++i) table.push_back(static_cast<float>(i) / 255.0F);
    return table;
}

std::uint32_t pack(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    return static_cast<std::uint32_t>(r) | static_cast<std::uint32_t>(g) << 8 |
           static_cast<std::uint32_t>(b) << 16;
}

std::uint8_t encode(float value, bool srgb) {
    if (srgb) return linear_to_srgb(value);
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

}  // namespace

std::vector<LinearLevel> linear_mip_levels(const Texture& texture) {
    const std::vector<float> table = colour_table(texture);
    const auto at = [&](std::size_t texel, std::size_t channel) {
        return table[texture.rgba[4 * texel + channel]];
    };
    std::vector<LinearLevel> levels;
    LinearLevel& first = levels.emplace_back(LinearLevel{texture.width, texture.height, {}});
    for (std::size_t i = 0; i < std::size_t{texture.width} * texture.height; ++i)
        for (std::size_t c = 0; c < 3; ++c) first.values.push_back(at(i, c));
    for_averages<3>(texture, at, [&](const Level<3>& level) {
        levels.push_back({level.width, level.height, level.values});
    });
    return levels;
}

void append_mip_levels(const Texture& texture, std::vector<std::uint32_t>& texels) {
    const std::size_t first = texels.size();
    const std::vector<float> table = colour_table(texture);
    const std::vector<std::uint8_t>& rgba = texture.rgba;
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4)
        texels.push_back(pack(rgba[i], rgba[i + 1], rgba[i + 2]));
    for_averages<3>(
        texture,
        [&](std::size_t texel, std::size_t channel) { return table[rgba[4 * texel + channel]]; },
        [&](const Level<3>& level) {
            const std::size_t begin = texels.size();
            texels.resize(begin + level.texels());
            tbb::parallel_for(std::size_t{0}, level.texels(), [&](std::size_t i) {
                texels[begin + i] =
                    pack(encode(level.at(i, 0), texture.srgb), encode(level.at(i, 1), texture.srgb),
                         encode(level.at(i, 2), texture.srgb));
            });
        });
    if (!texture.has_alpha) return;
    std::size_t next = first;
    for (std::size_t i = 3; i < rgba.size(); i += 4)
        texels[next++] |= static_cast<std::uint32_t>(rgba[i]) << 24;
    for_averages<1>(
        texture,
        [&](std::size_t texel, std::size_t) { return static_cast<float>(rgba[4 * texel + 3]); },
        [&](const Level<1>& level) {
            for (const float alpha : level.values)
                texels[next++] |= static_cast<std::uint32_t>(std::lround(alpha)) << 24;
        });
}

std::size_t mip_texels(std::uint32_t width, std::uint32_t height) {
    std::size_t sum = std::size_t{width} * height;
    while (width > 1 || height > 1) {
        width = std::max(1U, width / 2);
        height = std::max(1U, height / 2);
        sum += std::size_t{width} * height;
    }
    return sum;
}

float srgb_to_linear(std::uint8_t value) {
    return static_cast<float>(linear_from_srgb(static_cast<double>(value) / 255.0));
}

std::uint8_t linear_to_srgb(float value) {
    static const std::vector<float> table = srgb_table();
    const auto above = std::lower_bound(table.begin(), table.end(), value);
    if (above == table.begin()) return 0;
    if (above == table.end()) return 255;
    const auto index = above - table.begin();
    return static_cast<std::uint8_t>(*above - value < value - *(above - 1) ? index : index - 1);
}

std::vector<float> srgb_table() {
    std::vector<float> table;
    for (int i = 0; i < 256; ++i) table.push_back(srgb_to_linear(static_cast<std::uint8_t>(i)));
    return table;
}

}  // namespace weft
