// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_PLASTIC_TABLE_H
#define WEFT_SCENE_SURFACE_PLASTIC_TABLE_H

#include <vector>

namespace weft {

/// Nodes of PlasticTable::transmittance, by even steps of the cosine from 1e-6 to 1.
constexpr int plastic_nodes = 64;

/// What Mitsuba's `roughplastic` knows of its boundary (kernels/bsdf/plastic.h).
struct PlasticTable {
    /// Share of the light from outside that facets let in, in one step.
    std::vector<float> transmittance;
    /// Share of diffuse light from inside that they reflect, by the sum over the nodes that Mitsuba
    /// takes for its integral.
    float inner_reflectance = 0.0F;
};

/// The table for facets with independent masking of both directions. `eta` is the index of the body
/// over that outside.
[[nodiscard]] PlasticTable plastic_table(double alpha, double eta, bool beckmann);

}  // namespace weft

#endif
