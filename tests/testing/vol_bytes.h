// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_VOL_BYTES_H
#define WEFT_TESTS_TESTING_VOL_BYTES_H

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace weft {

inline void put(std::string& bytes, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
}

inline void put(std::string& bytes, float value) {
    put(bytes, std::bit_cast<std::uint32_t>(value));
}

/// What comes before the voxels of a Mitsuba grid volume.
inline std::string vol_header(const std::array<std::uint32_t, 3>& size, std::uint32_t channels = 1,
                              const std::array<float, 6>& box = {0, 0, 0, 1, 1, 1}) {
    std::string bytes = "VOL\3";
    put(bytes, std::uint32_t{1});
    for (const std::uint32_t edge : size) put(bytes, edge);
    put(bytes, channels);
    for (const float bound : box) put(bytes, bound);
    return bytes;
}

/// A Mitsuba grid volume.
inline std::string vol_file(const std::array<std::uint32_t, 3>& size,
                            const std::vector<float>& densities,
                            const std::array<float, 6>& box = {0, 0, 0, 1, 1, 1},
                            std::uint32_t channels = 1) {
    std::string bytes = vol_header(size, channels, box);
    for (const float density : densities) put(bytes, density);
    return bytes;
}

}  // namespace weft

#endif
