// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_BVH_CACHE_H
#define WEFT_BVH_BVH_CACHE_H

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "bvh/wide_bvh.h"

namespace weft {

/// What a BvhCache keeps.
struct BvhCacheLimits {
    /// Shortest build whose tree is kept, milliseconds: about the shortest that a user waits for
    /// knowingly. Trees that are built faster would fill the folder and save nobody's time.
    double least_build_ms = 200.0;
    /// Bytes of all entries together; the one that was not used for longest goes first. An entry
    /// of more than half of that is not kept.
    std::size_t most_bytes = std::size_t{1} << 30;
};

/// Keeps trees that took long to build on disk, so that another start on the same model need not
/// build them again. Entries are keyed by everything that a tree depends on: vertices, triangles,
/// settings, and versions of the builder. What is damaged in any way, or does not hold the
/// invariants of check_bvh, reads as absent; a folder that cannot be written is no error.
class BvhCache {
  public:
    /// `folder` empty: no cache.
    explicit BvhCache(std::filesystem::path folder, const BvhCacheLimits& limits = {})
        : folder_(std::move(folder)), limits_(limits) {}

    /// The tree of build_bvh, bit for bit, read from the folder where it is there (then
    /// WideBvh::from_cache is set, and build_ms is the time that this took). Throws as build_bvh.
    [[nodiscard]] WideBvh build(std::span<const shared::float4> positions,
                                std::span<const shared::Triangle> triangles,
                                const BvhSettings& settings) const;
    /// The same where the folder has it, or else nothing.
    [[nodiscard]] std::optional<WideBvh> find(std::span<const shared::float4> positions,
                                              std::span<const shared::Triangle> triangles,
                                              const BvhSettings& settings) const;

  private:
    [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;
    [[nodiscard]] std::optional<WideBvh> load(const std::string& key,
                                              std::span<const shared::float4> positions,
                                              std::span<const shared::Triangle> triangles,
                                              const BvhSettings& settings) const;
    void store(const std::string& key, const WideBvh& bvh) const;
    /// Removes entries, the oldest first, until there is room for one of `bytes`.
    void make_room(std::size_t bytes) const;

    std::filesystem::path folder_;
    BvhCacheLimits limits_;
};

}  // namespace weft

#endif
