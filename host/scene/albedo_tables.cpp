// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/albedo_tables.h"

#include <cstddef>
#include <cstdint>

#include "scene/surface_lobes.h"

namespace weft {
namespace {

/// Whether a record is divided by the albedo of rough glass.
bool reads_glass(const shared::SurfaceRecord& record, const AlphaRange& alphas) {
    return record.model == SURFACE_LAYERED && record.transmission > 0.0F &&
           (record.flags & (SURFACE_THIN | SURFACE_SINGLE_SCATTER)) == 0 &&
           width_of(alphas.most) != LobeWidth::delta;
}

}  // namespace

std::vector<float> AlbedoTables::add_to(std::span<shared::SurfaceRecord> records,
                                        std::span<const AlphaRange> glass) {
    std::vector<float> values;
    add_glass(records, glass, values);
    add_plastic(records, values);
    return values;
}

void AlbedoTables::add_glass(std::span<shared::SurfaceRecord> records,
                             std::span<const AlphaRange> glass, std::vector<float>& values) {
    std::map<float, std::uint32_t> places;
    for (std::size_t i = 0; i < records.size(); ++i) {
        shared::SurfaceRecord& record = records[i];
        if (!reads_glass(record, glass[i])) continue;
        const auto [place, is_new] =
            places.try_emplace(record.eta.x, static_cast<std::uint32_t>(values.size()));
        // No light is lost at rows that nothing reads.
        if (is_new) values.resize(values.size() + 2 * glass_table_size, 1.0F);
        record.table = place->second;
        const auto eta = static_cast<double>(record.eta.x);
        auto& [outside, inside] =
            glass_.try_emplace(record.eta.x, GlassTable(eta), GlassTable(1.0 / eta)).first->second;
        const std::span<float> both(&values[record.table], 2 * glass_table_size);
        outside.write_rows(glass[i].least, glass[i].most, both.first(glass_table_size));
        inside.write_rows(glass[i].least, glass[i].most, both.last(glass_table_size));
    }
}

void AlbedoTables::add_plastic(std::span<shared::SurfaceRecord> records,
                               std::vector<float>& values) {
    const auto known = std::exchange(plastic_, {});
    std::map<std::tuple<float, float, bool>, std::uint32_t> places;
    for (shared::SurfaceRecord& record : records) {
        if (record.model != SURFACE_PLASTIC || !(record.roughness_u > 0.0F)) continue;
        const bool beckmann = (record.flags & SURFACE_BECKMANN) != 0;
        const std::tuple key{record.roughness_u, record.eta.x, beckmann};
        const auto [place, is_new] =
            places.try_emplace(key, static_cast<std::uint32_t>(values.size()));
        if (is_new) {
            const auto found = known.find(key);
            const PlasticTable& table =
                plastic_
                    .emplace(key, found != known.end()
                                      ? found->second
                                      : plastic_table(static_cast<double>(record.roughness_u),
                                                      static_cast<double>(record.eta.x), beckmann))
                    .first->second;
            values.insert(values.end(), table.transmittance.begin(), table.transmittance.end());
        }
        record.table = place->second;
        record.inner = plastic_.at(key).inner_reflectance;
    }
}

}  // namespace weft
