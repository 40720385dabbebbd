// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/work_order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <utility>

namespace weft {
namespace {

constexpr unsigned cell_bits = 7;
constexpr std::uint32_t cells = 1U << cell_bits;
// Two passes sort all bits of a code.
constexpr unsigned digit_bits = 11;
constexpr unsigned digits = 2;
static_assert(digits * digit_bits >= 3 * cell_bits);

struct Entry {
    std::uint32_t code;
    std::uint32_t pixel;
};

std::uint32_t cell(float coordinate, float extent) {
    const float share = 0.5F + 0.5F * coordinate / extent;
    return share > 0.0F ? static_cast<std::uint32_t>(std::min(share * static_cast<float>(cells),
                                                              static_cast<float>(cells - 1)))
                        : 0U;
}

/// Stable, by code: least significant digit first.
void sort_by_code(std::vector<Entry>& entries, std::vector<Entry>& scratch) {
    scratch.resize(entries.size());
    for (unsigned digit = 0; digit < digits; ++digit) {
        const auto bucket = [&](const Entry& entry) {
            return entry.code >> (digit * digit_bits) & ((1U << digit_bits) - 1U);
        };
        std::array<std::uint32_t, (1U << digit_bits) + 1> starts{};
        for (const Entry& entry : entries) ++starts[bucket(entry) + 1];
        for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
        for (const Entry& entry : entries) scratch[starts[bucket(entry)]++] = entry;
        std::swap(entries, scratch);
    }
}

}  // namespace

std::uint32_t spread_bits(std::uint32_t x) {
    x = (x | x << 16) & 0x030000FFU;
    x = (x | x << 8) & 0x0300F00FU;
    x = (x | x << 4) & 0x030C30C3U;
    return (x | x << 2) & 0x09249249U;
}

std::uint32_t morton_code(const shared::float4& position, float extent) {
    return spread_bits(cell(position.x, extent)) | spread_bits(cell(position.y, extent)) << 1 |
           spread_bits(cell(position.z, extent)) << 2;
}

WorkList ordered_by_place(const WorkList& list, std::span<const shared::float4> positions,
                          float extent) {
    const std::uint32_t count =
        list.block_sets.empty()
            ? 0
            : *std::max_element(list.block_sets.begin(), list.block_sets.end()) + 1;
    std::vector<std::vector<Entry>> sets(count);
    tbb::parallel_for(0U, count, [&](std::uint32_t set) {
        std::vector<Entry>& entries = sets[set];
        for (std::size_t block = 0; block < list.block_sets.size(); ++block) {
            if (list.block_sets[block] != set) continue;
            for (std::size_t i = block * PACKET_BLOCK; i < (block + 1) * PACKET_BLOCK; ++i) {
                const std::uint32_t pixel = list.pixels[i];
                if (pixel != INVALID_INDEX)
                    entries.push_back({morton_code(positions[pixel], extent), pixel});
            }
        }
        std::vector<Entry> scratch;
        sort_by_code(entries, scratch);
    });
    WorkList ordered;
    for (std::uint32_t set = 0; set < count; ++set) {
        for (const Entry& entry : sets[set]) ordered.pixels.push_back(entry.pixel);
        while (ordered.pixels.size() % PACKET_BLOCK != 0) ordered.pixels.push_back(INVALID_INDEX);
        ordered.block_sets.resize(ordered.pixels.size() / PACKET_BLOCK, set);
    }
    return ordered;
}

}  // namespace weft
