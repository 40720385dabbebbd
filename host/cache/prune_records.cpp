// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/prune_records.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "kernels/cache/cache.h"

namespace weft {
namespace {

glm::dvec3 vector(const shared::float4& v) {
    return {v.x, v.y, v.z};
}

/// Finds the records that may reach a place, by the cells of grids in which they lie: one grid for
/// each power of two of the radius.
class RecordGrids {
  public:
    void add(const shared::CacheRecord& record, std::size_t index) {
        const int level = level_of(record);
        lowest_ = std::min(lowest_, level);
        highest_ = std::max(highest_, level);
        cells_[cell_of(vector(record.position), level)].push_back(index);
    }

    /// Calls `visit` with the index of every record that may reach a place, until it returns false.
    template <class Visit>
    void near(const glm::dvec3& place, const Visit& visit) const {
        for (int level = lowest_; level <= highest_; ++level) {
            const Cell middle = cell_of(place, level);
            for (int i = 0; i < 27; ++i) {
                const Cell cell{level, middle.x + i % 3 - 1, middle.y + i / 3 % 3 - 1,
                                middle.z + i / 9 - 1};
                const auto found = cells_.find(cell);
                if (found == cells_.end()) continue;
                for (const std::size_t index : found->second)
                    if (!visit(index)) return;
            }
        }
    }

  private:
    struct Cell {
        int level;
        std::int64_t x, y, z;
        bool operator==(const Cell&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Cell& cell) const {
            std::uint64_t h = static_cast<std::uint64_t>(cell.level);
            for (const std::int64_t v : {cell.x, cell.y, cell.z})
                h = (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15U;
            return h ^ h >> 29;
        }
    };

    /// Cells of a level are at least as large as the radii of its records.
    static int level_of(const shared::CacheRecord& record) {
        return std::ilogb(record.position.w) + 1;
    }
    static Cell cell_of(const glm::dvec3& place, int level) {
        const glm::dvec3 at = glm::floor(place * std::ldexp(1.0, -level));
        return {level, static_cast<std::int64_t>(at.x), static_cast<std::int64_t>(at.y),
                static_cast<std::int64_t>(at.z)};
    }

    std::unordered_map<Cell, std::vector<std::size_t>, Hash> cells_;
    int lowest_ = std::numeric_limits<int>::max();
    int highest_ = std::numeric_limits<int>::min();
};

}  // namespace

double certain_weight(const shared::CacheRecord& record, const shared::CacheRecord& place,
                      double error) {
    const double radius = static_cast<double>(record.position.w);
    const glm::dvec3 apart = vector(place.position) - vector(record.position);
    const double square = glm::dot(apart, apart);
    const auto& low = record.clear_low;
    const auto& high = record.clear_high;
    const float clear = std::min({low.x, low.y, low.z, low.w, high.x, high.y, high.z, high.w});
    if (square > static_cast<double>(clear)) return 0.0;
    const glm::dvec3 normal = vector(record.normal);
    if (glm::dot(apart, normal + vector(place.normal)) <=
        -2.0 * static_cast<double>(BEHIND_SHARE) * radius)
        return 0.0;
    const double turn = 1.0 - glm::dot(normal, vector(place.normal));
    return std::max(0.0, 1.0 - square / (radius * radius) -
                             turn / std::max(error, static_cast<double>(LEAST_TURN)));
}

std::vector<std::size_t> dispensable_records(std::span<const shared::CacheRecord> records,
                                             double error, double enough) {
    std::vector<std::size_t> order(records.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return records[a].position.w > records[b].position.w;
    });
    RecordGrids kept;
    std::vector<std::size_t> dispensable;
    for (const std::size_t index : order) {
        const shared::CacheRecord& record = records[index];
        if (!(record.position.w > 0.0F)) continue;
        double weight = 0.0;
        kept.near(vector(record.position), [&](std::size_t other) {
            weight += certain_weight(records[other], record, error);
            return weight < enough;
        });
        if (weight >= enough)
            dispensable.push_back(index);
        else
            kept.add(record, index);
    }
    std::sort(dispensable.begin(), dispensable.end());
    return dispensable;
}

}  // namespace weft
