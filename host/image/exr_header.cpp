// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/exr_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

constexpr std::uint32_t exr_magic = 20000630;
constexpr std::uint32_t tiled_flag = 0x200;
constexpr std::uint32_t deep_flag = 0x800;
constexpr std::uint32_t multi_part_flag = 0x1000;
constexpr std::uint32_t known_flags = 0x1E00;
constexpr std::uint32_t last_compression = 9;  // DWAB
constexpr std::size_t max_name_length = 255;

/// Reads little-endian fields one after another, never past the end.
class Cursor {
  public:
    Cursor(std::span<const std::byte> bytes, const std::string& place)
        : bytes_(bytes), place_(place) {}

    [[nodiscard]] std::uint32_t read_uint() {
        const std::span<const std::byte> field = take(4);
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value |= std::to_integer<std::uint32_t>(field[i]) << (8 * i);
        return value;
    }

    [[nodiscard]] std::int64_t read_int() { return static_cast<std::int32_t>(read_uint()); }

    /// Text up to a NUL byte, without it.
    [[nodiscard]] std::string_view read_name() {
        const auto end = std::find(bytes_.begin(), bytes_.end(), std::byte{0});
        const auto length = static_cast<std::size_t>(end - bytes_.begin());
        if (end == bytes_.end() || length > max_name_length)
            throw input_error(place_,
                              "the header holds a name that does not end, expected at "
                              "most 255 characters");
        const std::span<const std::byte> text = take(length + 1);
        return {reinterpret_cast<const char*>(text.data()), length};
    }

    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

    [[nodiscard]] std::span<const std::byte> take(std::size_t size) {
        if (size > bytes_.size())
            throw input_error(place_,
                              "the header ends early or is too long, expected a complete "
                              "header of at most " +
                                  std::to_string(limits::max_exr_header_bytes) + " bytes");
        const std::span<const std::byte> result = bytes_.first(size);
        bytes_ = bytes_.subspan(size);
        return result;
    }

  private:
    std::span<const std::byte> bytes_;
    const std::string& place_;
};

void check_version(std::uint32_t version, const std::string& place) {
    if ((version & 0xFF) != 2)
        throw input_error(
            place, "is OpenEXR version " + std::to_string(version & 0xFF) + ", expected version 2");
    if ((version & multi_part_flag) != 0)
        throw input_error(place, "has several parts, expected a single-part OpenEXR file");
    if ((version & (tiled_flag | deep_flag)) != 0)
        throw input_error(place, "holds tiles or deep data, expected flat scan lines");
    if ((version & ~(known_flags | 0xFFu)) != 0)
        throw input_error(place, "uses unknown OpenEXR features");
}

void check_data_window(Cursor value, const std::string& place) {
    const std::int64_t min_x = value.read_int();
    const std::int64_t min_y = value.read_int();
    const std::int64_t width = value.read_int() - min_x + 1;
    const std::int64_t height = value.read_int() - min_y + 1;
    constexpr std::int64_t max_edge = limits::max_film_edge;
    constexpr std::int64_t max_offset = std::int64_t{1} << 29;
    if (width < 1 || height < 1 || std::abs(min_x) > max_offset || std::abs(min_y) > max_offset)
        throw input_error(place, "has an invalid data window");
    if (width > max_edge || height > max_edge ||
        static_cast<std::size_t>(width * height) > limits::max_film_pixels)
        throw input_error(place, "is " + std::to_string(width) + "x" + std::to_string(height) +
                                     " pixels large, expected at most " + std::to_string(max_edge) +
                                     " each way and " + std::to_string(limits::max_film_pixels) +
                                     " in all");
}

void check_channels(Cursor value, const std::string& place) {
    std::size_t count = 0;
    while (!value.read_name().empty()) {
        const std::uint32_t type = value.read_uint();
        static_cast<void>(value.read_uint());  // perceptual linearity
        const std::int64_t sampling_x = value.read_int();
        const std::int64_t sampling_y = value.read_int();
        if (type > 2) throw input_error(place, "has a channel of an unknown type");
        if (sampling_x != 1 || sampling_y != 1)
            throw input_error(place, "has a subsampled channel, expected full resolution");
        if (++count > limits::max_exr_channels)
            throw input_error(
                place, "has more than " + std::to_string(limits::max_exr_channels) + " channels");
    }
    if (count == 0) throw input_error(place, "has no channels");
    if (value.left() > 0) throw input_error(place, "has bytes after its list of channels");
}

struct AttributeSize {
    std::string_view type;
    std::size_t bytes;
};

// Sizes of the attribute types that OpenEXR reads without checking the stated size.
constexpr std::array<AttributeSize, 24> attribute_sizes = {{
    {"box2i", 16},      {"box2f", 16},    {"chromaticities", 32},
    {"compression", 1}, {"double", 8},    {"deepImageState", 1},
    {"envmap", 1},      {"float", 4},     {"int", 4},
    {"keycode", 28},    {"lineOrder", 1}, {"m33d", 72},
    {"m33f", 36},       {"m44d", 128},    {"m44f", 64},
    {"rational", 8},    {"tiledesc", 9},  {"timecode", 8},
    {"v2i", 8},         {"v2f", 8},       {"v2d", 16},
    {"v3i", 12},        {"v3f", 12},      {"v3d", 24},
}};

void check_compression(Cursor value, const std::string& place) {
    if (std::to_integer<std::uint32_t>(value.take(1)[0]) > last_compression)
        throw input_error(place,
                          "uses an unknown compression, expected none, RLE, ZIPS, ZIP, PIZ, PXR24, "
                          "B44, B44A, DWAA or DWAB");
}

/// Files of several parts must have a type, files of a single one may.
void check_part_type(std::string_view type, std::span<const std::byte> value,
                     const std::string& place) {
    const std::string_view text(reinterpret_cast<const char*>(value.data()), value.size());
    if (type != "string" || text != "scanlineimage")
        throw input_error(place, "holds " + quote(text) + ", expected 'scanlineimage'");
}

bool is_string_list(Cursor value) {
    while (value.left() > 0) {
        if (value.left() < 4) return false;
        const std::uint32_t length = value.read_uint();
        if (length > value.left()) return false;
        static_cast<void>(value.take(length));
    }
    return true;
}

/// Checks that the stated size of an attribute agrees with its type: OpenEXR reads the bytes that
/// the type needs whatever size is stated, and would otherwise go on at another place of the header
/// than the check.
void check_size(std::string_view type, std::size_t size, Cursor value, const std::string& place) {
    bool good = type != "idmanifest";  // compressed: expands to any size
    for (const AttributeSize& known : attribute_sizes)
        if (known.type == type) good = known.bytes == size;
    if (type == "floatvector") good = size % 4 == 0;
    if (type == "stringvector") good = is_string_list(value);
    if (type == "preview") {
        good = size >= 8;
        if (good) {
            const std::uint64_t width = value.read_uint();
            const std::uint64_t height = value.read_uint();
            good = width * height <= limits::max_exr_header_bytes && width * height * 4 == size - 8;
        }
    }
    if (!good)
        throw input_error(place, "has an attribute of type " + quote(type) + " and " +
                                     std::to_string(size) + " bytes, which cannot be");
}

}  // namespace

void check_exr_header(std::span<const std::byte> bytes, const std::string& place) {
    Cursor header(bytes.first(std::min(bytes.size(), limits::max_exr_header_bytes)), place);
    if (bytes.size() < 8 || header.read_uint() != exr_magic)
        throw input_error(place, "is not an OpenEXR file");
    check_version(header.read_uint(), place);
    bool has_window = false;
    bool has_channels = false;
    bool has_compression = false;
    for (;;) {
        const std::string_view name = header.read_name();
        if (name.empty()) break;
        const std::string_view type = header.read_name();
        const std::uint32_t size = header.read_uint();
        const std::span<const std::byte> content = header.take(size);
        const Cursor value(content, place);
        check_size(type, size, value, place);
        if (type == "chlist") check_channels(value, place);  // each is read up to its end mark
        if (name == "dataWindow" && type == "box2i") {
            check_data_window(value, place);
            has_window = true;
        } else if (name == "channels" && type == "chlist") {
            has_channels = true;
        } else if (name == "compression" && type == "compression") {
            check_compression(value, place);
            has_compression = true;
        } else if (name == "type") {
            check_part_type(type, content, place);
        }
    }
    if (!has_window || !has_channels || !has_compression)
        throw input_error(place, "lacks a data window, channels or compression in its header");
}

}  // namespace weft
