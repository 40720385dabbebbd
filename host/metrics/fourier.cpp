// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/fourier.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

constexpr std::uint32_t columns_per_block = 8;

// A radix p costs the library p multiplications per value; from about this sum on, the two longer
// transforms of the chirp convolution are cheaper.
constexpr std::size_t largest_direct_factor_sum = 32;

std::size_t sum_of_prime_factors(std::size_t length) {
    std::size_t sum = 0;
    for (std::size_t factor = 2; factor * factor <= length; ++factor)
        for (; length % factor == 0; length /= factor) sum += factor;
    return sum + length;
}

bool needs_chirp(std::size_t length) {
    return sum_of_prime_factors(length) > largest_direct_factor_sum;
}

bool has_small_factors(std::size_t length) {
    for (const std::size_t factor : {2, 3, 5})
        while (length % factor == 0) length /= factor;
    return length == 1;
}

// The convolution must be long enough that its ends do not meet.
std::size_t library_length(std::size_t length) {
    if (!needs_chirp(length)) return length;
    std::size_t padded = 2 * length - 1;
    while (!has_small_factors(padded)) ++padded;
    return padded;
}

void conjugate(std::span<Complex> line) {
    for (Complex& value : line) value = std::conj(value);
}

}  // namespace

LineTransform::LineTransform(std::size_t length)
    : length_(length),
      forward_(library_length(length), false),
      inverse_(library_length(length), true),
      output_(library_length(length)) {
    if (!needs_chirp(length)) return;
    const std::size_t padded_length = output_.size();
    padded_.resize(padded_length);
    chirp_.resize(length);
    chirp_spectrum_.resize(padded_length);
    for (std::size_t k = 0; k < length; ++k) {
        // k^2 is taken modulo its period: the phase of a large square would lose its low digits.
        const auto turn = static_cast<double>((k * k) % (2 * length));
        chirp_[k] = std::polar(1.0, -std::numbers::pi * turn / static_cast<double>(length));
        padded_[k] = std::conj(chirp_[k]) / static_cast<double>(padded_length);
        padded_[(padded_length - k) % padded_length] = padded_[k];
    }
    forward_.transform(padded_.data(), chirp_spectrum_.data());
}

void LineTransform::convolve(std::span<Complex> line) {
    for (std::size_t k = 0; k < length_; ++k) padded_[k] = line[k] * chirp_[k];
    std::fill(padded_.begin() + static_cast<std::ptrdiff_t>(length_), padded_.end(), Complex());
    forward_.transform(padded_.data(), output_.data());
    for (std::size_t k = 0; k < output_.size(); ++k) output_[k] *= chirp_spectrum_[k];
    inverse_.transform(output_.data(), padded_.data());
    for (std::size_t k = 0; k < length_; ++k) line[k] = padded_[k] * chirp_[k];
}

void LineTransform::forward(std::span<Complex> line) {
    if (!chirp_.empty()) return convolve(line);
    forward_.transform(line.data(), output_.data());
    std::copy(output_.begin(), output_.end(), line.begin());
}

void LineTransform::inverse(std::span<Complex> line) {
    if (!chirp_.empty()) {
        conjugate(line);
        convolve(line);
        return conjugate(line);
    }
    inverse_.transform(line.data(), output_.data());
    std::copy(output_.begin(), output_.end(), line.begin());
}

Fourier2d::Fourier2d(std::uint32_t width, std::uint32_t height)
    : width_(width),
      height_(height),
      row_(width),
      column_(height),
      block_(std::size_t{columns_per_block} * height) {}

void Fourier2d::transform_rows(std::span<Complex> map, Direction direction) {
    for (std::size_t y = 0; y < height_; ++y) {
        const std::span<Complex> line = map.subspan(y * width_, width_);
        direction == Direction::forward ? row_.forward(line) : row_.inverse(line);
    }
}

void Fourier2d::transform_columns(std::span<Complex> map, std::uint32_t first, std::uint32_t end,
                                  Direction direction) {
    for (std::uint32_t start = first; start < end; start += columns_per_block) {
        const std::size_t count = std::min(columns_per_block, end - start);
        for (std::size_t y = 0; y < height_; ++y)
            for (std::size_t x = 0; x < count; ++x)
                block_[x * height_ + y] = map[y * width_ + start + x];
        for (std::size_t x = 0; x < count; ++x) {
            const std::span<Complex> line(block_.data() + x * height_, height_);
            direction == Direction::forward ? column_.forward(line) : column_.inverse(line);
        }
        for (std::size_t y = 0; y < height_; ++y)
            for (std::size_t x = 0; x < count; ++x)
                map[y * width_ + start + x] = block_[x * height_ + y];
    }
}

void Fourier2d::transform_columns(std::span<Complex> map, std::uint32_t reach,
                                  Direction direction) {
    if (2 * std::uint64_t{reach} + 1 >= width_) return transform_columns(map, 0, width_, direction);
    transform_columns(map, 0, reach + 1, direction);
    transform_columns(map, width_ - reach, width_, direction);
}

void Fourier2d::forward(std::span<Complex> map, std::uint32_t reach) {
    transform_rows(map, Direction::forward);
    transform_columns(map, reach, Direction::forward);
}

void Fourier2d::inverse(std::span<Complex> map, std::uint32_t reach) {
    transform_columns(map, reach, Direction::inverse);
    transform_rows(map, Direction::inverse);
    const double scale = 1.0 / (static_cast<double>(width_) * static_cast<double>(height_));
    for (Complex& value : map) value *= scale;
}

}  // namespace weft
