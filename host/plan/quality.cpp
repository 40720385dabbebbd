// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/quality.h"

#include "shared/shared_types.h"

namespace weft {

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

SamplingSettings sampling_of_reference() {
    SamplingSettings settings;
    settings.vpls_per_set = 256;
    // Its residual brings what the bound leaves out, and has less noise than the light of VPLs that
    // are closer than this.
    settings.bound_spacing = 2.0;
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
