// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/heat_map.h"

#include "base/srgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace weft {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr std::array<Colour, 9> anchors = {{{68, 1, 84},
                                            {71, 44, 122},
                                            {59, 81, 139},
                                            {44, 113, 142},
                                            {33, 144, 141},
                                            {39, 173, 129},
                                            {92, 200, 99},
                                            {170, 220, 50},
                                            {253, 231, 37}}};

// Rows of five dots from the top, the leftmost in the highest bit.
struct Glyph {
    char letter;
    std::array<std::uint8_t, 7> rows;
};
constexpr std::array<Glyph, 14> font = {{{'0', {14, 17, 19, 21, 25, 17, 14}},
                                         {'1', {4, 12, 4, 4, 4, 4, 14}},
                                         {'2', {14, 17, 1, 6, 8, 16, 31}},
                                         {'3', {14, 17, 1, 6, 1, 17, 14}},
                                         {'4', {2, 6, 10, 18, 31, 2, 2}},
                                         {'5', {31, 16, 30, 1, 1, 17, 14}},
                                         {'6', {6, 8, 16, 30, 17, 17, 14}},
                                         {'7', {31, 1, 2, 4, 8, 8, 8}},
                                         {'8', {14, 17, 17, 14, 17, 17, 14}},
                                         {'9', {14, 17, 17, 15, 1, 2, 12}},
                                         {'.', {0, 0, 0, 0, 0, 12, 12}},
                                         {'-', {0, 0, 0, 31, 0, 0, 0}},
                                         {'+', {0, 4, 4, 31, 4, 4, 0}},
                                         {'e', {0, 0, 14, 17, 31, 16, 14}}}};
constexpr std::size_t glyph_width = 5;
constexpr std::size_t glyph_height = 7;
constexpr std::size_t advance = glyph_width + 1;
constexpr std::size_t margin = 4;
constexpr std::size_t bar_height = 8;
constexpr std::size_t footer = margin + bar_height + margin + glyph_height + margin;

/// An image of 8-bit sRGB colours to draw in.
class Canvas {
  public:
    Canvas(std::size_t width, std::size_t height) {
        image_.width = static_cast<std::uint32_t>(width);
        image_.height = static_cast<std::uint32_t>(height);
        image_.layers = {{"", "RGB", std::vector<float>(3 * width * height, 0.0F)}};
        for (std::size_t i = 0; i < linear_.size(); ++i)
            linear_[i] = linear_from_srgb(static_cast<float>(i) / 255.0F);
    }

    void set(std::size_t x, std::size_t y, const Colour& colour) {
        const std::size_t plane = std::size_t{image_.width} * image_.height;
        for (std::size_t c = 0; c < 3; ++c)
            image_.layers[0].values[c * plane + y * image_.width + x] = linear_[colour[c]];
    }

    void text(std::size_t x, std::size_t y, std::string_view letters) {
        for (const char letter : letters) {
            const auto* const glyph =
                std::find_if(font.begin(), font.end(),
                             [letter](const Glyph& entry) { return entry.letter == letter; });
            for (std::size_t row = 0; glyph != font.end() && row < glyph_height; ++row)
                for (std::size_t column = 0; column < glyph_width; ++column)
                    if (((glyph->rows[row] >> (glyph_width - 1 - column)) & 1) != 0)
                        set(x + column, y + row, {255, 255, 255});
            x += advance;
        }
    }

    [[nodiscard]] Image take() { return std::move(image_); }

  private:
    Image image_;
    std::array<float, 256> linear_{};
};

}  // namespace

Colour viridis(double value) {
    constexpr double last = static_cast<double>(anchors.size() - 1);
    // A NaN fails the comparison.
    const double place = value > 0.0 ? std::min(value, 1.0) * last : 0.0;
    const auto below = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
    const double part = place - static_cast<double>(below);
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] = static_cast<std::uint8_t>(
            std::lround((1.0 - part) * anchors[below][c] + part * anchors[below + 1][c]));
    return colour;
}

Image heat_map(std::span<const float> values, std::uint32_t width, std::uint32_t height,
               double high) {
    if (values.empty() || values.size() != std::size_t{width} * height || !(high > 0.0) ||
        !std::isfinite(high))
        throw std::invalid_argument("a heat map needs a value a pixel and a positive end");
    const std::string label = fmt::format("{:.3g}", high);
    const std::size_t labels = (label.size() + 3) * advance + 2 * margin;
    const std::size_t full_width = std::max<std::size_t>(width, labels);
    Canvas canvas(full_width, height + footer);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            canvas.set(x, y, viridis(values[y * width + x] / high));
    const std::size_t bar_width = full_width - 2 * margin;
    for (std::size_t x = 0; x < bar_width; ++x)
        for (std::size_t y = 0; y < bar_height; ++y)
            canvas.set(margin + x, height + margin + y,
                       viridis(static_cast<double>(x) / static_cast<double>(bar_width - 1)));
    const std::size_t text_top = height + margin + bar_height + margin;
    canvas.text(margin, text_top, "0");
    canvas.text(full_width - margin - label.size() * advance + 1, text_top, label);
    return canvas.take();
}

}  // namespace weft
