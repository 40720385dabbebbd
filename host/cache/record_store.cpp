// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/record_store.h"

#include <algorithm>
#include <limits>

#include "kernels/cache/cache.h"

namespace weft {
namespace {

constexpr std::size_t least_room = 1024;

struct Bounds {
    shared::float4 lower, upper;
};

constexpr float far = std::numeric_limits<float>::max();
constexpr Bounds no_bounds{{far, far, far, 0.0F}, {-far, -far, -far, 0.0F}};

void grow(Bounds& bounds, const Bounds& other) {
    bounds.lower.x = std::min(bounds.lower.x, other.lower.x);
    bounds.lower.y = std::min(bounds.lower.y, other.lower.y);
    bounds.lower.z = std::min(bounds.lower.z, other.lower.z);
    bounds.upper.x = std::max(bounds.upper.x, other.upper.x);
    bounds.upper.y = std::max(bounds.upper.y, other.upper.y);
    bounds.upper.z = std::max(bounds.upper.z, other.upper.z);
}

Bounds bounds_of(const shared::CacheRecord& record) {
    // Rounding must not put a place outside that the kernel finds within the radius.
    const shared::float4& p = record.position;
    const float reach = p.w * 1.0001F;
    return {{p.x - reach, p.y - reach, p.z - reach, 0.0F},
            {p.x + reach, p.y + reach, p.z + reach, 0.0F}};
}

/// Bounds of CACHE_GROUP entries at a time.
std::vector<Bounds> grouped(std::span<const Bounds> entries) {
    std::vector<Bounds> groups((entries.size() + CACHE_GROUP - 1) / CACHE_GROUP, no_bounds);
    for (std::size_t i = 0; i < entries.size(); ++i) grow(groups[i / CACHE_GROUP], entries[i]);
    return groups;
}

}  // namespace

std::vector<shared::float4> record_boxes(std::span<const shared::CacheRecord> records) {
    std::vector<Bounds> single;
    single.reserve(records.size());
    for (const shared::CacheRecord& record : records) single.push_back(bounds_of(record));
    const std::vector<Bounds> groups = grouped(single);
    std::vector<shared::float4> boxes;
    for (const std::vector<Bounds>& level : {grouped(groups), groups})
        for (const Bounds& bounds : level) {
            boxes.push_back(bounds.lower);
            boxes.push_back(bounds.upper);
        }
    return boxes;
}

RecordStore::RecordStore(Executor& executor) {
    set(executor, {});
}

void RecordStore::set(Executor& executor, std::span<const shared::CacheRecord> records) {
    if (!records_ || records.size() > room_) {
        room_ = std::max({least_room, records.size(), 2 * room_});
        records_ = allocate<kinds::Records>(executor, room_, "irradiance records");
        used_ = allocate<kinds::RecordsUsed>(executor, room_, "used irradiance records");
        const std::size_t groups = room_ / CACHE_GROUP + room_ / (CACHE_GROUP * CACHE_GROUP) + 2;
        boxes_ =
            allocate<kinds::RecordBounds>(executor, groups * 2, "bounds of irradiance records");
    }
    const std::vector<std::uint32_t> unused(records.size(), 0);
    write_buffer(executor, used_, unused);
    count_ = static_cast<std::uint32_t>(records.size());
    write_buffer(executor, records_, records);
    write_buffer(executor, boxes_, record_boxes(records));
}

std::vector<std::uint32_t> RecordStore::read_used(Executor& executor) const {
    return read_buffer(executor, used_, count_);
}

}  // namespace weft
