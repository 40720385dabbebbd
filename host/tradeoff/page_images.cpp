// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "metrics/heat_map.h"
#include "tradeoff/advice.h"
#include "tradeoff/html_text.h"
#include "tradeoff/page_values.h"
#include "tradeoff/thumbnail.h"

namespace weft {
namespace {

using Json = nlohmann::json;

constexpr double infinite_error = std::numeric_limits<double>::infinity();

/// An image that the page shows for the first time; false where there is none.
Json page_image(const Image& image, double exposure_ev, const std::string& id,
                const std::string& alt) {
    const Image small = scaled_down(image, thumbnail_edge);
    const std::string uri = image_uri(small, exposure_ev);
    if (uri.empty()) return false;
    return {{"id", id},
            {"alt", alt},
            {"uri", uri},
            {"width", std::to_string(small.width)},
            {"height", std::to_string(small.height)}};
}

/// The same image once more: the template refers to it where it has no URI of its own.
Json again(Json image, const std::string& alt) {
    if (image.is_object()) image.update({{"uri", ""}, {"alt", alt}});
    return image;
}

std::string map_gradient() {
    constexpr int stops = 16;
    std::string gradient;
    for (int i = 0; i <= stops; ++i) {
        const auto colour = viridis(static_cast<double>(i) / stops);
        gradient +=
            fmt::format("{}rgb({} {} {})", i == 0 ? "" : ", ", colour[0], colour[1], colour[2]);
    }
    return gradient;
}

/// The place in `front` of the point with the lowest error by that measure among those whose median
/// time is at most `ms`, and the end of its interval at most most_over_budget times that; the
/// number of points where there is none.
std::size_t best_within(const std::vector<const TradeoffPoint*>& front, ErrorMeasure measure,
                        double ms) {
    std::size_t best = front.size();
    double least = infinite_error;
    for (std::size_t i = 0; i < front.size(); ++i) {
        const Interval& time = front[i]->ms;
        const double error = error_of(*front[i], measure).median;
        if (!(time.median <= ms) || !(time.high <= most_over_budget * ms)) continue;
        if (!(error < least)) continue;
        best = i;
        least = error;
    }
    return best;
}

/// Another renderer, or Weft's best setting: a row of a table, and its image.
struct RendererRow {
    double error = 0.0;  ///< by the chosen measure
    Json values = {};
};

RendererRow renderer_row(const OtherRendererPoint& point, ErrorMeasure chosen, bool weft,
                         Json image) {
    const double error = error_of(point.errors, chosen);
    return {std::isfinite(error) ? error : infinite_error,
            {{"name", point.name},
             {"caption", point.name + (point.denoised ? ", denoised" : "")},
             {"weft", weft},
             {"denoised", point.denoised},
             {"time", duration_text(1000.0 * point.seconds)},
             {"samples", point.samples > 0.0 ? round_text(point.samples) : ""},
             {"errors", error_cells(point.errors, chosen, point.unbiased_relmse)},
             {"image", std::move(image)}}};
}

/// The rows of one budget, the lowest error first and those without one last; the images of those
/// that have one, with the reference; and what is to say where no setting keeps to the budget.
Json budget_values(const TradeoffResult& result, double budget_s, const Json& images) {
    const double ms = 1000.0 * budget_s;
    const std::vector<const TradeoffPoint*> front = front_of(result);
    const std::size_t place = best_within(front, result.measure, ms);
    const bool none = place == front.size();
    std::vector<RendererRow> rows;
    if (!none) {
        const TradeoffPoint& best = *front[place];
        OtherRendererPoint setting;
        setting.name = "Weft: " + best.name;
        setting.seconds = 1e-3 * best.ms.median;
        for (const ErrorMeasure measure : all_measures())
            setting.errors.push_back(error_of(best, measure).median);
        setting.unbiased_relmse = best.unbiased_relmse;
        rows.push_back(renderer_row(
            setting, result.measure, true,
            again(images["cards"][place]["thumbnails"][0]["image"], "Image of " + best.name)));
    }
    for (std::size_t i = 0; i < result.others.size(); ++i) {
        const OtherRendererPoint& other = result.others[i];
        if (other.budget_s != budget_s) continue;
        rows.push_back(renderer_row(
            other, result.measure, false,
            page_image(other.image, result.exposure_ev, fmt::format("other-image-{}", i + 1),
                       "Image of " + other.name)));
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [](const RendererRow& a, const RendererRow& b) { return a.error < b.error; });
    auto table = Json::array();
    auto thumbnails = Json::array();
    for (RendererRow& row : rows) {
        if (row.values["image"].is_object()) thumbnails.push_back(row.values);
        table.push_back(std::move(row.values));
    }
    if (!thumbnails.empty() && images["reference"].is_object())
        thumbnails.push_back(
            {{"image", again(images["reference"], "Reference")}, {"caption", "reference"}});
    const bool as_fast = std::any_of(front.begin(), front.end(), [ms](const TradeoffPoint* point) {
        return point->ms.median <= ms;
    });
    return {{"budget", round_text(budget_s)},
            {"rows", std::move(table)},
            {"uncertain", none && as_fast},
            {"too_slow", none && !as_fast},
            {"images", unless_empty(std::move(thumbnails))}};
}

}  // namespace

nlohmann::json images_values(const TradeoffResult& result) {
    const std::vector<const TradeoffPoint*> front = front_of(result);
    std::vector<Image> maps;
    for (const TradeoffPoint* point : front)
        maps.push_back(scaled_map(point->error_map, result.width, result.height, thumbnail_edge));
    const double high = map_scale(maps);
    const Json reference = page_image(result.reference.image, result.exposure_ev, "reference-image",
                                      "Reference image");
    auto cards = Json::array();
    for (std::size_t i = 0; i < front.size(); ++i) {
        const TradeoffPoint& point = *front[i];
        Json image = page_image(point.image, result.exposure_ev,
                                fmt::format("front-image-{}", i + 1), "Image of " + point.name);
        Json map = page_image(map_colours(maps[i], high), 0.0, fmt::format("front-map-{}", i + 1),
                              "Error map of " + point.name);
        cards.push_back(
            {{"name", point.name},
             {"time", duration_text(point.ms.median)},
             {"error", error_figure(result.measure, error_of(point, result.measure).median)},
             {"thumbnails",
              {{{"image", std::move(image)}, {"caption", "image"}},
               {{"image", again(reference, "Reference")}, {"caption", "reference"}},
               {{"image", std::move(map)}, {"caption", "error"}}}}});
    }
    return {{"exposure", round_text(result.exposure_ev)},
            {"map_end", round_text(high)},
            {"map_gradient", map_gradient()},
            {"reference", reference},
            {"cards", std::move(cards)}};
}

nlohmann::json equal_time_values(const TradeoffResult& result, const nlohmann::json& images) {
    if (result.others.empty() && result.other_notes.empty()) return false;
    std::set<double> budgets;
    for (const OtherRendererPoint& other : result.others)
        if (std::isfinite(other.budget_s)) budgets.insert(other.budget_s);
    auto tables = Json::array();
    for (const double budget_s : budgets) tables.push_back(budget_values(result, budget_s, images));
    return {{"budgets", unless_empty(std::move(tables))},
            {"notes", unless_empty(result.other_notes)}};
}

}  // namespace weft
