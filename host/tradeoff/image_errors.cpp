// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/image_errors.h"

#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "metrics/flip.h"
#include "metrics/hdr_vdp.h"
#include "metrics/numeric.h"
#include "metrics/rgb_view.h"
#include "tradeoff/error_values.h"
#include "tradeoff/reference_images.h"

namespace weft {
namespace {

constexpr double published_scale = 1.0;
constexpr double display_scale = 100.0;
constexpr double pixels_per_degree = 30.0;

RgbView view_of(const Image& image, std::string_view name) {
    const Layer* const layer = image.find(name);
    if (layer == nullptr || layer->channels != "RGB")
        throw Error(ExitCode::bad_input, "an image lacks the layer '" + std::string(name) +
                                             "', expected one of the channels RGB");
    return {layer->values, image.width, image.height};
}

VisibleShares visible(const std::vector<float>& test, const std::vector<float>& reference,
                      const RgbView& view, double scale) {
    HdrVdpSettings settings;
    settings.luminance_scale = scale;
    settings.pixels_per_degree = pixels_per_degree;
    const HdrVdpResult result = hdr_vdp(test, reference, view.width, view.height, settings);
    return {result.p75, result.p95};
}

nlohmann::json number(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json shares_json(const std::optional<VisibleShares>& value) {
    if (!value) return {};
    return {{"p75", value->p75}, {"p95", value->p95}};
}

}  // namespace

nlohmann::json ImageErrors::json() const {
    nlohmann::json json{{"hdrvdp_published", shares_json(published)},
                        {"hdrvdp_display", shares_json(display)},
                        {"hdrflip", number(hdrflip)},
                        {"relmse", number(relmse)},
                        {"relmse_trimmed", number(relmse_trimmed)},
                        {"bias", number(bias)}};
    if (unbiased_relmse) json["unbiased_relmse"] = estimate_json(*unbiased_relmse);
    return json;
}

nlohmann::json estimate_json(const ErrorEstimate& estimate) {
    return {{"value", number(estimate.value)},
            {"low", number(estimate.low)},
            {"high", number(estimate.high)}};
}

std::optional<ReferenceHalves> halves_of(const Image& reference) {
    if (reference.find(first_half_layer) == nullptr || reference.find(second_half_layer) == nullptr)
        return std::nullopt;
    return ReferenceHalves{view_of(reference, first_half_layer),
                           view_of(reference, second_half_layer)};
}

ImageErrors image_errors(const Image& reference, const Image& test, std::string_view layer,
                         const ErrorChoice& choice) {
    const RgbView expected = view_of(reference, layer);
    const RgbView seen = view_of(test, layer);
    if (expected.width != seen.width || expected.height != seen.height)
        throw Error(ExitCode::bad_input, "a reference has another size than the image");
    ImageErrors errors;
    const RelativeErrors relative = relative_errors(expected, seen);
    errors.relmse = relative.relmse;
    errors.relmse_trimmed = relative.relmse_trimmed;
    errors.bias = relative.bias;
    if (choice.visible) {
        const std::vector<float> test_map = luminance(seen);
        const std::vector<float> reference_map = luminance(expected);
        errors.published = visible(test_map, reference_map, seen, published_scale);
        errors.display = visible(test_map, reference_map, seen, display_scale);
    }
    if (choice.hdrflip) errors.hdrflip = hdr_flip(expected, seen, flip_exposures(expected)).mean;
    const auto halves =
        choice.unbiased && layer.empty() ? halves_of(reference) : std::optional<ReferenceHalves>();
    if (halves) errors.unbiased_relmse = unbiased_errors(*halves, seen).relmse;
    return errors;
}

std::optional<ImageErrors> floor_errors(const Image& reference, const ErrorChoice& choice) {
    if (!halves_of(reference)) return std::nullopt;
    return image_errors(layer_as_beauty(reference, first_half_layer),
                        layer_as_beauty(reference, second_half_layer), "", choice);
}

}  // namespace weft
