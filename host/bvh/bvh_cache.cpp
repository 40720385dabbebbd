// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/bvh_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>
#include <type_traits>
#include <vector>

#include "base/cache_folder.h"
#include "base/content_digest.h"
#include "base/file.h"
#include "base/stopwatch.h"
#include "bvh/embree.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// Counts changes of the builder that give other trees for the same triangles.
constexpr std::uint32_t builder_version = 1;
constexpr std::string_view extension = ".bvh";
constexpr std::size_t key_length = 32;

/// The beginning of a file; nodes and leaves follow.
struct Header {
    std::array<char, 16> magic{'w', 'e', 'f', 't', '-', 'b', 'v', 'h', '-', '1', '\n'};
    std::array<char, key_length> key{};
    std::array<std::uint64_t, 2> checksum{};  ///< of what comes after it, to the end of the file
    std::uint64_t nodes = 0;
    std::uint64_t floats = 0;  ///< of the leaves
    std::uint32_t depth = 0;
    std::uint32_t stack_need = 0;
    std::uint32_t has_spatial_splits = 0;
    std::uint32_t unused = 0;
    double sah_cost = 0.0;
};
static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) == 104);

Header header_of(const std::string& key, const WideBvh& bvh) {
    Header header;
    std::copy_n(key.begin(), std::min(key.size(), key_length), header.key.begin());
    header.nodes = bvh.nodes.size();
    header.floats = bvh.leaves.size();
    header.depth = bvh.depth;
    header.stack_need = bvh.stack_need;
    header.has_spatial_splits = bvh.has_spatial_splits ? 1 : 0;
    header.sah_cost = bvh.sah_cost;
    ContentDigest digest;
    digest.add_value(header.nodes);
    digest.add_value(header.floats);
    digest.add_value(header.depth);
    digest.add_value(header.stack_need);
    digest.add_value(header.has_spatial_splits);
    digest.add_value(header.unused);
    digest.add_value(header.sah_cost);
    digest.add(std::as_bytes(std::span(bvh.nodes)));
    digest.add(std::as_bytes(std::span(bvh.leaves)));
    header.checksum = digest.value();
    return header;
}

/// The key of a tree: everything that it depends on.
std::string key_of(std::span<const shared::float4> positions,
                   std::span<const shared::Triangle> triangles, const BvhSettings& settings) {
    ContentDigest digest;
    digest.add(fmt::format("weft {} builder {} embree {} nodes {} x {} leaves {}", WEFT_VERSION,
                           builder_version, RTC_VERSION, sizeof(shared::BvhNode),
                           std::extent_v<decltype(shared::BvhNode::child)>, LEAF_ROWS));
    digest.add_value(std::uint32_t{settings.spatial_splits ? 1U : 0U});
    digest.add_value(settings.max_leaf_triangles);
    digest.add_value(settings.padding);
    digest.add_value(settings.max_stack);
    digest.add(std::as_bytes(positions));
    digest.add(std::as_bytes(triangles));
    return digest.text();
}

template <class T>
void read_values(std::ifstream& file, LargeVector<T>& values, std::uint64_t count) {
    values.resize(count);
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(count * sizeof(T)));
}

/// The tree in a file whose bytes are as they were stored under this key.
std::optional<WideBvh> read_entry(const fs::path& path, const std::string& key) {
    std::error_code error;
    // Opening a pipe that nobody writes to would wait for ever.
    if (!fs::is_regular_file(path, error)) return {};
    const std::uintmax_t size = fs::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    Header header;
    if (error || size < sizeof(header) || !file) return {};
    file.read(reinterpret_cast<char*>(&header), sizeof(header));
    const std::uint64_t most = size / sizeof(float);
    // Checked before any memory is allocated for them.
    if (!file || header.nodes > most || header.floats > most ||
        size !=
            sizeof(header) + header.nodes * sizeof(shared::BvhNode) + header.floats * sizeof(float))
        return {};
    WideBvh bvh;
    read_values(file, bvh.nodes, header.nodes);
    read_values(file, bvh.leaves, header.floats);
    if (!file) return {};
    bvh.depth = header.depth;
    bvh.stack_need = header.stack_need;
    bvh.has_spatial_splits = header.has_spatial_splits == 1;
    bvh.sah_cost = header.sah_cost;
    const Header expected = header_of(key, bvh);
    if (std::memcmp(&header, &expected, sizeof(header)) != 0) return {};
    return bvh;
}

/// A file of the cache, or one that was being written when its process ended.
struct Entry {
    fs::path path;
    fs::file_time_type used;
    std::uintmax_t bytes = 0;
};

std::vector<Entry> entries_in(const fs::path& folder) {
    std::vector<Entry> entries;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (at->path().extension() != extension) continue;
        std::error_code gone;  // another process may have removed it
        Entry entry{at->path(), at->last_write_time(gone), 0};
        if (!gone) entry.bytes = at->file_size(gone);
        if (!gone) entries.push_back(std::move(entry));
    }
    return entries;
}

}  // namespace

fs::path BvhCache::file_of(const std::string& key) const {
    return folder_ / (key + std::string(extension));
}

WideBvh BvhCache::build(std::span<const shared::float4> positions,
                        std::span<const shared::Triangle> triangles,
                        const BvhSettings& settings) const {
    if (folder_.empty()) return build_bvh(positions, triangles, settings);
    const std::string key = key_of(positions, triangles, settings);
    if (std::optional<WideBvh> found = load(key, positions, triangles, settings))
        return *std::move(found);
    WideBvh bvh = build_bvh(positions, triangles, settings);
    if (bvh.build_ms >= limits_.least_build_ms) store(key, bvh);
    return bvh;
}

std::optional<WideBvh> BvhCache::find(std::span<const shared::float4> positions,
                                      std::span<const shared::Triangle> triangles,
                                      const BvhSettings& settings) const {
    if (folder_.empty()) return {};
    return load(key_of(positions, triangles, settings), positions, triangles, settings);
}

std::optional<WideBvh> BvhCache::load(const std::string& key,
                                      std::span<const shared::float4> positions,
                                      std::span<const shared::Triangle> triangles,
                                      const BvhSettings& settings) const {
    const Stopwatch watch;
    const fs::path path = file_of(key);
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return {};
    try {
        std::optional<WideBvh> bvh = read_entry(path, key);
        // The checksum tells damage. What somebody else has put there on purpose must not make a
        // traversal leave its memory either, nor miss a triangle.
        if (bvh && bvh->stack_need <= settings.max_stack && std::isfinite(bvh->sah_cost) &&
            check_bvh(*bvh, positions, triangles, settings).empty()) {
            bvh->from_cache = true;
            bvh->build_ms = watch.total();
            fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
            return bvh;
        }
    } catch (const std::bad_alloc&) {
        return {};  // building tells whether that is for lack of memory
    }
    fs::remove(path, ignored);
    return {};
}

void BvhCache::store(const std::string& key, const WideBvh& bvh) const {
    const auto nodes = std::as_bytes(std::span(bvh.nodes));
    const auto leaves = std::as_bytes(std::span(bvh.leaves));
    const std::size_t bytes = sizeof(Header) + nodes.size() + leaves.size();
    if (bytes > limits_.most_bytes / 2) return;
    const auto write = [&](const fs::path& temporary) {
        const Header header = header_of(key, bvh);
        std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
        for (const auto& part : {std::as_bytes(std::span(&header, 1)), nodes, leaves})
            file.write(reinterpret_cast<const char*>(part.data()),
                       static_cast<std::streamsize>(part.size()));
        file.close();
        if (!file) throw std::runtime_error("not all bytes could be written");
    };
    try {
        make_cache_folder(folder_);
        make_room(bytes);
        write_file_atomically(file_of(key), write, WriteMode::unflushed);
    } catch (const std::exception&) {
        return;
    }
}

void BvhCache::make_room(std::size_t bytes) const {
    std::vector<Entry> entries = entries_in(folder_);
    std::uintmax_t total = bytes;
    for (const Entry& entry : entries) total += entry.bytes;
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (const Entry& entry : entries) {
        if (total <= limits_.most_bytes) return;
        std::error_code ignored;
        fs::remove(entry.path, ignored);
        total -= entry.bytes;
    }
}

}  // namespace weft
