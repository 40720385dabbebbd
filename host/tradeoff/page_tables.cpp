// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page_tables.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "tradeoff/html_text.h"
#include "tradeoff/page_values.h"

namespace weft {
namespace {

/// Headings of the measures, the chosen one marked.
std::string measure_headings(ErrorMeasure chosen) {
    std::string text;
    for (const ErrorMeasure measure : all_measures())
        text +=
            text_element("th", label(measure),
                         measure == chosen ? R"(scope="col" class="chosen")" : R"(scope="col")");
    return text;
}

std::string error_cells(const TradeoffPoint& point, ErrorMeasure chosen) {
    std::string text;
    for (const ErrorMeasure measure : all_measures())
        text += fmt::format("<td{}>{}</td>", measure == chosen ? R"( class="chosen")" : "",
                            error_cell(measure, error_of(point, measure)));
    return text;
}

std::string floor_row(const TradeoffResult& result) {
    std::string text = text_element("th",
                                    fmt::format("reference, {} samples per pixel: noise floor",
                                                count_text(result.reference.samples)),
                                    R"(scope="row")") +
                       "<td></td>";
    for (const ErrorMeasure measure : all_measures())
        text += fmt::format("<td{}>{}</td>", measure == result.measure ? R"( class="chosen")" : "",
                            error_figure(measure, error_of(result.reference.noise_floor, measure)));
    return "<tr>" + text + "<td></td></tr>\n";
}

std::string check_paragraph(const FrontCheck& check) {
    return fmt::format(
        "<p>After everything else was decided, the front was rendered again with new seeds: of {} "
        "images {} kept to the interval of their setting's time, and {} to that of its "
        "error.</p>\n",
        check.images, check.times_within, check.errors_within);
}

std::string skipped_paragraph(const std::vector<std::string>& skipped) {
    if (skipped.empty()) return {};
    std::string names;
    for (const std::string& name : skipped) names += (names.empty() ? "" : ", ") + name;
    return text_element("p", "Too slow to be measured: " + names + ".") + "\n";
}

}  // namespace

std::string front_section(const TradeoffResult& result) {
    std::string text = "<section>\n<h2>The front</h2>\n";
    text += fmt::format(
        "<p>Settings that no other beats both in time and by {}, with the interval that holds one "
        "more measurement with a confidence of 95 % below each median. The last line compares one "
        "half of the reference's samples with the other, which is twice the noise of the whole "
        "reference, and in relMSE four times.</p>\n",
        escape_markup(label(result.measure)));
    text += "<div class=\"wide\"><table>\n<caption>Pareto front by rising time</caption>\n";
    text += "<thead><tr><th scope=\"col\">setting</th><th scope=\"col\">time</th>" +
            measure_headings(result.measure) +
            "<th scope=\"col\">rays of an image</th></tr></thead>\n<tbody>\n";
    for (const TradeoffPoint* point : front_of(result))
        text += "<tr>" + text_element("th", point->name, R"(scope="row")") + "<td>" +
                time_cell(point->ms) + "</td>" + error_cells(*point, result.measure) + "<td>" +
                count_text(point->rays) + "</td></tr>\n";
    return text + "</tbody>\n<tfoot>\n" + floor_row(result) + "</tfoot>\n</table></div>\n" +
           (result.check ? check_paragraph(*result.check) : "") + "</section>\n";
}

std::string points_section(const TradeoffResult& result) {
    std::string text = "<section>\n<h2>All settings</h2>\n<details>\n";
    text += fmt::format("<summary>{} settings</summary>\n", count_text(result.points.size()));
    text +=
        "<div class=\"wide\"><table>\n<caption>All settings by rising time</caption>\n"
        "<thead><tr><th scope=\"col\">setting</th><th scope=\"col\">family</th>"
        "<th scope=\"col\">on the front</th><th scope=\"col\">time</th>" +
        measure_headings(result.measure) +
        "<th scope=\"col\">rays of an image</th></tr></thead>\n<tbody>\n";
    for (const TradeoffPoint& point : result.points)
        text += "<tr>" + text_element("th", point.name, R"(scope="row")") +
                text_element("td", point.family, R"(class="word")") + "<td class=\"word\">" +
                (point.on_front ? "yes" : "") + "</td><td>" + time_cell(point.ms) + "</td>" +
                error_cells(point, result.measure) + "<td>" + count_text(point.rays) +
                "</td></tr>\n";
    return text + "</tbody>\n</table></div>\n</details>\n" + skipped_paragraph(result.skipped) +
           "</section>\n";
}

}  // namespace weft
