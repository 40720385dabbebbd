// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/quality.h"

#include "shared/shared_types.h"

namespace weft {

namespace {

/// The residual brings what the bound leaves out, and has less noise than the light of VPLs that
/// are closer than this.
constexpr double residual_spacing = 2.0;

}  // namespace

std::string_view to_string(Quality quality) {
    return quality_names.at(static_cast<std::size_t>(quality));
}

SamplingSettings sampling_of(Quality quality) {
    SamplingSettings settings;
    if (quality == Quality::draft) {
        settings.threshold = 20.0;
        settings.enough_support = 0.3;
        settings.roulette = 4.0;
        settings.cache_error = 0.2;
        // With more than four lights few points are nearly as good, at half the time.
        settings.max_samples_per_set = 16;
    }
    if (quality == Quality::high) {
        settings.threshold = 3.0;
        settings.enough_support = 0.7;
        settings.roulette = 0.5;
        settings.cache_error = 0.05;
        settings.vpls_per_set = 256;
        settings.samples_per_light = 16;
        settings.max_samples_per_set = 1024;
    }
    return settings;
}

SamplingSettings sampling_of_image(Quality quality, bool media) {
    SamplingSettings settings = sampling_of(quality);
    settings.threshold_falls = true;
    if (media) {
        settings.bound_spacing = 0.7;
    } else if (quality != Quality::draft) {
        settings.compensation = true;
        settings.near_residual = true;
        settings.bound_spacing = residual_spacing;
    }
    return settings;
}

SamplingSettings sampling_of_reference() {
    SamplingSettings settings;
    settings.vpls_per_set = 256;
    settings.bound_spacing = residual_spacing;
    settings.samples_per_light = 4;
    settings.max_samples_per_set = 16;
    settings.filter_radius = 0;
    settings.compensation = true;
    return settings;
}

std::uint32_t samples_of(Quality quality, bool media) {
    if (quality == Quality::draft) return 1;
    return media ? 4 : 6;
}

}  // namespace weft
