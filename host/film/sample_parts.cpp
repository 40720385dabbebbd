// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/sample_parts.h"

#include <algorithm>

namespace weft {

SampleRange part_of(SampleRange whole, std::uint32_t part, std::uint32_t parts) {
    const std::uint64_t count = whole.end - whole.first;
    const auto start = [&](std::uint64_t number) {
        return whole.first + static_cast<std::uint32_t>(count * number / parts);
    };
    return {start(part - 1), start(part)};
}

std::vector<SampleRange> missing_of(const std::vector<SampleRange>& ranges, SampleRange whole) {
    std::vector<SampleRange> missing;
    std::uint32_t next = whole.first;
    for (const SampleRange& range : ranges) {
        const std::uint32_t end = std::min(range.first, whole.end);
        if (next < end) missing.push_back({next, end});
        next = std::max(next, range.end);
    }
    if (next < whole.end) missing.push_back({next, whole.end});
    return missing;
}

std::vector<std::uint32_t> missing_parts(const std::vector<SampleRange>& ranges, SampleRange whole,
                                         std::uint32_t parts) {
    const std::vector<SampleRange> missing = missing_of(ranges, whole);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t part = 1; part <= parts; ++part) {
        const SampleRange own = part_of(whole, part, parts);
        if (std::any_of(missing.begin(), missing.end(), [&](const SampleRange& gap) {
                return gap.first < own.end && own.first < gap.end;
            }))
            numbers.push_back(part);
    }
    return numbers;
}

std::string numbers_text(const std::vector<std::uint32_t>& numbers) {
    std::string text;
    for (std::size_t first = 0; first < numbers.size();) {
        std::size_t last = first;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
        if (!text.empty()) text += ',';
        text += std::to_string(numbers[first]);
        if (last > first) text += (last > first + 1 ? '-' : ',') + std::to_string(numbers[last]);
        first = last + 1;
    }
    return text;
}

}  // namespace weft
