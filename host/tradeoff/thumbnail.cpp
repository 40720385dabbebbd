// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/thumbnail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "base/limits.h"
#include "base/srgb.h"
#include "image/png.h"
#include "metrics/heat_map.h"
#include "tradeoff/html_text.h"

namespace weft {
namespace {

/// The part of a row of a larger image that a pixel of a smaller one covers, with fractions of the
/// pixels at both ends.
struct Cover {
    std::size_t first = 0;
    std::vector<double> weights;  ///< that sum up to 1
};

std::vector<Cover> covers(std::uint32_t from, std::uint32_t to) {
    std::vector<Cover> result(to);
    const double length = static_cast<double>(from) / to;
    for (std::uint32_t i = 0; i < to; ++i) {
        const double begin = i * length;
        const double end = std::min<double>((i + 1) * length, from);
        result[i].first = static_cast<std::size_t>(begin);
        for (std::size_t k = result[i].first; k < from && static_cast<double>(k) < end; ++k) {
            const auto pixel = static_cast<double>(k);
            result[i].weights.push_back((std::min(end, pixel + 1.0) - std::max(begin, pixel)) /
                                        length);
        }
    }
    return result;
}

double finite_value(float value) {
    return std::isfinite(value) ? value : 0.0;
}

std::vector<float> scaled_plane(std::span<const float> plane, std::uint32_t width,
                                const std::vector<Cover>& columns, const std::vector<Cover>& rows) {
    std::vector<float> result;
    result.reserve(columns.size() * rows.size());
    for (const Cover& row : rows)
        for (const Cover& column : columns) {
            double sum = 0.0;
            for (std::size_t j = 0; j < row.weights.size(); ++j)
                for (std::size_t i = 0; i < column.weights.size(); ++i)
                    sum += row.weights[j] * column.weights[i] *
                           finite_value(plane[(row.first + j) * width + column.first + i]);
            result.push_back(static_cast<float>(sum));
        }
    return result;
}

std::uint32_t shorter(std::uint32_t length, std::uint32_t longest, std::uint32_t edge) {
    const double scaled = static_cast<double>(length) * edge / longest;
    return std::max(1U, static_cast<std::uint32_t>(std::lround(scaled)));
}

}  // namespace

Image scaled_down(const Image& image, std::uint32_t edge) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    const Layer* beauty = image.find("");
    if (beauty == nullptr || pixels == 0 || edge == 0 || image.width > limits::max_film_edge ||
        image.height > limits::max_film_edge || beauty->channels.empty() ||
        beauty->values.size() != pixels * beauty->channels.size())
        return {};
    Image small;
    const std::uint32_t longest = std::max(image.width, image.height);
    const std::uint32_t target = std::min(longest, edge);
    small.width = shorter(image.width, longest, target);
    small.height = shorter(image.height, longest, target);
    const std::vector<Cover> columns = covers(image.width, small.width);
    const std::vector<Cover> rows = covers(image.height, small.height);
    small.layers = {{"", beauty->channels, {}}};
    for (std::size_t c = 0; c < beauty->channels.size(); ++c) {
        const std::vector<float> plane = scaled_plane(
            std::span(beauty->values).subspan(c * pixels, pixels), image.width, columns, rows);
        small.layers[0].values.insert(small.layers[0].values.end(), plane.begin(), plane.end());
    }
    return small;
}

Image scaled_map(std::span<const float> values, std::uint32_t width, std::uint32_t height,
                 std::uint32_t edge) {
    if (values.empty() || values.size() != std::size_t{width} * height) return {};
    Image map;
    map.width = width;
    map.height = height;
    map.layers = {{"", "Y", std::vector<float>(values.begin(), values.end())}};
    return scaled_down(map, edge);
}

Image map_colours(const Image& map, double high) {
    const Layer* layer = map.find("");
    const std::size_t pixels = std::size_t{map.width} * map.height;
    if (layer == nullptr || layer->values.size() != pixels || !(high > 0.0)) return {};
    Image image;
    image.width = map.width;
    image.height = map.height;
    std::vector<float> values(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::array<std::uint8_t, 3> colour = viridis(double{layer->values[i]} / high);
        for (std::size_t c = 0; c < 3; ++c)
            values[c * pixels + i] = linear_from_srgb(static_cast<float>(colour[c]) / 255.0F);
    }
    image.layers = {{"", "RGB", std::move(values)}};
    return image;
}

double map_scale(std::span<const Image> maps) {
    std::vector<float> values;
    for (const Image& map : maps)
        if (const Layer* layer = map.find("")) {
            values.insert(values.end(), layer->values.begin(), layer->values.end());
        }
    if (values.empty()) return 1.0;
    const auto place = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 99 / 100);
    std::nth_element(values.begin(), place, values.end());
    double high = *place;
    if (!(high > 0.0)) high = *std::max_element(place, values.end());
    if (!(high > 0.0)) return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(high)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (high <= factor * power) return factor * power;
    return 10.0 * power;
}

std::string image_uri(const Image& image, double exposure_ev) {
    const Layer* beauty = image.find("");
    if (beauty == nullptr || (beauty->channels != "Y" && !beauty->channels.starts_with("RGB")))
        return {};
    return png_uri(png_bytes(image, std::isfinite(exposure_ev) ? exposure_ev : 0.0));
}

}  // namespace weft
