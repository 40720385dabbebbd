// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_PRUNE_RECORDS_H
#define WEFT_CACHE_PRUNE_RECORDS_H

#include <cstddef>
#include <span>
#include <vector>

#include "shared/shared_types.h"

namespace weft {

/// The weight with which a record serves the place of another, as kernels/cache/cache_lookup.cl
/// computes it for surfaces with their shading normals; 0 where the kernel needs a shadow ray to
/// tell whether the record sees the place. `error` is SamplingParams::record_error.
[[nodiscard]] double certain_weight(const shared::CacheRecord& record,
                                    const shared::CacheRecord& place, double error);

/// Indices, in rising order, of the records that others make dispensable. They are found by falling
/// radius: a record is dispensable if others of at least its radius, which are not dispensable,
/// serve its place with a weight of `enough` in all.
[[nodiscard]] std::vector<std::size_t> dispensable_records(
    std::span<const shared::CacheRecord> records, double error, double enough);

}  // namespace weft

#endif
