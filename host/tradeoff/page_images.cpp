// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/page_images.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "metrics/heat_map.h"
#include "tradeoff/html_text.h"
#include "tradeoff/page_values.h"
#include "tradeoff/thumbnail.h"

namespace weft {
namespace {

constexpr const char* reference_id = "reference-image";

std::string frame(const Image& small, const std::string& alt, const std::string& content) {
    return fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" class="image" viewBox="0 0 {0} {1}" )"
        R"(width="{0}" height="{1}" role="img" aria-label="{2}">{3}</svg>)",
        small.width, small.height, escape_markup(alt), content);
}

std::string first_time(const Image& small, double exposure_ev, const std::string& id,
                       const std::string& alt) {
    const std::string uri = image_uri(small, exposure_ev);
    if (uri.empty()) return {};
    return frame(small, alt,
                 fmt::format(R"(<image id="{}" width="{}" height="{}" href="{}"/>)", id,
                             small.width, small.height, uri));
}

/// Shows an image again by a reference, so that its bytes are in the page only once.
std::string again(const Image& image, const std::string& id, const std::string& alt) {
    const Image small = scaled_down(image, thumbnail_edge);
    if (small.layers.empty()) return {};
    return frame(small, alt, fmt::format(R"(<use href="#{}"/>)", id));
}

std::string front_id(std::size_t place) {
    return fmt::format("front-image-{}", place + 1);
}

/// An image with a caption below.
std::string captioned(const std::string& image, const std::string& caption) {
    const std::string shown =
        image.empty() ? text_element("span", "no image", R"(class="none")") : image;
    return "<div>" + shown + text_element("span", caption) + "</div>\n";
}

std::string scale_bar(double high) {
    constexpr int stops = 16;
    std::string gradient;
    for (int i = 0; i <= stops; ++i) {
        const auto colour = viridis(static_cast<double>(i) / stops);
        gradient +=
            fmt::format("{}rgb({} {} {})", i == 0 ? "" : ", ", colour[0], colour[1], colour[2]);
    }
    return fmt::format(
        "<p class=\"scale\"><span>0</span><span class=\"bar\" role=\"img\" aria-label=\"Colours "
        "from dark violet by way of green to yellow\" style=\"background: linear-gradient(to "
        "right, {})\"></span><span>{} and above</span></p>\n",
        gradient, round_text(high));
}

std::string figure(const TradeoffResult& result, const TradeoffPoint& point, std::size_t place,
                   const Image& map, double high) {
    const std::string image =
        shown_image(point.image, result.exposure_ev, front_id(place), "Image of " + point.name);
    const std::string colours =
        first_time(map_colours(map, high), 0.0, fmt::format("front-map-{}", place + 1),
                   "Error map of " + point.name);
    return "<figure class=\"images\">\n" +
           text_element(
               "figcaption",
               fmt::format("{}: {}, {} {}", point.name, duration_text(point.ms.median),
                           label(result.measure),
                           error_figure(result.measure, error_of(point, result.measure).median))) +
           "\n<div class=\"row\">\n" + captioned(image, "image") +
           captioned(reference_again(result), "reference") + captioned(colours, "error") +
           "</div>\n</figure>\n";
}

}  // namespace

std::string shown_image(const Image& image, double exposure_ev, const std::string& id,
                        const std::string& alt) {
    return first_time(scaled_down(image, thumbnail_edge), exposure_ev, id, alt);
}

std::string front_image_again(const TradeoffResult& result, std::size_t place,
                              const std::string& alt) {
    const std::vector<const TradeoffPoint*> front = front_of(result);
    return place < front.size() ? again(front[place]->image, front_id(place), alt) : "";
}

std::string reference_again(const TradeoffResult& result) {
    return again(result.reference.image, reference_id, "Reference");
}

std::string images_section(const TradeoffResult& result) {
    const std::vector<const TradeoffPoint*> front = front_of(result);
    std::vector<Image> maps;
    for (const TradeoffPoint* point : front)
        maps.push_back(scaled_map(point->error_map, result.width, result.height, thumbnail_edge));
    const double high = map_scale(maps);
    std::string text = "<section>\n<h2>Images of the front</h2>\n";
    text += fmt::format(
        "<p>Thumbnails at an exposure of {} stops, from the fastest to the nearest. Error maps "
        "show HDR-FLIP by pixel, all on one scale from 0 to {}.</p>\n",
        round_text(result.exposure_ev), round_text(high));
    text += scale_bar(high);
    const std::string reference =
        shown_image(result.reference.image, result.exposure_ev, reference_id, "Reference image");
    if (!reference.empty())
        text += "<figure class=\"images\">\n" +
                text_element("figcaption", fmt::format("Reference: {} samples per pixel",
                                                       count_text(result.reference.samples))) +
                "\n" + reference + "\n</figure>\n";
    text += "<div class=\"cards\">\n";
    for (std::size_t i = 0; i < front.size(); ++i)
        text += figure(result, *front[i], i, maps[i], high);
    return text + "</div>\n</section>\n";
}

}  // namespace weft
