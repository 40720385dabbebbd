// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_PLY_PLY_HEADER_H
#define WEFT_SCENE_PLY_PLY_HEADER_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

enum class PlyFormat { ascii, little_endian, big_endian };

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes that one binary value of a type takes.
[[nodiscard]] std::size_t ply_size(PlyType type);

/// Whether a type holds whole numbers.
[[nodiscard]] bool ply_is_integer(PlyType type);

/// One property of an element; `count_type` has a meaning for lists only.
struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8;
};

/// A table of the file: `count` rows of these properties.
struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    std::string place;  ///< `file:line` of its declaration
};

/// The header of a PLY file.
struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t body_offset = 0;  ///< bytes before the data
    std::size_t lines = 0;        ///< before the data
};

/// Reads the header at the start of `text`. `file` names it in errors, which are Errors with
/// `file:line` as their place (exit code 2).
[[nodiscard]] PlyHeader parse_ply_header(std::string_view text, const std::string& file);

}  // namespace weft

#endif
