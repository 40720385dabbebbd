// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_IMAGE_ERRORS_H
#define WEFT_TRADEOFF_IMAGE_ERRORS_H

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "image/image.h"

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

    [[nodiscard]] nlohmann::json json() const;
};

/// Which of the slow metrics to measure; the others always are.
struct ErrorChoice {
    bool visible = true;
    bool hdrflip = true;
};

/// Compares the layers of that name. Throws Error (exit code 2) where one is missing or the sizes
/// differ.
[[nodiscard]] ImageErrors image_errors(const Image& reference, const Image& test,
                                       std::string_view layer, const ErrorChoice& choice);

}  // namespace weft

#endif
