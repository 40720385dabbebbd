// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/vol_reader.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/error.h"
#include "base/warning_collector.h"

namespace weft {
namespace {

constexpr std::size_t header_bytes = 48;
constexpr std::size_t sizes_offset = 8;
constexpr std::size_t channels_offset = 20;
constexpr std::size_t box_offset = 24;

/// The little-endian 32-bit number at an offset.
std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;)
        word = word << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
    return word;
}

float float_at(std::span<const std::byte> bytes, std::size_t offset) {
    return std::bit_cast<float>(word_at(bytes, offset));
}

void check_kind(std::span<const std::byte> bytes, const std::string& file) {
    if (!is_vol(bytes))
        throw input_error(file, "not a grid volume, expected a file that begins with VOL");
    if (bytes.size() < header_bytes)
        throw input_error(
            file, fmt::format("the file ends inside its header, expected {} bytes", header_bytes));
    const auto version = std::to_integer<unsigned>(bytes[3]);
    if (version != 3)
        throw input_error(file, fmt::format("grid volume of version {}, expected 3", version));
    const std::uint32_t encoding = word_at(bytes, 4);
    if (encoding != 1)
        throw input_error(file,
                          fmt::format("voxels of encoding {}, expected 1 (float32)", encoding));
    const std::uint32_t channels = word_at(bytes, channels_offset);
    if (channels != 1 && channels != 3)
        throw input_error(file,
                          fmt::format("a grid volume of {} channels, expected 1 or 3", channels));
}

GridSize read_size(std::span<const std::byte> bytes, const std::string& file) {
    GridSize size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        size[axis] = word_at(bytes, sizes_offset + 4 * axis);
        if (size[axis] > static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max()))
            throw input_error(file,
                              fmt::format("a grid of {} voxels along {}, expected 0 or more",
                                          static_cast<std::int32_t>(size[axis]), "xyz"[axis]));
    }
    return size;
}

/// Unit cube to bounding box.
glm::dmat4 read_placement(std::span<const std::byte> bytes, const std::string& file,
                          Diagnostics& diagnostics) {
    glm::dmat4 placement(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t offset = box_offset + 4 * static_cast<std::size_t>(axis);
        const double low = float_at(bytes, offset);
        const double high = float_at(bytes, offset + 12);
        // Scenes are placed in single precision.
        if (!std::isfinite(static_cast<float>(high - low)) || !(low < high)) {
            WarningCollector(diagnostics)
                .once(file, fmt::format("bounding box from {} to {} along {}, expected finite "
                                        "bounds in this order, the unit cube is used",
                                        low, high, "xyz"[axis]));
            return glm::dmat4(1.0);
        }
        placement[axis][axis] = high - low;
        placement[3][axis] = low;
    }
    return placement;
}

}  // namespace

bool is_vol(std::span<const std::byte> bytes) {
    return bytes.size() >= 4 && bytes[0] == std::byte{'V'} && bytes[1] == std::byte{'O'} &&
           bytes[2] == std::byte{'L'};
}

DensityGrid decode_vol(std::span<const std::byte> bytes, const std::string& file,
                       Diagnostics& diagnostics) {
    check_kind(bytes, file);
    DensityGrid grid;
    grid.size = read_size(bytes, file);
    grid.channels = word_at(bytes, channels_offset);
    const std::size_t voxels = checked_voxel_count(grid.size, file);
    const std::size_t count = voxels * grid.channels;
    const std::size_t held = (bytes.size() - header_bytes) / sizeof(float);
    if (held < count)
        throw input_error(
            file, fmt::format("the file holds {} of {} voxels", held / grid.channels, voxels));
    if (bytes.size() - header_bytes > count * sizeof(float))
        WarningCollector(diagnostics).once(file, "data after the last voxel is ignored");
    grid.placement = read_placement(bytes, file, diagnostics);
    grid.densities.resize(count);
    // The file has the channels of a voxel beside each other.
    for (std::size_t i = 0; i < count; ++i)
        grid.densities[i % grid.channels * voxels + i / grid.channels] =
            float_at(bytes, header_bytes + i * sizeof(float));
    validate_density_grid(grid, file);
    return grid;
}

}  // namespace weft
