// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_MICROFACETS_H
#define WEFT_SCENE_SURFACE_MICROFACETS_H

#include <cstdint>

namespace weft {

enum class MicrofacetDistribution : std::uint8_t { ggx, beckmann };

/// Which model of microfacets a file means. The default is glTF's.
struct Microfacets {
    MicrofacetDistribution distribution = MicrofacetDistribution::ggx;
    bool separable = false;  ///< G is G1 of one direction times G1 of the other, not correlated
    bool single_scatter = false;  ///< light that meets a second facet is lost
};

/// The model that Mitsuba's plug-ins mean.
[[nodiscard]] constexpr Microfacets mitsuba_microfacets(MicrofacetDistribution distribution) {
    return {distribution, true, true};
}

}  // namespace weft

#endif
