// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FILM_SAMPLE_PARTS_H
#define WEFT_FILM_SAMPLE_PARTS_H

#include <cstdint>
#include <string>
#include <vector>

#include "film/film_sums.h"

namespace weft {

/// Part `part`, from 1 on, of the `parts` that samples are divided into. Parts differ by one sample
/// at most; where there are more parts than samples, some are empty.
[[nodiscard]] SampleRange part_of(SampleRange whole, std::uint32_t part, std::uint32_t parts);

/// What `ranges`, ascending and apart, lack of `whole`.
[[nodiscard]] std::vector<SampleRange> missing_of(const std::vector<SampleRange>& ranges,
                                                  SampleRange whole);

/// Numbers of the parts of `whole` that lack any sample, ascending.
[[nodiscard]] std::vector<std::uint32_t> missing_parts(const std::vector<SampleRange>& ranges,
                                                       SampleRange whole, std::uint32_t parts);

/// "1,3-5", as job arrays take numbers, which ascend.
[[nodiscard]] std::string numbers_text(const std::vector<std::uint32_t>& numbers);

}  // namespace weft

#endif
