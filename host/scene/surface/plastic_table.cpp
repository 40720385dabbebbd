// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/surface/plastic_table.h"

#include <algorithm>

#include "scene/surface/facet_albedo.h"

namespace weft {

PlasticTable plastic_table(double alpha, double eta, bool beckmann) {
    const FacetQuadrature quadrature(64);
    PlasticTable table;
    double reflected = 0.0;
    for (int i = 0; i < plastic_nodes; ++i) {
        const double cosine = std::max(1e-6, static_cast<double>(i) / (plastic_nodes - 1));
        table.transmittance.push_back(static_cast<float>(
            quadrature.separable_albedo(cosine, alpha, eta, beckmann).transmitted));
        reflected +=
            quadrature.separable_albedo(cosine, alpha, 1 / eta, beckmann).reflected * cosine;
    }
    table.inner_reflectance = static_cast<float>(2 * reflected / plastic_nodes);
    return table;
}

}  // namespace weft
