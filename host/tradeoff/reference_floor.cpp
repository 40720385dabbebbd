// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/reference_floor.h"

#include <fmt/format.h>

#include <cmath>

#include "tradeoff/image_errors.h"
#include "tradeoff/reference_files.h"

namespace weft {
namespace {

constexpr const char* published_key = "floor_published";
constexpr const char* display_key = "floor_display";

std::optional<double> percent_in(const Image& image, const char* key) {
    const std::optional<double> value = metadata_number(image, key);
    return value && *value >= 0.0 && *value <= 100.0 ? value : std::nullopt;
}

}  // namespace

std::optional<ReferenceFloor> measured_floor(const Image& reference) {
    const auto errors = floor_errors(reference, {.hdrflip = false});
    if (!errors) return std::nullopt;
    return ReferenceFloor{errors->published->p75, errors->display->p75};
}

void state_floor(const ReferenceFloor& floor, Image& reference) {
    reference.metadata[published_key] = fmt::format("{}", floor.published);
    reference.metadata[display_key] = fmt::format("{}", floor.display);
}

std::optional<ReferenceFloor> stated_floor(const Image& reference) {
    const std::optional<double> published = percent_in(reference, published_key);
    const std::optional<double> display = percent_in(reference, display_key);
    if (!published || !display) return std::nullopt;
    return ReferenceFloor{*published, *display};
}

}  // namespace weft
