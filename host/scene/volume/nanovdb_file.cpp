// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/nanovdb_file.h"

#include <blosc.h>
#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/IO.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

// The library's own functions trust a file's sizes; only its structs are used here.
using nanovdb::io::Codec;
using nanovdb::io::Header;
using nanovdb::io::MetaData;
using Bytes = std::span<const std::byte>;

constexpr std::uint64_t first_magic = NANOVDB_MAGIC_NUMBER;  // NanoVDB0
constexpr std::uint64_t file_magic = 0x324244566F6E614EU;    // NanoVDB2, of files since 32.6

/// The bytes of a file from front to back.
class Source {
  public:
    Source(Bytes bytes, const std::string& file) : rest_(bytes), file_(file) {}

    [[nodiscard]] Error error(const std::string& message) const {
        return input_error(file_, message);
    }
    [[nodiscard]] bool at_end() const { return rest_.empty(); }

    Bytes take(std::uint64_t count, const char* what) {
        if (count > rest_.size())
            throw error(fmt::format("the file ends inside {}, expected {} bytes more", what,
                                    count - rest_.size()));
        const Bytes taken = rest_.first(static_cast<std::size_t>(count));
        rest_ = rest_.subspan(taken.size());
        return taken;
    }

    template <typename Value>
    Value take_value(const char* what) {
        std::array<std::byte, sizeof(Value)> raw{};
        const Bytes taken = take(sizeof(Value), what);
        std::copy(taken.begin(), taken.end(), raw.begin());
        return std::bit_cast<Value>(raw);
    }

  private:
    Bytes rest_;
    const std::string& file_;
};

/// The header of a grid: where its packed bytes are, and their sizes.
struct Entry {
    std::string name;
    std::uint64_t size = 0;         ///< unpacked
    std::uint64_t packed_size = 0;  ///< in the file
    std::uint16_t codec = 0;
    Bytes packed;
};

std::uint16_t half_word_at(Bytes bytes, std::size_t offset) {
    std::uint16_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof(value));
    return value;
}

std::uint64_t long_word_at(Bytes bytes, std::size_t offset) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof(value));
    return value;
}

Entry read_entry(Source& source, std::uint16_t codec) {
    const Bytes data = source.take(sizeof(MetaData), "the description of a grid");
    Entry entry;
    entry.size = long_word_at(data, offsetof(MetaData, gridSize));
    entry.packed_size = long_word_at(data, offsetof(MetaData, fileSize));
    entry.codec = codec;
    std::uint32_t name_size = 0;
    std::memcpy(&name_size, data.data() + offsetof(MetaData, nameSize), sizeof(name_size));
    const Bytes name = source.take(name_size, "the name of a grid");
    entry.name.assign(reinterpret_cast<const char*>(name.data()), name.size());
    entry.name.resize(std::min(entry.name.find('\0'), entry.name.size()));
    return entry;
}

/// All grids of all segments.
std::vector<Entry> read_entries(Source& source) {
    std::vector<Entry> entries;
    while (!source.at_end()) {
        const Bytes header = source.take(sizeof(Header), "a header");
        if (!is_nanovdb(header))
            throw source.error("not a NanoVDB file, expected one that begins with NanoVDB0");
        std::uint32_t version = 0;
        std::memcpy(&version, header.data() + offsetof(Header, version), sizeof(version));
        if (version >> 21 != NANOVDB_MAJOR_VERSION_NUMBER)
            throw source.error(fmt::format("NanoVDB of major version {}, expected {}",
                                           version >> 21, NANOVDB_MAJOR_VERSION_NUMBER));
        const std::uint16_t count = half_word_at(header, offsetof(Header, gridCount));
        const std::uint16_t codec = half_word_at(header, offsetof(Header, codec));
        if (count == 0) throw source.error("a segment without grids, expected one or more");
        const std::size_t first = entries.size();
        for (std::uint16_t i = 0; i < count; ++i) entries.push_back(read_entry(source, codec));
        for (std::size_t i = first; i < entries.size(); ++i)
            entries[i].packed = source.take(entries[i].packed_size, "a grid");
    }
    return entries;
}

void unpack_zip(Source packed, std::span<std::byte> grid) {
    const Bytes data =
        packed.take(packed.take_value<std::uint64_t>("a packed grid"), "a packed grid");
    uLongf size = grid.size();
    const int status = uncompress(reinterpret_cast<Bytef*>(grid.data()), &size,
                                  reinterpret_cast<const Bytef*>(data.data()), data.size());
    if (status != Z_OK || size != grid.size())
        throw packed.error("damaged ZIP data, expected those of a grid");
}

void unpack_blosc(Source packed, std::span<std::byte> grid) {
    constexpr std::size_t largest_chunk = std::size_t{1} << 30;  // of the library's writer
    while (!grid.empty()) {
        const Bytes data =
            packed.take(packed.take_value<std::uint64_t>("a packed grid"), "a packed grid");
        const std::size_t chunk = std::min(grid.size(), largest_chunk);
        std::size_t size = 0;
        if (data.size() < BLOSC_MIN_HEADER_LENGTH ||
            blosc_cbuffer_validate(data.data(), data.size(), &size) != 0 || size != chunk ||
            blosc_decompress_ctx(data.data(), grid.data(), chunk, 1) != static_cast<int>(chunk))
            throw packed.error("damaged BLOSC data, expected those of a grid");
        grid = grid.subspan(chunk);
    }
}

const Entry& choose(const std::vector<Entry>& entries, const std::string& name,
                    const Source& source) {
    const auto called = [&](std::string_view wanted) {
        return std::find_if(entries.begin(), entries.end(),
                            [&](const Entry& entry) { return entry.name == wanted; });
    };
    if (entries.empty()) throw source.error("no grid, expected one or more");
    const auto found = called(name.empty() ? "density" : name);
    if (found != entries.end()) return *found;
    if (!name.empty())
        throw source.error("no grid is called " + quote(name) + ", the first is " +
                           quote(entries.front().name));
    return entries.front();
}

}  // namespace

bool is_nanovdb(Bytes bytes) {
    if (bytes.size() < sizeof(std::uint64_t)) return false;
    const std::uint64_t magic = long_word_at(bytes, 0);
    return magic == first_magic || magic == file_magic;
}

NanovdbBuffer unpack_nanovdb(Bytes bytes, const std::string& name, const std::string& file) {
    Source source(bytes, file);
    const std::vector<Entry> entries = read_entries(source);
    const Entry& entry = choose(entries, name, source);
    if (entry.size > limits::max_nanovdb_bytes)
        throw source.error(fmt::format("a grid of {} bytes, expected at most {}", entry.size,
                                       limits::max_nanovdb_bytes));
    // Neither ZIP nor BLOSC packs more than 1032 bytes into one.
    constexpr std::uint64_t densest = 1032;
    if (entry.size / densest > entry.packed.size())
        throw source.error(fmt::format("a grid of {} bytes in {} bytes of the file", entry.size,
                                       entry.packed.size()));
    const auto codec = static_cast<Codec>(entry.codec);
    if (codec == Codec::NONE && entry.packed.size() != entry.size)
        throw source.error(
            fmt::format("a grid of {} bytes in {} bytes of the file, expected as "
                        "many",
                        entry.size, entry.packed.size()));
    NanovdbBuffer grid(static_cast<std::size_t>(entry.size));
    const Source packed(entry.packed, file);
    if (codec == Codec::NONE) {
        std::copy(entry.packed.begin(), entry.packed.end(), grid.bytes().begin());
    } else if (codec == Codec::ZIP) {
        unpack_zip(packed, grid.bytes());
    } else if (codec == Codec::BLOSC) {
        unpack_blosc(packed, grid.bytes());
    } else {
        throw source.error(
            fmt::format("compression {}, expected 0 (none), 1 (ZIP) or 2 (BLOSC)", entry.codec));
    }
    return grid;
}

}  // namespace weft
