// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_PADDING_H
#define WEFT_DENOISE_PADDING_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft {

/// Where the pixels of an image lie in planes that have a margin all around and whole strips in
/// each row: so windows need no border, and loops over a strip have a length that the compiler
/// knows.
class Padding {
  public:
    /// Pixels of a row that are worked on together.
    static constexpr std::size_t strip = 128;
    /// Pixels around the image.
    static constexpr int margin = 7;

    Padding(std::uint32_t width, std::uint32_t height)
        : width_(width),
          height_(height),
          stride_((width + strip - 1) / strip * strip + 2 * std::size_t{margin}) {}

    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t height() const { return height_; }
    /// Values of a plane.
    [[nodiscard]] std::size_t size() const { return stride_ * (height_ + 2 * std::size_t{margin}); }
    /// The place of a pixel.
    [[nodiscard]] std::size_t at(std::size_t x, std::size_t y) const {
        return (y + margin) * stride_ + margin + x;
    }
    /// The place `dx` and `dy` pixels away from another, at most the margin.
    [[nodiscard]] std::size_t beside(std::size_t place, int dx, int dy) const {
        return place + static_cast<std::size_t>(dy) * stride_ + static_cast<std::size_t>(dx);
    }

  private:
    std::size_t width_, height_, stride_;
};

/// A plane by Padding.
using PaddedPlane = std::vector<float>;

}  // namespace weft

#endif
