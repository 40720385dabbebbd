// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/bvh_cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/content_digest.h"
#include "bvh/leaves.h"
#include "bvh/moving_bvh.h"
#include "tests/testing/bvh_meshes.h"
#include "tests/testing/temporary_folder.h"

// A tree that comes from the cache is the one that would have been built; whatever else lies there
// changes nothing.
namespace weft::bvh_cache_test {
namespace {

namespace fs = std::filesystem;
using test::BvhMesh;

constexpr BvhCacheLimits keep_all{.least_build_ms = 0.0};

template <class T>
bool same_bytes(const LargeVector<T>& a, const LargeVector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same_tree(const WideBvh& a, const WideBvh& b) {
    return same_bytes(a.nodes, b.nodes) && same_bytes(a.leaves, b.leaves) && a.depth == b.depth &&
           a.stack_need == b.stack_need && a.has_spatial_splits == b.has_spatial_splits &&
           a.sah_cost == b.sah_cost;
}

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void overwrite(const fs::path& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file << bytes;
}

// Where a file has its parts.
constexpr std::size_t checksum_at = 48;
constexpr std::size_t nodes_at = checksum_at + 16;
constexpr std::size_t extent_at = nodes_at + 16;
constexpr std::size_t cost_at = extent_at + 16;
constexpr std::size_t content_at = cost_at + 8;

/// Gives bytes that somebody has changed the checksum that they call for.
std::string signed_anew(std::string bytes) {
    std::uint64_t nodes = 0;
    std::memcpy(&nodes, &bytes[nodes_at], sizeof(nodes));
    if (nodes > bytes.size() / sizeof(shared::BvhNode)) return bytes;  // refused by its length
    const std::size_t leaves_at = content_at + nodes * sizeof(shared::BvhNode);
    const auto part = [&](std::size_t begin, std::size_t end) {
        return std::string_view(bytes).substr(begin, end - begin);
    };
    ContentDigest digest;
    for (std::size_t at : {nodes_at, nodes_at + 8}) digest.add(part(at, at + 8));
    for (std::size_t i = 0; i < 4; ++i) digest.add(part(extent_at + 4 * i, extent_at + 4 * i + 4));
    digest.add(part(cost_at, content_at));
    digest.add(part(content_at, leaves_at));
    digest.add(part(leaves_at, bytes.size()));
    const std::array<std::uint64_t, 2> checksum = digest.value();
    std::memcpy(&bytes[checksum_at], checksum.data(), sizeof(checksum));
    return bytes;
}

class BvhCacheTest : public testing::Test {
  protected:
    [[nodiscard]] WideBvh build(const BvhMesh& mesh, const BvhSettings& settings = {}) const {
        return cache_.build(mesh.positions, mesh.triangles, settings);
    }
    [[nodiscard]] fs::path only_file() const {
        EXPECT_EQ(files(), 1U);
        return fs::directory_iterator(at_)->path();
    }
    [[nodiscard]] std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(at_), {}));
    }
    /// That the mesh is built anew, right, and kept again.
    void expect_rebuilt(const std::string& when) const {
        const WideBvh rebuilt = build(mesh_);
        EXPECT_FALSE(rebuilt.from_cache) << when;
        EXPECT_TRUE(same_tree(rebuilt, expected_)) << when;
        EXPECT_TRUE(build(mesh_).from_cache) << when;
    }

    TemporaryFolder folder_;
    fs::path at_ = folder_.path() / "cache";
    BvhCache cache_{at_, keep_all};
    BvhMesh mesh_ = test::random_soup(60, 0.1F, 3);
    WideBvh expected_ = build_bvh(mesh_.positions, mesh_.triangles, {});
};

TEST_F(BvhCacheTest, GivesBackWhatWasBuiltBitForBit) {
    const BvhMesh split = test::diagonal_needles(300, 3);
    for (const BvhMesh& mesh : {mesh_, split, BvhMesh{}}) {
        const WideBvh built = build(mesh);
        EXPECT_FALSE(built.from_cache);
        const WideBvh read = build(mesh);
        EXPECT_TRUE(read.from_cache);
        EXPECT_GT(read.build_ms, 0.0);
        EXPECT_TRUE(same_tree(read, built));
    }
    EXPECT_TRUE(build(split).has_spatial_splits) << "this mesh shall be split";
}

TEST_F(BvhCacheTest, WhateverATreeDependsOnIsInItsKey) {
    static_cast<void>(build(mesh_));
    std::vector<BvhMesh> meshes(3, mesh_);
    meshes[0].positions[5].y = std::nextafter(meshes[0].positions[5].y, 2.0F);
    std::swap(meshes[1].triangles[0], meshes[1].triangles[1]);
    meshes[2].triangles.pop_back();
    for (const BvhMesh& mesh : meshes) EXPECT_FALSE(build(mesh).from_cache);
    std::vector<BvhSettings> settings(4);
    settings[0].spatial_splits = false;
    settings[1].max_leaf_triangles = 4;
    settings[2].padding = 0.01F;
    settings[3].max_stack = BVH_STACK - 1;
    for (const BvhSettings& other : settings) EXPECT_FALSE(build(mesh_, other).from_cache);
    EXPECT_EQ(files(), 1U + meshes.size() + settings.size());
    EXPECT_TRUE(build(mesh_).from_cache);
}

TEST_F(BvhCacheTest, WhatIsBuiltFastIsNotKept) {
    const BvhCache cache(at_, {.least_build_ms = 1e6});
    static_cast<void>(cache.build(mesh_.positions, mesh_.triangles, {}));
    EXPECT_FALSE(fs::exists(at_));
    // What another limit has kept is taken nevertheless.
    static_cast<void>(build(mesh_));
    EXPECT_TRUE(cache.build(mesh_.positions, mesh_.triangles, {}).from_cache);
}

TEST_F(BvhCacheTest, TruncatedAndLongerFilesAreBuiltAnew) {
    static_cast<void>(build(mesh_));
    const std::string whole = content(only_file());
    for (std::size_t size = 0; size < whole.size(); size += 97) {
        overwrite(only_file(), whole.substr(0, size));
        expect_rebuilt(std::to_string(size) + " bytes");
    }
    overwrite(only_file(), whole + "x");
    expect_rebuilt("a byte more");
    EXPECT_EQ(content(only_file()), whole);
}

TEST_F(BvhCacheTest, EveryFlippedBitIsNoticed) {
    static_cast<void>(build(mesh_));
    const std::string whole = content(only_file());
    // All of the header, and bits all over the rest.
    for (std::size_t at = 0; at < whole.size(); at += at < content_at ? 1 : 41) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 1 << at % 8);
        overwrite(only_file(), damaged);
        expect_rebuilt("byte " + std::to_string(at));
    }
}

TEST_F(BvhCacheTest, WrongTreesWithTheRightChecksumAreNoticed) {
    static_cast<void>(build(mesh_));
    const std::string whole = content(only_file());
    ASSERT_EQ(signed_anew(whole), whole) << "the test knows the format";
    const auto expect_refused = [&](const std::string& when, std::size_t at, std::uint32_t word) {
        std::string forged = whole;
        ASSERT_NE(std::memcmp(&forged[at], &word, sizeof(word)), 0) << when;
        std::memcpy(&forged[at], &word, sizeof(word));
        overwrite(only_file(), signed_anew(forged));
        expect_rebuilt(when);
    };
    const std::size_t child_at = content_at + offsetof(shared::BvhNode, child);
    expect_refused("a node that does not exist", child_at, 0x7fff0000U);
    expect_refused("a leaf beyond the last", child_at, BVH_LEAF | 1U << BVH_COUNT_SHIFT | 9999U);
    expect_refused("a circle", child_at, 0U);
    expect_refused("a child less", child_at, BVH_EMPTY);
    expect_refused("a box that is too small", content_at, 0x7f7fffffU);
    expect_refused("a box that is no number", content_at, 0x7fc00000U);
    expect_refused("another depth", extent_at, 77U);
    expect_refused("a stack that is too small", extent_at + 4, 1U);
    expect_refused("splits that there are not", extent_at + 8, 1U);
    expect_refused("a cost that is no number", cost_at + 4, 0x7ff80000U);
    std::uint64_t nodes = 0;
    std::memcpy(&nodes, &whole[nodes_at], sizeof(nodes));
    const std::size_t leaves_at = content_at + nodes * sizeof(shared::BvhNode);
    expect_refused("another vertex", leaves_at, 0x3f800001U);
    expect_refused("counts beyond the file", nodes_at, 0xfffffff0U);
    expect_refused("counts that overflow", nodes_at + 4, 0x10000000U);
}

TEST_F(BvhCacheTest, AnEntryUnderAnotherNameIsNotTaken) {
    static_cast<void>(build(mesh_));
    const fs::path mine = only_file();
    const BvhMesh other = test::random_soup(60, 0.1F, 4);
    static_cast<void>(build(other));
    std::string foreign;
    for (const auto& entry : fs::directory_iterator(at_))
        if (entry.path() != mine) foreign = content(entry.path());
    overwrite(mine, foreign);
    expect_rebuilt("another mesh's file");
}

TEST_F(BvhCacheTest, OtherKindsOfFilesInItsPlaceAreNoError) {
    static_cast<void>(build(mesh_));
    const fs::path path = only_file();
    fs::remove(path);
    fs::create_directories(path / "inside");
    EXPECT_TRUE(same_tree(build(mesh_), expected_)) << "a folder";
    fs::remove_all(path);
    fs::create_symlink(folder_.path() / "nowhere" / "else", path);
    EXPECT_TRUE(same_tree(build(mesh_), expected_)) << "a broken link";
    fs::remove(path);
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    EXPECT_TRUE(same_tree(build(mesh_), expected_)) << "a pipe that nobody writes to";
}

TEST_F(BvhCacheTest, AFolderThatCannotBeUsedIsNoError) {
    // A file in the place of the folder: nobody, root included, can write there.
    const BvhCache nowhere(folder_.write("file", "text") / "cache", keep_all);
    const BvhCache none{fs::path(), keep_all};
    for (const BvhCache* const cache : {&nowhere, &none})
        for (int i = 0; i < 2; ++i) {
            const WideBvh bvh = cache->build(mesh_.positions, mesh_.triangles, {});
            EXPECT_FALSE(bvh.from_cache);
            EXPECT_TRUE(same_tree(bvh, expected_));
        }
    if (::geteuid() == 0) return;  // root writes everywhere
    const fs::path closed = folder_.path() / "closed";
    fs::create_directory(closed);
    fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_TRUE(same_tree(BvhCache(closed, keep_all).build(mesh_.positions, mesh_.triangles, {}),
                          expected_));
    fs::permissions(closed, fs::perms::owner_all);
}

TEST_F(BvhCacheTest, TheEntryUnusedForLongestGoesFirst) {
    static_cast<void>(build(mesh_));
    const std::size_t bytes = fs::file_size(only_file());
    const BvhCache small(at_, {.least_build_ms = 0.0, .most_bytes = 3 * bytes + bytes / 2});
    const auto age = [&](int hours) {
        for (const auto& entry : fs::directory_iterator(at_))
            fs::last_write_time(entry.path(), entry.last_write_time() - std::chrono::hours(hours));
    };
    // Meshes of one size: their files need not be of exactly one.
    const auto mesh = [](std::uint32_t seed) { return test::random_soup(60, 0.1F, seed); };
    const auto is_kept = [&](const BvhMesh& of) {
        return small.build(of.positions, of.triangles, {}).from_cache;
    };
    age(1);
    EXPECT_FALSE(is_kept(mesh(10)));
    age(1);
    EXPECT_TRUE(is_kept(mesh_)) << "its use is newer than that of the other now";
    overwrite(at_ / ".left.behind.tmp.bvh", std::string(bytes, 'x'));
    fs::last_write_time(at_ / ".left.behind.tmp.bvh",
                        fs::file_time_type::clock::now() - std::chrono::hours(9));
    EXPECT_FALSE(is_kept(mesh(11)));
    EXPECT_FALSE(fs::exists(at_ / ".left.behind.tmp.bvh"));
    EXPECT_FALSE(is_kept(mesh(12)));
    EXPECT_EQ(files(), 3U);
    EXPECT_TRUE(is_kept(mesh_));
    EXPECT_FALSE(is_kept(mesh(10)));
}

TEST_F(BvhCacheTest, WhatIsTooLargeIsNotKeptAndRemovesNothing) {
    static_cast<void>(build(mesh_));
    const BvhCache small(at_, {.least_build_ms = 0.0, .most_bytes = 1024});
    const BvhMesh other = test::random_soup(60, 0.1F, 4);
    static_cast<void>(small.build(other.positions, other.triangles, {}));
    EXPECT_EQ(files(), 1U);
    EXPECT_TRUE(build(mesh_).from_cache);
}

TEST_F(BvhCacheTest, ProcessesAtOnceGetTheSameTree) {
    std::vector<pid_t> children;
    for (int i = 0; i < 4; ++i) {
        const pid_t child = ::fork();
        if (child == 0) {
            bool good = true;
            for (int round = 0; round < 20; ++round) {
                good = good && same_tree(build(mesh_), expected_);
                std::error_code ignored;
                if (round % 5 == i) fs::remove_all(at_, ignored);
            }
            ::_exit(good ? 0 : 1);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = -1;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_EQ(status, 0);
    }
}

TEST_F(BvhCacheTest, OthersMayNotWriteToItsFolder) {
    static_cast<void>(build(mesh_));
    struct stat status {};
    ASSERT_EQ(::stat(at_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700U);
}

TEST_F(BvhCacheTest, OfAMovingSceneTheRestingPartIsKept) {
    const std::size_t first_moving = 40;
    const auto moving = [&] {
        return MovingBvh(mesh_.positions, mesh_.triangles, first_moving, {}, &cache_);
    };
    const MovingBvh built = moving();
    EXPECT_FALSE(built.bvh().from_cache);
    const MovingBvh read = moving();
    EXPECT_TRUE(read.bvh().from_cache);
    EXPECT_TRUE(same_tree(read.bvh(), built.bvh()));
    EXPECT_EQ(read.resting_nodes(), built.resting_nodes());
}

TEST_F(BvhCacheTest, WhereSomebodyWaitsOnlyWhatIsThereIsUsed) {
    const std::size_t first_moving = 40;
    const auto moving = [&](BvhEffort effort) {
        return MovingBvh(mesh_.positions, mesh_.triangles, first_moving, {}, &cache_, effort);
    };
    for (int i = 0; i < 2; ++i) EXPECT_FALSE(moving(BvhEffort::soon).bvh().from_cache);
    const MovingBvh built = moving(BvhEffort::best);
    EXPECT_FALSE(built.bvh().from_cache);
    const MovingBvh read = moving(BvhEffort::soon);
    EXPECT_TRUE(read.bvh().from_cache);
    EXPECT_TRUE(same_tree(read.bvh(), built.bvh()));
}

}  // namespace
}  // namespace weft::bvh_cache_test
