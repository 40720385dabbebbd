// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/half_errors/reference_halves.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "base/error.h"

namespace weft::bench {
namespace {

constexpr double floor_share = 0.01;  // of the squared mean, as in `weft compare`
constexpr double normal_95 = 1.96;
constexpr std::size_t channels = 3;

/// The colours of an image that is as large as another one, without its alpha.
std::span<const float> colours(const Image& image, const Image& other, const std::string& name) {
    const Layer* const beauty = image.find("");
    if (beauty == nullptr || !beauty->channels.starts_with("RGB"))
        throw input_error(name, "has no colours, expected an image of red, green and blue");
    if (image.width != other.width || image.height != other.height)
        throw input_error(name, "is of another size than a half of the reference");
    return std::span(beauty->values).first(channels * std::size_t{image.width} * image.height);
}

}  // namespace

Image mean_of_halves(const Image& first, const Image& second, const std::string& name) {
    const std::span<const float> a = colours(first, first, name);
    const std::span<const float> b = colours(second, first, name);
    Image mean;
    mean.width = first.width;
    mean.height = first.height;
    Layer layer;
    layer.channels = "RGB";
    layer.values.resize(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) layer.values[i] = 0.5F * (a[i] + b[i]);
    mean.layers.push_back(std::move(layer));
    return mean;
}

HalvesError halves_error(const Image& image, const Image& first, const Image& second,
                         const std::string& name) {
    const std::span<const float> x = colours(image, first, name);
    const std::span<const float> a = colours(first, first, name);
    const std::span<const float> b = colours(second, first, name);
    const Image reference = mean_of_halves(first, second, name);
    const std::vector<float>& r = reference.layers.front().values;
    const double mean = std::accumulate(r.begin(), r.end(), 0.0) / static_cast<double>(r.size());
    const std::size_t pixels = r.size() / channels;
    double products = 0.0;
    double variances = 0.0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        double deviation = 0.0;
        for (std::size_t channel = 0; channel < channels; ++channel) {
            const std::size_t i = channel * pixels + pixel;
            const double scale = double{r[i]} * r[i] + floor_share * mean * mean;
            if (!(scale > 0.0)) continue;
            products += (double{x[i]} - a[i]) * (double{x[i]} - b[i]) / scale;
            deviation += (double{x[i]} - r[i]) * (double{a[i]} - b[i]) / scale;
        }
        variances += deviation * deviation;
    }
    const auto size = static_cast<double>(r.size());
    return {products / size, normal_95 * std::sqrt(variances) / size};
}

}  // namespace weft::bench
