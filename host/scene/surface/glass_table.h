// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_GLASS_TABLE_H
#define WEFT_SCENE_SURFACE_GLASS_TABLE_H

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace weft {

/// Nodes of a GlassTable along each axis.
constexpr int glass_nodes = 24;
constexpr std::size_t glass_table_size = std::size_t{glass_nodes} * glass_nodes;

/// The albedo by which kernels divide what rough glass reflects and transmits in one step
/// (FacetQuadrature::glass_albedo), for one ratio of indices: a table as of AlbedoGrid, nowhere
/// below the truth but for 3e-3.
///
/// A roughness reads two rows, and all rows take half a second of one core. So rows are made
/// when they are asked for, each with the same values whichever others there are.
class GlassTable {
  public:
    /// `eta` is the index beyond the surface over that on the side of the direction.
    explicit GlassTable(double eta) : eta_(eta) {}

    /// Puts the rows that alphas from `least` to `most` read into a table of glass_table_size
    /// values, and leaves its other rows alone. The rows of a new roughness take about 0.07 s of
    /// one core; all cores share the work.
    void write_rows(double least, double most, std::span<float> table);

  private:
    /// The rows `cell` and `cell + 1`, raised so that what is read between them is not too low.
    const std::vector<float>& cell(int cell);

    double eta_;
    std::array<std::vector<float>, glass_nodes - 1> cells_;  ///< empty where not made
};

}  // namespace weft

#endif
