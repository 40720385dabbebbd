// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PLOT_AXIS_H
#define WEFT_TRADEOFF_PLOT_AXIS_H

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft {

enum class AxisScale : std::uint8_t { linear, logarithmic };

/// Whether a value has a place on an axis: finite, on a logarithmic one above 0, and of a magnitude
/// that leaves room for arithmetic (at most 1e300, and at least 1e-300 where logarithmic).
[[nodiscard]] bool has_place(double value, AxisScale scale);

/// A mark of an axis.
struct AxisTick {
    double value = 0.0;
    std::string text;  ///< empty where only a line is drawn
};

/// The range of numbers that an axis shows, and its ticks.
class PlotAxis {
  public:
    /// Covers those values that have a place, with a little room on both sides, or 1 to 10 (0 to 1
    /// where linear) where there are none. A linear axis of values that are not negative starts at
    /// 0.
    PlotAxis(AxisScale scale, std::span<const double> values);

    /// Where a value lies, from 0 at the low end to 1 at the high one, clamped to these. The value
    /// must have a place.
    [[nodiscard]] double position(double value) const;
    [[nodiscard]] const std::vector<AxisTick>& ticks() const { return ticks_; }
    [[nodiscard]] double low() const;
    [[nodiscard]] double high() const;

  private:
    [[nodiscard]] double along(double value) const;

    AxisScale scale_;
    double start_ = 0.0;  ///< of decimal logarithms where logarithmic
    double end_ = 1.0;
    std::vector<AxisTick> ticks_;
};

}  // namespace weft

#endif
