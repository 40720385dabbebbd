// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_SVG_PLOT_H
#define WEFT_TRADEOFF_SVG_PLOT_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tradeoff/plot_axis.h"

namespace weft {

/// Ends of an error bar.
struct PlotBar {
    double low = 0.0;
    double high = 0.0;
};

/// A point. One that has no place on the axes is left out of the plot, which then says so.
struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
    std::optional<PlotBar> x_bar = {};  ///< left out where an end has no place
    std::optional<PlotBar> y_bar = {};
    std::string tooltip = {};
    bool marked = false;  ///< drawn with a ring around it
};

/// Points of one colour and shape.
struct PlotSeries {
    std::string name = {};  ///< for the legend
    /// Chooses colour and shape, so that a series looks the same in several plots.
    std::size_t style = 0;
    std::vector<PlotPoint> points = {};
    bool line = false;     ///< joins the points in their order
    bool markers = true;   ///< false: only the line
    bool hollow = false;   ///< markers are outlines
    bool neutral = false;  ///< in the colour of text instead of its own
};

/// A horizontal line across the plot.
struct PlotLevel {
    std::string name;
    double y = 0.0;
};

/// Label, unit and scale of an axis.
struct PlotScale {
    std::string label = {};
    std::string unit = {};  ///< in brackets behind the label; empty for none
    AxisScale scale = AxisScale::logarithmic;
};

/// One plot.
struct Plot {
    std::string title;
    std::string description;  ///< text alternative for those who cannot see the plot
    double width = 860.0;     ///< units of the drawing, which scales to the space it gets
    double height = 480.0;
    PlotScale x;
    PlotScale y;
    std::vector<PlotSeries> series;
    std::vector<PlotLevel> levels;
    bool legend = true;
    std::string marked;  ///< legend text for marked points; empty for none
};

/// The rectangle that the axes span, in units of the drawing.
struct PlotFrame {
    double left = 0.0;
    double top = 0.0;
    double width = 0.0;
    double height = 0.0;
};

/// Where svg_plot draws the points of a plot.
[[nodiscard]] PlotFrame plot_frame(const Plot& plot);

/// The axis that svg_plot draws, which covers all points, levels, and bars unless these are far
/// longer than the rest of the plot.
[[nodiscard]] PlotAxis horizontal_axis(const Plot& plot);
[[nodiscard]] PlotAxis vertical_axis(const Plot& plot);

/// The plot as an SVG element, whose colours and fonts come from plot_style. The same plot gives
/// the same text.
[[nodiscard]] std::string svg_plot(const Plot& plot);

/// CSS that every page with plots needs once: colours for light and dark that can be told apart
/// without colour vision, as custom properties, and rules for the elements of plots.
[[nodiscard]] std::string_view plot_style();

}  // namespace weft

#endif
