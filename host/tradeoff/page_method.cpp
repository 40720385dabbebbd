// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page_method.h"

#include <fmt/format.h>

#include "tradeoff/html_text.h"

namespace weft {
namespace {

/// A value of JSON in one line; objects within objects stay JSON.
std::string value_text(const nlohmann::json& value) {
    using nlohmann::json;
    if (value.is_string()) return value.get<std::string>();
    return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string fact_row(const std::string& name, const nlohmann::json& value) {
    return "<tr>" + text_element("th", name, R"(scope="row")") +
           text_element("td", value_text(value)) + "</tr>\n";
}

std::string machine_table(const nlohmann::json& machine) {
    if (!machine.is_object() || machine.empty()) return {};
    std::string text =
        "<table class=\"facts\">\n<caption>Machine and versions</caption>\n<tbody>\n";
    for (const auto& [name, value] : machine.items()) {
        if (!value.is_object()) {
            text += fact_row(name, value);
            continue;
        }
        for (const auto& [part, inner] : value.items()) text += fact_row(name + " " + part, inner);
    }
    return text + "</tbody>\n</table>\n";
}

std::string intervals_paragraph(const TimeSpread& spread) {
    std::string text =
        "<p>Figures are medians. An interval holds one further image's measurement with a "
        "confidence of 95 %. ";
    if (spread.deviations > 0)
        text += fmt::format(
            "That of a time is the median divided and multiplied by {}, which the deviations of "
            "all {} times from the others of their setting call for; a setting that scatters more "
            "than that has an interval by its own times. Of the machine, intervals know what it "
            "did while it measured. ",
            escape_markup(figure_text(spread.factor)), count_text(spread.deviations));
    return text +
           "That of an error is by Student's distribution of its logarithms; of biases, and where "
           "one of them is 0, of the values themselves. All errors are those of the beauty layer "
           "against the reference; 0 is a perfect image.</p>\n";
}

constexpr const char* meanings =
    "<dl>\n"
    "<dt>HDR-FLIP</dt><dd>What a person sees when flipping between image and reference, over "
    "all exposures that show something; the mean over the pixels, from 0 to 1.</dd>\n"
    "<dt>HDR-VDP</dt><dd>Percent of the pixels that a person sees to differ with a probability of "
    "at least 75 or 95 %: with radiance taken as cd/m² (published protocol), and on a display "
    "with 100 cd/m² at the value 1.</dd>\n"
    "<dt>relMSE</dt><dd>Mean of the squared error over the squared reference.</dd>\n"
    "<dt>bias</dt><dd>Magnitude of the relative error of the image's mean.</dd>\n"
    "</dl>\n";

}  // namespace

std::string method_section(const TradeoffResult& result) {
    std::string text = "<section>\n<h2>How it was measured</h2>\n";
    text += fmt::format(
        "<p>Every setting rendered {} images, each with a seed of its own. The settings took "
        "turns, so that whatever else the machine did met all alike. Time is wall time of the "
        "frames of an image; loading the scene, building the acceleration structure and the "
        "kernels, and writing files are not part of it, for any renderer.</p>\n",
        result.repetitions);
    text += intervals_paragraph(result.time_spread);
    text += meanings;
    text += machine_table(result.machine);
    if (!result.command.empty())
        text +=
            "<h3>To do it again</h3>\n<pre>" + text_element("code", result.command) + "</pre>\n";
    return text + "</section>\n";
}

}  // namespace weft
