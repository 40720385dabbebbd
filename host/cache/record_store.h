// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_RECORD_STORE_H
#define WEFT_CACHE_RECORD_STORE_H

#include <cstdint>
#include <span>
#include <vector>

#include "device/device_buffer.h"

namespace weft {

/// Keeps irradiance records for lookups on the device, with the bounds of what they serve: of
/// groups of CACHE_GROUP records that follow one another, and of groups of such groups. Lookups are
/// quick where records that follow one another are near each other.
class RecordStore {
  public:
    explicit RecordStore(Executor& executor);

    /// Replaces the records that were there.
    void set(Executor& executor, std::span<const shared::CacheRecord> records);

    [[nodiscard]] std::uint32_t count() const { return count_; }
    [[nodiscard]] BufferRef<kinds::Records> records() const { return records_; }
    /// By record, 1 where a lookup has used it since the records were set.
    [[nodiscard]] BufferRef<kinds::RecordsUsed> used() const { return used_; }
    [[nodiscard]] std::vector<std::uint32_t> read_used(Executor& executor) const;
    /// Lower and upper bounds as pairs of float4: of the groups of groups, then of the groups.
    [[nodiscard]] BufferRef<kinds::RecordBounds> boxes() const { return boxes_; }

  private:
    DeviceBuffer<kinds::Records> records_;
    DeviceBuffer<kinds::RecordBounds> boxes_;
    DeviceBuffer<kinds::RecordsUsed> used_;
    std::size_t room_ = 0;  ///< records for which the buffers have room
    std::uint32_t count_ = 0;
};

/// Bounds of groups of records, and of groups of groups; see RecordStore::boxes.
[[nodiscard]] std::vector<shared::float4> record_boxes(
    std::span<const shared::CacheRecord> records);

}  // namespace weft

#endif
