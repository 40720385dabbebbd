// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tradeoff/html_text.h"

namespace weft {
namespace {

constexpr std::size_t colours = 8;
constexpr std::size_t longest_name = 30;  ///< characters of a legend entry
constexpr double character_width = 6.9;   ///< of most letters in the plot's font
constexpr double legend_row = 19.0;

// Markers around the origin, of about the same area.
constexpr std::array<std::string_view, 8> shapes = {
    R"(<circle r="4.2"/>)",
    R"(<rect x="-3.8" y="-3.8" width="7.6" height="7.6"/>)",
    R"(<path d="M0 -5.2L5 3.7H-5Z"/>)",
    R"(<path d="M0 -5.6L5.6 0L0 5.6L-5.6 0Z"/>)",
    R"(<path d="M0 5.2L5 -3.7H-5Z"/>)",
    R"(<path d="M-1.8 -5H1.8V-1.8H5V1.8H1.8V5H-1.8V1.8H-5V-1.8H-1.8Z"/>)",
    R"-(<path d="M-1.8 -5H1.8V-1.8H5V1.8H1.8V5H-1.8V1.8H-5V-1.8H-1.8Z" transform="rotate(45)"/>)-",
    R"(<path d="M-5 0L-2.5 -4.4H2.5L5 0L2.5 4.4H-2.5Z"/>)"};

/// The marker of a series: once all colours are used, they begin again with other shapes.
std::string_view shape_of(const PlotSeries& series) {
    return shapes[(series.style + series.style / colours) % shapes.size()];
}

std::string classes_of(const PlotSeries& series) {
    return series.neutral ? "series-neutral" : fmt::format("series-{}", series.style % colours);
}

/// Draws one plot, part by part.
class PlotWriter {
  public:
    explicit PlotWriter(const Plot& plot)
        : plot_(plot),
          frame_(plot_frame(plot)),
          x_(horizontal_axis(plot)),
          y_(vertical_axis(plot)) {}

    std::string write() {
        const std::string spoken =
            plot_.description.empty() ? plot_.title : plot_.title + ". " + plot_.description;
        add(R"(<svg xmlns="http://www.w3.org/2000/svg" class="plot" viewBox="0 0 {:g} {:g}" )",
            plot_.width, plot_.height);
        add("role=\"img\" aria-label=\"{}\">\n", escape_markup(spoken));
        add("{}\n",
            text_element("text", plot_.title,
                         fmt::format(R"(class="plot-title" x="{:.2f}" y="18")", frame_.left)));
        horizontal_ticks();
        vertical_ticks();
        add(R"(<rect class="plot-axis" x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}"/>)",
            frame_.left, frame_.top, frame_.width, frame_.height);
        svg_ += '\n';
        for (const PlotLevel& level : plot_.levels) draw(level);
        for (const PlotSeries& series : plot_.series) draw_bars(series);
        for (const PlotSeries& series : plot_.series) draw_line(series);
        for (const PlotSeries& series : plot_.series) draw_points(series);
        for (const PlotLevel& level : plot_.levels) draw_name(level);
        note_what_is_missing();
        if (plot_.legend) draw_legend();
        return std::move(svg_) + "</svg>\n";
    }

  private:
    template <typename... Values>
    void add(fmt::format_string<Values...> format, Values&&... values) {
        svg_ += fmt::format(format, std::forward<Values>(values)...);
    }

    [[nodiscard]] double across(double x) const {
        return frame_.left + x_.position(x) * frame_.width;
    }
    [[nodiscard]] double down(double y) const {
        return frame_.top + (1.0 - y_.position(y)) * frame_.height;
    }
    [[nodiscard]] bool fits(const PlotPoint& point) const {
        return has_place(point.x, plot_.x.scale) && has_place(point.y, plot_.y.scale);
    }

    void grid_line(bool named, double x1, double y1, double x2, double y2) {
        add(R"(<line class="{}" x1="{:.2f}" y1="{:.2f}" x2="{:.2f}" y2="{:.2f}"/>)",
            named ? "plot-grid" : "plot-fine", x1, y1, x2, y2);
        svg_ += '\n';
    }

    void horizontal_ticks() {
        const double bottom = frame_.top + frame_.height;
        double last_end = -plot_.width;
        for (const AxisTick& tick : x_.ticks()) {
            const double x = across(tick.value);
            grid_line(!tick.text.empty(), x, frame_.top, x, bottom);
            const double half = 0.5 * character_width * static_cast<double>(tick.text.size());
            if (tick.text.empty() || x - half < last_end) continue;
            last_end = x + half + character_width;
            add(R"(<text class="plot-tick" x="{:.2f}" y="{:.2f}" text-anchor="middle">{}</text>)",
                x, bottom + 16.0, tick.text);
            svg_ += '\n';
        }
        axis_label(plot_.x, fmt::format(R"(x="{:.2f}" y="{:.2f}" text-anchor="middle")",
                                        frame_.left + 0.5 * frame_.width, bottom + 36.0));
    }

    void vertical_ticks() {
        for (const AxisTick& tick : y_.ticks()) {
            const double y = down(tick.value);
            grid_line(!tick.text.empty(), frame_.left, y, frame_.left + frame_.width, y);
            if (tick.text.empty()) continue;
            add(R"(<text class="plot-tick" x="{:.2f}" y="{:.2f}" text-anchor="end">{}</text>)",
                frame_.left - 7.0, y + 4.0, tick.text);
            svg_ += '\n';
        }
        axis_label(plot_.y, fmt::format(R"-(transform="translate(15 {:.2f}) rotate(-90)" )-"
                                        R"(text-anchor="middle")",
                                        frame_.top + 0.5 * frame_.height));
    }

    void axis_label(const PlotScale& scale, const std::string& attributes) {
        const std::string unit = scale.unit.empty() ? "" : " (" + scale.unit + ")";
        svg_ += text_element("text", scale.label + unit, attributes) + "\n";
    }

    void draw(const PlotLevel& level) {
        if (!has_place(level.y, plot_.y.scale)) return;
        const double y = down(level.y);
        add(R"(<line class="plot-level" x1="{:.2f}" y1="{:.2f}" x2="{:.2f}" y2="{:.2f}"/>)",
            frame_.left, y, frame_.left + frame_.width, y);
        svg_ += '\n';
    }

    /// Comes last, since points would hide it.
    void draw_name(const PlotLevel& level) {
        if (!has_place(level.y, plot_.y.scale)) return;
        const double y = down(level.y);
        svg_ += text_element("text", level.name,
                             fmt::format(R"(class="plot-note" x="{:.2f}" y="{:.2f}")",
                                         frame_.left + 6.0, y - 5.0)) +
                "\n";
    }

    void draw_bars(const PlotSeries& series) {
        const auto whole = [](const std::optional<PlotBar>& bar, AxisScale scale) {
            return bar && has_place(bar->low, scale) && has_place(bar->high, scale);
        };
        std::string path;
        for (const PlotPoint& point : series.points) {
            if (!fits(point)) continue;
            const double x = across(point.x);
            const double y = down(point.y);
            // An end of a bar beyond the axis gets no mark.
            if (whole(point.x_bar, plot_.x.scale)) {
                const auto& [low, high] = *point.x_bar;
                if (low >= x_.low()) path += fmt::format("M{:.2f} {:.2f}v6", across(low), y - 3.0);
                path += fmt::format("M{:.2f} {:.2f}H{:.2f}", across(low), y, across(high));
                if (high <= x_.high()) path += "m0 -3v6";
            }
            if (whole(point.y_bar, plot_.y.scale)) {
                const auto& [low, high] = *point.y_bar;
                if (low >= y_.low()) path += fmt::format("M{:.2f} {:.2f}h6", x - 3.0, down(low));
                path += fmt::format("M{:.2f} {:.2f}V{:.2f}", x, down(low), down(high));
                if (high <= y_.high()) path += "m-3 0h6";
            }
        }
        if (path.empty()) return;
        add("<path class=\"plot-bar {}\" d=\"{}\"/>\n", classes_of(series), path);
    }

    void draw_line(const PlotSeries& series) {
        if (!series.line) return;
        std::string places;
        for (const PlotPoint& point : series.points)
            if (fits(point))
                places += fmt::format("{}{:.2f},{:.2f}", places.empty() ? "" : " ", across(point.x),
                                      down(point.y));
        if (places.empty()) return;
        add("<polyline class=\"plot-line {}\" points=\"{}\"/>\n", classes_of(series), places);
    }

    void marker(const PlotSeries& series, double x, double y, const std::string& before) {
        add(R"-(<g class="{} {}" transform="translate({:.2f} {:.2f})">{}{}</g>)-",
            series.hollow ? "plot-hollow" : "plot-point", classes_of(series), x, y, before,
            shape_of(series));
        svg_ += '\n';
    }

    void draw_points(const PlotSeries& series) {
        if (!series.markers) return;
        for (const PlotPoint& point : series.points) {
            if (!fits(point)) continue;
            std::string before = point.tooltip.empty() ? "" : text_element("title", point.tooltip);
            if (point.marked) before += R"(<circle class="plot-ring" r="8"/>)";
            marker(series, across(point.x), down(point.y), before);
        }
    }

    void note_what_is_missing() {
        std::size_t missing = 0;
        for (const PlotSeries& series : plot_.series)
            if (series.markers)
                missing += static_cast<std::size_t>(
                    std::count_if(series.points.begin(), series.points.end(),
                                  [this](const PlotPoint& point) { return !fits(point); }));
        if (missing == 0) return;
        add(R"(<text class="plot-note" x="{:.2f}" y="29" text-anchor="end">)",
            frame_.left + frame_.width);
        add("{} {} no place on these axes</text>\n", missing,
            missing == 1 ? "point has" : "points have");
    }

    /// How many series have room in the legend from `y` down; where not all have, one row is kept
    /// to say so.
    [[nodiscard]] std::size_t legend_entries(double y) const {
        const double room = std::max(0.0, (plot_.height - y) / legend_row);
        const std::size_t rows = static_cast<std::size_t>(room);
        const std::size_t others = plot_.marked.empty() ? 0 : 1;
        if (plot_.series.size() + others <= rows) return plot_.series.size();
        return rows > others + 1 ? rows - others - 1 : 0;
    }

    void draw_legend() {
        const double x = frame_.left + frame_.width + 24.0;
        double y = frame_.top + 8.0;
        const auto name = [&](const std::string& text) {
            svg_ += text_element("text", cut_text(text, longest_name),
                                 fmt::format(R"(x="{:.2f}" y="{:.2f}")", x + 18.0, y + 4.0)) +
                    "\n";
            y += legend_row;
        };
        const std::size_t shown = legend_entries(y);
        for (std::size_t i = 0; i < shown; ++i) {
            const PlotSeries& series = plot_.series[i];
            if (series.line)
                add("<path class=\"plot-line {}\" d=\"M{:.2f} {:.2f}h20\"/>\n", classes_of(series),
                    x - 10.0, y);
            if (series.markers) marker(series, x, y, "");
            name(series.name);
        }
        if (shown < plot_.series.size())
            name(fmt::format("and {} more", plot_.series.size() - shown));
        if (plot_.marked.empty()) return;
        add("<circle class=\"plot-ring\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"8\"/>\n", x, y);
        name(plot_.marked);
    }

    const Plot& plot_;
    PlotFrame frame_;
    PlotAxis x_;
    PlotAxis y_;
    std::string svg_;
};

/// An axis that covers `values`, one coordinate of the points that are drawn, and the ends of their
/// bars as far as these do not widen the axis much.
PlotAxis covering_axis(const Plot& plot, AxisScale scale, double PlotPoint::*coordinate,
                       std::optional<PlotBar> PlotPoint::*bar, std::vector<double> values) {
    std::vector<double> ends;
    for (const PlotSeries& series : plot.series)
        for (const PlotPoint& point : series.points) {
            if (!has_place(point.x, plot.x.scale) || !has_place(point.y, plot.y.scale)) continue;
            values.push_back(point.*coordinate);
            if (const auto& both = point.*bar) ends.insert(ends.end(), {both->low, both->high});
        }
    const PlotAxis bare(scale, values);
    const bool logarithmic = scale == AxisScale::logarithmic;
    const double span = bare.high() - bare.low();
    const double low = logarithmic ? bare.low() / 10.0 : bare.low() - span;
    const double high = logarithmic ? bare.high() * 10.0 : bare.high() + span;
    for (const double end : ends)
        if (has_place(end, scale)) values.push_back(std::clamp(end, low, high));
    return {scale, values};
}

}  // namespace

PlotFrame plot_frame(const Plot& plot) {
    constexpr double left = 66.0;
    constexpr double top = 32.0;
    constexpr double bottom = 46.0;
    double right = 14.0;
    if (plot.legend) {
        std::size_t longest = plot.marked.size();
        for (const PlotSeries& series : plot.series)
            longest = std::max(longest, series.name.size());
        right = 48.0 + character_width * static_cast<double>(std::min(longest, longest_name));
    }
    return {left, top, std::max(10.0, plot.width - left - right),
            std::max(10.0, plot.height - top - bottom)};
}

PlotAxis horizontal_axis(const Plot& plot) {
    return covering_axis(plot, plot.x.scale, &PlotPoint::x, &PlotPoint::x_bar, {});
}

PlotAxis vertical_axis(const Plot& plot) {
    std::vector<double> levels;
    for (const PlotLevel& level : plot.levels) levels.push_back(level.y);
    return covering_axis(plot, plot.y.scale, &PlotPoint::y, &PlotPoint::y_bar, std::move(levels));
}

std::string svg_plot(const Plot& plot) {
    return PlotWriter(plot).write();
}

}  // namespace weft
