// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/svg_plot.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace weft::svg_plot_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A plot as a program that shows it reads it.
class Drawn {
  public:
    explicit Drawn(const Plot& plot) : text_(svg_plot(plot)) {
        const pugi::xml_parse_result result =
            xml_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
        EXPECT_TRUE(result) << result.description();
    }
    [[nodiscard]] std::size_t count(const std::string& path) const {
        return xml_.select_nodes(path.c_str()).size();
    }
    [[nodiscard]] pugi::xml_node first(const std::string& path) const {
        return xml_.select_node(path.c_str()).node();
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_;
    pugi::xml_document xml_;
};

Plot plot_of(std::vector<PlotPoint> points) {
    Plot plot;
    plot.title = "a plot";
    plot.x = {.label = "time", .unit = "ms"};
    plot.y = {.label = "error"};
    plot.series.push_back({.name = "one", .points = std::move(points)});
    plot.legend = false;
    return plot;
}

TEST(SvgPlot, PutsPointsWhereTheirLogarithmsLie) {
    const Plot plot =
        plot_of({{.x = 10.0, .y = 0.01}, {.x = 100.0, .y = 0.1}, {.x = 1000.0, .y = 1.0}});
    const Drawn drawn(plot);
    const PlotFrame frame = plot_frame(plot);
    // Two decades and 4 % of them on either side: 0.08 of 2.16 decades.
    for (int i = 0; i < 3; ++i) {
        const double share = (0.08 + i) / 2.16;
        const std::string place =
            fmt::format("translate({:.2f} {:.2f})", frame.left + share * frame.width,
                        frame.top + (1.0 - share) * frame.height);
        EXPECT_EQ(drawn.count("//g[@transform='" + place + "']"), 1U) << place;
    }
}

TEST(SvgPlot, PointsAtTicksLieOnTheirLines) {
    const Plot plot = plot_of({{.x = 10.0, .y = 0.01}, {.x = 1000.0, .y = 1.0}});
    const Drawn drawn(plot);
    const pugi::xml_node label = drawn.first("//text[.='1000']");
    ASSERT_TRUE(label);
    const std::string x = label.attribute("x").value();
    EXPECT_EQ(drawn.count("//line[@class='plot-grid'][@x1='" + x + "'][@x2='" + x + "']"), 1U);
    EXPECT_EQ(drawn.count("//g[starts-with(@transform, 'translate(" + x + " ')]"), 1U);
}

TEST(SvgPlot, LeavesOutWhatHasNoPlaceAndSaysSo) {
    const double nan = std::nan("");
    Plot plot =
        plot_of({{.x = 1.0, .y = 1.0, .x_bar = PlotBar{nan, 2.0}, .y_bar = PlotBar{0.0, infinity}},
                 {.x = nan, .y = 1.0},
                 {.x = 1.0, .y = infinity},
                 {.x = 0.0, .y = 1.0}});
    plot.levels = {{"none", 0.0}, {"neither", nan}};
    const Drawn drawn(plot);
    EXPECT_EQ(drawn.count("//g"), 1U);
    EXPECT_EQ(drawn.count("//path[starts-with(@class, 'plot-bar')]"), 0U);
    EXPECT_EQ(drawn.count("//line[@class='plot-level']"), 0U);
    EXPECT_NE(drawn.text().find("3 points have no place on these axes"), std::string::npos);
    EXPECT_EQ(drawn.text().find("nan"), std::string::npos);
    EXPECT_EQ(drawn.text().find("inf"), std::string::npos);
}

TEST(SvgPlot, DrawsBarsLinesLevelsAndMarks) {
    Plot plot = plot_of({{.x = 10.0,
                          .y = 1.0,
                          .x_bar = PlotBar{9.0, 11.0},
                          .y_bar = PlotBar{0.9, 1.1},
                          .tooltip = "here",
                          .marked = true},
                         {.x = 20.0, .y = 0.5}});
    plot.series[0].line = true;
    plot.levels = {{"floor", 0.1}};
    plot.legend = true;
    plot.marked = "ringed";
    const Drawn drawn(plot);
    EXPECT_EQ(drawn.count("//path[starts-with(@class, 'plot-bar')]"), 1U);
    EXPECT_EQ(drawn.count("//polyline"), 1U);
    EXPECT_EQ(drawn.count("//line[@class='plot-level']"), 1U);
    EXPECT_EQ(drawn.count("//g/circle[@class='plot-ring']"), 1U);
    EXPECT_STREQ(drawn.first("//g/title").text().get(), "here");
    EXPECT_EQ(drawn.count("//text[.='one']"), 1U);
    EXPECT_EQ(drawn.count("//text[.='ringed']"), 1U);
    EXPECT_EQ(drawn.count("//text[.='time (ms)']"), 1U);
}

TEST(SvgPlot, EscapesAllText) {
    const std::string hostile = "<script>\"'&]]>";
    Plot plot = plot_of({{.x = 1.0, .y = 1.0, .tooltip = hostile}});
    plot.title = plot.description = plot.x.label = plot.y.unit = plot.marked = hostile;
    plot.series[0].name = hostile;
    plot.levels = {{hostile, 1.0}};
    plot.legend = true;
    const Drawn drawn(plot);
    EXPECT_EQ(drawn.count("//script"), 0U);
    EXPECT_EQ(std::string(drawn.first("//title").text().get()), hostile);
    EXPECT_EQ(drawn.text().find("<script"), std::string::npos);
}

TEST(SvgPlot, SeriesLookDifferent) {
    Plot plot = plot_of({});
    plot.series.clear();
    for (std::size_t i = 0; i < 24; ++i)
        plot.series.push_back({.name = "s", .style = i, .points = {{.x = 1.0, .y = 1.0}}});
    const Drawn drawn(plot);
    std::set<std::string> looks;
    pugi::xml_document xml;
    ASSERT_TRUE(xml.load_string(drawn.text().c_str()));
    for (const pugi::xpath_node& group : xml.select_nodes("//g")) {
        std::ostringstream shape;
        group.node().first_child().print(shape);
        looks.insert(group.node().attribute("class").value() + shape.str());
    }
    EXPECT_EQ(looks.size(), 24U);
}

TEST(SvgPlot, DrawsNothingSinglesAndEquals) {
    EXPECT_EQ(Drawn(plot_of({})).count("//g"), 0U);
    EXPECT_EQ(Drawn(plot_of({{.x = 3.0, .y = 3.0}})).count("//g"), 1U);
    EXPECT_EQ(Drawn(plot_of({{.x = 3.0, .y = 3.0}, {.x = 3.0, .y = 3.0}})).count("//g"), 2U);
    const Plot plot = plot_of({{.x = 3.0, .y = 7.0}, {.x = 5.0, .y = 2.0}});
    EXPECT_EQ(svg_plot(plot), svg_plot(plot));
}

TEST(SvgPlot, ALegendWithoutRoomForAllSaysSo) {
    Plot plot = plot_of({{.x = 1.0, .y = 1.0}});
    plot.legend = true;
    plot.marked = "marked";
    for (int i = 2; i <= 100; ++i) plot.series.push_back({.name = fmt::format("series {}", i)});
    const Drawn drawn(plot);
    std::size_t names = drawn.count("//text[.='one']");
    for (int i = 2; i <= 100; ++i) names += drawn.count(fmt::format("//text[.='series {}']", i));
    EXPECT_GE(names, 10U);
    EXPECT_LT(names, 100U);
    EXPECT_EQ(drawn.count(fmt::format("//text[.='and {} more']", 100 - names)), 1U);
    EXPECT_LE(drawn.first("//text[.='marked']").attribute("y").as_double(), plot.height);
    plot.series.resize(names);
    EXPECT_EQ(Drawn(plot).count("//text[starts-with(., 'and ')]"), 0U);
}

}  // namespace
}  // namespace weft::svg_plot_test
