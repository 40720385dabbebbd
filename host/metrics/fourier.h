// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_FOURIER_H
#define WEFT_METRICS_FOURIER_H

#include <complex>
#include <cstddef>
#include <cstdint>
#include <kissfft/kissfft.hh>
#include <span>
#include <vector>

namespace weft {

using Complex = std::complex<double>;

/// Discrete Fourier transform of one line of any length from 1, in place and unscaled. Lengths with
/// a large prime factor go through Bluestein's chirp convolution, so that every length costs
/// O(n log n). Not for use by several threads at once.
class LineTransform {
  public:
    explicit LineTransform(std::size_t length);

    /// X[k] = sum of x[j] exp(-2 pi i j k / n); the line has the length of the constructor.
    void forward(std::span<Complex> line);

    /// x[j] = sum of X[k] exp(+2 pi i j k / n): n times the inverse of forward().
    void inverse(std::span<Complex> line);

  private:
    void convolve(std::span<Complex> line);

    std::size_t length_;
    kissfft<double> forward_;
    kissfft<double> inverse_;
    std::vector<Complex> output_;
    std::vector<Complex> chirp_;           ///< empty where the library takes the length directly
    std::vector<Complex> chirp_spectrum_;  ///< of the conjugate chirp, scaled by 1 / its length
    std::vector<Complex> padded_;
};

/// Two-dimensional transforms of row-major maps of one size. Two real maps are transformed as the
/// real and the imaginary part of one complex map: a filter whose weights are real and equal at
/// opposite frequencies filters each independently.
class Fourier2d {
  public:
    Fourier2d(std::uint32_t width, std::uint32_t height);

    /// Transforms in place, unscaled. Only columns with a frequency of at most `reach` (in cycles
    /// per image width, either sign) are completed; what the others hold afterwards is unspecified.
    void forward(std::span<Complex> map, std::uint32_t reach);
    void forward(std::span<Complex> map) { forward(map, width_ / 2); }

    /// Exact inverse of forward(), scaled by 1 / (width * height). Columns with a frequency above
    /// `reach` must hold zeros.
    void inverse(std::span<Complex> map, std::uint32_t reach);
    void inverse(std::span<Complex> map) { inverse(map, width_ / 2); }

  private:
    enum class Direction { forward, inverse };

    void transform_rows(std::span<Complex> map, Direction direction);
    void transform_columns(std::span<Complex> map, std::uint32_t reach, Direction direction);
    void transform_columns(std::span<Complex> map, std::uint32_t first, std::uint32_t end,
                           Direction direction);

    std::uint32_t width_;
    std::uint32_t height_;
    LineTransform row_;
    LineTransform column_;
    std::vector<Complex> block_;  ///< a few columns at a time, each contiguous
};

}  // namespace weft

#endif
