// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mip_levels.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/srgb.h"

namespace weft {
namespace {

LinearLevel first_level(const Texture& texture, const std::vector<float>& table) {
    LinearLevel level{texture.width, texture.height, {}};
    const std::size_t count = std::size_t{texture.width} * texture.height;
    level.values.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint8_t byte = texture.rgba[4 * i + c];
            level.values.push_back(texture.srgb ? table[byte] : static_cast<float>(byte) / 255.0F);
        }
    return level;
}

/// Source texels [from, to) that texel `i` of `size` covers in a level of `larger` texels. Odd
/// sizes leave one over, which the last texel takes in.
struct Span {
    std::uint32_t from, to;
};

Span covered(std::uint32_t i, std::uint32_t size, std::uint32_t larger) {
    if (larger == 1) return {0, 1};
    return {2 * i, i + 1 == size ? larger : 2 * i + 2};
}

LinearLevel halved(const LinearLevel& level) {
    LinearLevel half{std::max(1U, level.width / 2), std::max(1U, level.height / 2), {}};
    for (std::uint32_t y = 0; y < half.height; ++y) {
        const Span rows = covered(y, half.height, level.height);
        for (std::uint32_t x = 0; x < half.width; ++x) {
            const Span columns = covered(x, half.width, level.width);
            const float share =
                1.0F / static_cast<float>((rows.to - rows.from) * (columns.to - columns.from));
            for (std::size_t c = 0; c < 3; ++c) {
                float sum = 0.0F;
                for (std::uint32_t row = rows.from; row < rows.to; ++row)
                    for (std::uint32_t column = columns.from; column < columns.to; ++column)
                        sum += level.values[3 * (std::size_t{row} * level.width + column) + c];
                half.values.push_back(sum * share);
            }
        }
    }
    return half;
}

/// Alpha of a texture and of its ever smaller averages, level by level, or nothing where no
/// surface uses it.
std::vector<std::uint8_t> alpha_levels(const Texture& texture) {
    std::vector<std::uint8_t> all;
    if (!texture.has_alpha) return all;
    std::vector<float> level;
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
        level.push_back(static_cast<float>(texture.rgba[i]));
    std::uint32_t width = texture.width;
    std::uint32_t height = texture.height;
    while (true) {
        for (const float alpha : level)
            all.push_back(static_cast<std::uint8_t>(std::lround(alpha)));
        if (width == 1 && height == 1) return all;
        std::vector<float> half;
        const std::uint32_t next_width = std::max(1U, width / 2);
        const std::uint32_t next_height = std::max(1U, height / 2);
        for (std::uint32_t y = 0; y < next_height; ++y) {
            const Span rows = covered(y, next_height, height);
            for (std::uint32_t x = 0; x < next_width; ++x) {
                const Span columns = covered(x, next_width, width);
                float sum = 0.0F;
                for (std::uint32_t row = rows.from; row < rows.to; ++row)
                    for (std::uint32_t column = columns.from; column < columns.to; ++column)
                        sum += level[std::size_t{row} * width + column];
                half.push_back(
                    sum / static_cast<float>((rows.to - rows.from) * (columns.to - columns.from)));
            }
        }
        level = std::move(half);
        width = next_width;
        height = next_height;
    }
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
    std::vector<LinearLevel> levels;
    levels.push_back(first_level(texture, srgb_table()));
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(halved(levels.back()));
    return levels;
}

void append_mip_levels(const Texture& texture, std::vector<std::uint32_t>& texels) {
    const std::size_t first = texels.size();
    for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4)
        texels.push_back(pack(texture.rgba[i], texture.rgba[i + 1], texture.rgba[i + 2]));
    const std::vector<LinearLevel> levels = linear_mip_levels(texture);
    for (const LinearLevel& level : std::span(levels).subspan(1))
        for (std::size_t i = 0; i < level.values.size(); i += 3)
            texels.push_back(pack(encode(level.values[i], texture.srgb),
                                  encode(level.values[i + 1], texture.srgb),
                                  encode(level.values[i + 2], texture.srgb)));
    const std::vector<std::uint8_t> alphas = alpha_levels(texture);
    for (std::size_t i = 0; i < alphas.size(); ++i)
        texels[first + i] |= static_cast<std::uint32_t>(alphas[i]) << 24;
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
