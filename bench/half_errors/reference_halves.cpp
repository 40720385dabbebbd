// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/half_errors/reference_halves.h"

#include <cstddef>
#include <span>

#include "base/error.h"
#include "metrics/unbiased_mse.h"

namespace weft::bench {
namespace {

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
    const auto view = [&](const Image& of) {
        return RgbView{colours(of, first, name), first.width, first.height};
    };
    const UnbiasedErrors errors = unbiased_errors({view(first), view(second)}, view(image));
    if (!errors.relmse)
        throw input_error(name,
                          "has no relative error where the reference is black, expected a "
                          "reference that shows something");
    return {errors.relmse->value, errors.relmse->high - errors.relmse->value};
}

}  // namespace weft::bench
