// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_ALBEDO_GRID_H
#define WEFT_SCENE_SURFACE_ALBEDO_GRID_H

#include <functional>
#include <vector>

namespace weft {

/// A table of albedos of rough surfaces, by the cosine of a direction and by alpha, the square of
/// the roughness. Nodes are even steps of the root of the cosine, in columns, and of x, in rows,
/// where the roughness is (x + x^2) / 2: albedos are smoothest in these. Kernels read it by
/// table_place (kernels/bsdf/albedo_tables.h).
class AlbedoGrid {
  public:
    /// Rows from `first` to `last`, both of them counted.
    struct Rows {
        int first, last;
    };

    /// Computes the albedo of (cosine, alpha); not negative, and at most 1. Several threads call
    /// it.
    using Albedo = std::function<double(double cosine, double alpha)>;

    /// The values of the function at nodes x nodes places, none of which has a cosine of 0.
    AlbedoGrid(int nodes, const Albedo& albedo) : AlbedoGrid(nodes, {0, nodes - 1}, albedo) {}

    /// The same in some rows only, at least two.
    AlbedoGrid(int nodes, Rows rows, const Albedo& albedo);

    /// Raises nodes, none above 1, until interpolation lies nowhere below the function at
    /// checks x checks places of each cell: a material that is divided by the table, or gives the
    /// rest of its light to another, may lose light and never gains any.
    void raise(const Albedo& albedo, int checks);

    /// The value between nodes, bilinear; of an alpha between rows that are there.
    [[nodiscard]] double at(double cosine, double alpha) const;

    /// The nodes, row by row, rounded up.
    [[nodiscard]] std::vector<float> rounded_up() const;

    /// Alpha of a row.
    [[nodiscard]] double alpha_of(double row) const;
    /// The place of an alpha between the rows, those above 1 at the last.
    [[nodiscard]] static double row_of(double alpha, int nodes);
    /// Cosine of a column.
    [[nodiscard]] double cosine_of(double column) const;

  private:
    [[nodiscard]] double between(double column, double row) const;

    int nodes_;
    Rows rows_;
    std::vector<double> values_;
};

}  // namespace weft

#endif
