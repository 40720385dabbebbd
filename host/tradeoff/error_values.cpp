// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/error_values.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "metrics/flip.h"
#include "metrics/rgb_view.h"
#include "tradeoff/image_errors.h"

namespace weft {
namespace {

double value_of(const std::optional<double>& value) {
    if (!value || !std::isfinite(*value))
        throw Error(ExitCode::bad_input,
                    "an error relative to the reference has no value, expected a reference that is "
                    "not black all over");
    return *value;
}

RgbView beauty(const Image& image) {
    const Layer* const layer = image.find("");
    if (layer == nullptr || layer->channels != "RGB")
        throw Error(ExitCode::bad_input, "an image lacks its beauty, expected channels RGB");
    return {layer->values, image.width, image.height};
}

}  // namespace

std::vector<double> error_values(const Image& reference, const Image& image) {
    const ImageErrors errors = image_errors(reference, image, "", {.unbiased = false});
    return {value_of(errors.hdrflip),
            errors.published->p75,
            errors.published->p95,
            errors.display->p75,
            errors.display->p95,
            value_of(errors.relmse),
            std::abs(value_of(errors.bias))};
}

std::optional<ErrorEstimate> unbiased_value(const Image& reference, const Image& image) {
    const std::optional<ReferenceHalves> halves = halves_of(reference);
    if (!halves) return std::nullopt;
    const std::optional<ErrorEstimate> found = unbiased_errors(*halves, beauty(image)).relmse;
    (void)value_of(found ? std::optional(found->value) : std::nullopt);
    return found;
}

std::optional<double> noise_relmse_of(const Image& reference) {
    const std::optional<ReferenceHalves> halves = halves_of(reference);
    if (!halves) return std::nullopt;
    // It does not depend on the image that is compared.
    return unbiased_errors(*halves, halves->first).noise_relmse;
}

std::vector<float> error_map(const Image& reference, const Image& image) {
    const RgbView expected = beauty(reference);
    return hdr_flip(expected, beauty(image), flip_exposures(expected)).map;
}

Image layer_as_beauty(const Image& image, const char* name) {
    const Layer* const found = image.find(name);
    if (found == nullptr || found->channels != "RGB")
        throw Error(ExitCode::bad_input, "an image lacks the layer '" + std::string(name) +
                                             "', expected one of the channels RGB");
    Layer layer = *found;
    layer.name.clear();
    return {.width = image.width, .height = image.height, .layers = {layer}, .metadata = {}};
}

}  // namespace weft
