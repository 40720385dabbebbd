// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_RECORD_THINNING_H
#define WEFT_CACHE_RECORD_THINNING_H

#include <cstddef>
#include <span>
#include <vector>

#include "shared/shared_types.h"

namespace weft {

/// The weight with which a record serves the place of another, as kernels/cache/cache_lookup.cl has
/// it for surfaces with their shading normals; 0 where it would ask by a ray whether it sees it.
/// `error` is SamplingParams::record_error.
[[nodiscard]] double certain_weight(const shared::CacheRecord& record,
                                    const shared::CacheRecord& place, double error);

/// Records that others make dispensable, in rising order: by falling radius, those whose place
/// others of at least that radius, which are not dispensable, serve with a weight of `enough`.
[[nodiscard]] std::vector<std::size_t> dispensable_records(
    std::span<const shared::CacheRecord> records, double error, double enough);

}  // namespace weft

#endif
