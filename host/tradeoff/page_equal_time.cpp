// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page_equal_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

#include "tradeoff/html_text.h"
#include "tradeoff/page_images.h"
#include "tradeoff/page_values.h"

namespace weft {
namespace {

/// One row of a table: another renderer, or Weft's best setting.
struct Row {
    std::string name = {};
    double seconds = 0.0;
    double samples = 0.0;
    bool denoised = false;
    bool weft = false;
    std::vector<double> errors = {};
    std::string image = {};  ///< markup
};

Row weft_row(const TradeoffResult& result, const TradeoffPoint& best) {
    const std::vector<const TradeoffPoint*> front = front_of(result);
    const auto place =
        static_cast<std::size_t>(std::find(front.begin(), front.end(), &best) - front.begin());
    Row row{.name = "Weft: " + best.name, .seconds = 1e-3 * best.ms.median, .weft = true};
    for (const ErrorMeasure measure : all_measures())
        row.errors.push_back(error_of(best, measure).median);
    row.image = front_image_again(result, place, "Image of " + best.name);
    return row;
}

/// The rows of one budget, the lowest error first and those without one last.
std::vector<Row> rows_of(const TradeoffResult& result, double budget_s) {
    std::vector<Row> rows;
    if (const TradeoffPoint* best = best_within(result, 1000.0 * budget_s))
        rows.push_back(weft_row(result, *best));
    for (std::size_t i = 0; i < result.others.size(); ++i) {
        const OtherRendererPoint& other = result.others[i];
        if (other.budget_s != budget_s) continue;
        rows.push_back(
            {.name = other.name,
             .seconds = other.seconds,
             .samples = other.samples,
             .denoised = other.denoised,
             .errors = other.errors,
             .image = shown_image(other.image, result.exposure_ev,
                                  fmt::format("other-image-{}", i + 1), "Image of " + other.name)});
    }
    std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
        const double left = error_of(a.errors, result.measure);
        const double right = error_of(b.errors, result.measure);
        if (!std::isfinite(left) || !std::isfinite(right)) return std::isfinite(left);
        return left < right;
    });
    return rows;
}

std::string table(const TradeoffResult& result, double budget_s, const std::vector<Row>& rows) {
    std::string text = "<div class=\"wide\"><table>\n";
    text += text_element("caption", fmt::format("In {} s", round_text(budget_s)));
    text +=
        "\n<thead><tr><th scope=\"col\">renderer</th><th scope=\"col\">denoised</th>"
        "<th scope=\"col\">time</th><th scope=\"col\">samples per pixel</th>";
    for (const ErrorMeasure measure : all_measures())
        text += text_element(
            "th", label(measure),
            measure == result.measure ? R"(scope="col" class="chosen")" : R"(scope="col")");
    text += "</tr></thead>\n<tbody>\n";
    for (const Row& row : rows) {
        text += row.weft ? "<tr class=\"weft\">" : "<tr>";
        text += text_element("th", row.name, R"(scope="row")");
        text += row.denoised ? "<td class=\"word\">denoised</td>" : "<td></td>";
        text += text_element("td", duration_text(1000.0 * row.seconds));
        text += text_element("td", row.samples > 0.0 ? round_text(row.samples) : "");
        for (const ErrorMeasure measure : all_measures())
            text += text_element("td", error_figure(measure, error_of(row.errors, measure)),
                                 measure == result.measure ? R"(class="chosen")" : "");
        text += "</tr>\n";
    }
    return text + "</tbody>\n</table></div>\n";
}

bool any_as_fast(const TradeoffResult& result, double ms) {
    const std::vector<const TradeoffPoint*> front = front_of(result);
    return std::any_of(front.begin(), front.end(),
                       [ms](const TradeoffPoint* point) { return point->ms.median <= ms; });
}

std::string thumbnails(const TradeoffResult& result, const std::vector<Row>& rows) {
    std::string shown;
    for (const Row& row : rows)
        if (!row.image.empty())
            shown += "<div>" + row.image +
                     text_element("span", row.name + (row.denoised ? ", denoised" : "")) +
                     "</div>\n";
    if (shown.empty()) return {};
    const std::string reference = reference_again(result);
    if (!reference.empty()) shown += "<div>" + reference + "<span>reference</span></div>\n";
    return "<div class=\"row\">\n" + shown + "</div>\n";
}

}  // namespace

std::string equal_time_section(const TradeoffResult& result) {
    if (result.others.empty() && result.other_notes.empty()) return {};
    std::string text = "<section>\n<h2>In the same time</h2>\n";
    std::set<double> budgets;
    for (const OtherRendererPoint& other : result.others)
        if (std::isfinite(other.budget_s)) budgets.insert(other.budget_s);
    if (!budgets.empty())
        text += fmt::format(
            "<p>Other renderers' images of this view, as the file that names them says, beside "
            "the setting of the front with the lowest {} whose median time is within the budget, "
            "and the end of its interval within 1.2 of it. Each table has the lowest error first. "
            "Set-up is outside of the time for all alike. "
            "Denoised images are marked; they are no estimate of the light any more.</p>\n",
            escape_markup(label(result.measure)));
    for (const double budget_s : budgets) {
        const std::vector<Row> rows = rows_of(result, budget_s);
        text += table(result, budget_s, rows);
        if (best_within(result, 1000.0 * budget_s) == nullptr)
            text += any_as_fast(result, 1000.0 * budget_s)
                        ? "<p>No setting of the front is certain enough to keep to that.</p>\n"
                        : "<p>No setting of the front is that fast.</p>\n";
        text += thumbnails(result, rows);
    }
    if (!result.other_notes.empty()) {
        text += "<ul>\n";
        for (const std::string& note : result.other_notes) text += text_element("li", note) + "\n";
        text += "</ul>\n";
    }
    return text + "</section>\n";
}

}  // namespace weft
