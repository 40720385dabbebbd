// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_IMAGE_ERRORS_H
#define WEFT_TRADEOFF_IMAGE_ERRORS_H

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "image/image.h"
#include "metrics/unbiased_mse.h"

namespace weft {

/// Percent of the pixels in which an observer sees a difference with at least a given probability.
struct VisibleShares {
    double p75 = 0.0;
    double p95 = 0.0;
};

/// How a layer of an image differs from that of its reference; empty where it was not chosen, or
/// has no value.
struct ImageErrors {
    std::optional<VisibleShares> published;  ///< HDR-VDP, 1 cd/m^2 at value 1, 30 pixels per degree
    std::optional<VisibleShares> display;    ///< the same with 100 cd/m^2 at value 1
    std::optional<double> hdrflip;
    std::optional<double> relmse;
    std::optional<double> relmse_trimmed;
    std::optional<double> bias;
    /// By the halves of the reference, where it has them.
    std::optional<ErrorEstimate> unbiased_relmse;

    /// By name; `unbiased_relmse` with `value`, `low` and `high`, only where it is known.
    [[nodiscard]] nlohmann::json json() const;
};

/// Which of the slow metrics to measure, and whether to use the halves of the reference; the other
/// metrics always are measured.
struct ErrorChoice {
    bool visible = true;
    bool hdrflip = true;
    bool unbiased = true;
};

/// The halves of a reference that holds them as layers; none otherwise. They stay those of the
/// image.
[[nodiscard]] std::optional<ReferenceHalves> halves_of(const Image& reference);

/// JSON of an estimate: `value`, `low` and `high`.
[[nodiscard]] nlohmann::json estimate_json(const ErrorEstimate& estimate);

/// Compares the layers of that name. The unbiased error is that of beauty alone. Throws Error (exit
/// code 2) where one is missing or the sizes differ.
[[nodiscard]] ImageErrors image_errors(const Image& reference, const Image& test,
                                       std::string_view layer, const ErrorChoice& choice);

/// The errors of one half of a reference against the other: what its noise leaves between two
/// images that show the same. Empty where it has no halves.
[[nodiscard]] std::optional<ImageErrors> floor_errors(const Image& reference,
                                                      const ErrorChoice& choice = {});

}  // namespace weft

#endif
