// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_ALBEDO_TABLES_H
#define WEFT_SCENE_ALBEDO_TABLES_H

#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/surface/glass_table.h"
#include "scene/surface/plastic_table.h"
#include "shared/shared_types.h"

namespace weft {

/// How rough facets are over their texture, by alpha, the square of the roughness; both are 0 where
/// they are smooth.
struct AlphaRange {
    double least = 0.0;
    double most = 0.0;
};

/// The tables of albedos of the materials of a scene. They take a while, so those that were made
/// are kept while materials change.
class AlbedoTables {
  public:
    /// Makes the tables that records read, and says in each where its own begins. `glass` is by
    /// record: the alphas of its glass. Returns the values of all tables.
    [[nodiscard]] std::vector<float> add_to(std::span<shared::SurfaceRecord> records,
                                            std::span<const AlphaRange> glass);

  private:
    void add_glass(std::span<shared::SurfaceRecord> records, std::span<const AlphaRange> glass,
                   std::vector<float>& values);
    void add_plastic(std::span<shared::SurfaceRecord> records, std::vector<float>& values);

    /// By index: from outside, then from inside.
    std::map<float, std::pair<GlassTable, GlassTable>> glass_;
    /// Those that records read, by roughness, index and whether the distribution is Beckmann's.
    std::map<std::tuple<float, float, bool>, PlasticTable> plastic_;
};

}  // namespace weft

#endif
