// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/surface/glass_table.h"

#include <algorithm>

#include "scene/surface/albedo_grid.h"
#include "scene/surface/facet_albedo.h"

namespace weft {

void GlassTable::write_rows(double least, double most, std::span<float> table) {
    // Kernels, which find the place in float, may read the rows next to one at a node.
    constexpr double rounding = 1e-3;
    const int first = static_cast<int>(
        std::clamp(AlbedoGrid::row_of(least, glass_nodes) - rounding, 0.0, glass_nodes - 2.0));
    const int last =
        1 + static_cast<int>(std::clamp(AlbedoGrid::row_of(most, glass_nodes) + rounding, 0.0,
                                        glass_nodes - 2.0));
    for (int row = first; row <= last; ++row)
        for (int column = 0; column < glass_nodes; ++column) {
            const auto c = static_cast<std::size_t>(column);
            float value = 0.0F;
            if (row > 0) value = cell(row - 1)[glass_nodes + c];
            if (row + 1 < glass_nodes) value = std::max(value, cell(row)[c]);
            table[static_cast<std::size_t>(row) * glass_nodes + c] = value;
        }
}

const std::vector<float>& GlassTable::cell(int cell) {
    std::vector<float>& rows = cells_.at(static_cast<std::size_t>(cell));
    if (!rows.empty()) return rows;
    const FacetQuadrature quadrature(64);
    const auto albedo = [&](double cosine, double alpha) {
        return quadrature.glass_albedo(cosine, alpha, eta_);
    };
    AlbedoGrid grid(glass_nodes, {cell, cell + 1}, albedo);
    grid.raise(albedo, 2);
    return rows = grid.rounded_up();
}

}  // namespace weft
