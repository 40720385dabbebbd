// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include "device/opencl/program_cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/testing/temporary_folder.h"

namespace weft::program_cache_test {
namespace {

namespace fs = std::filesystem;
using Program = std::vector<unsigned char>;

std::string key_of(const std::vector<std::string_view>& parts) {
    return ProgramCache::key(parts);
}

Program program(std::size_t size) {
    Program bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<unsigned char>(i * 37 + i / 256);
    return bytes;
}

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void overwrite(const fs::path& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file << bytes;
}

/// A cache with one entry, whose file is the only one of its folder.
class ProgramCacheTest : public testing::Test {
  protected:
    ProgramCacheTest() : cache_(folder_.path() / "cache") { cache_.store(key_, stored_); }

    [[nodiscard]] fs::path file() const {
        const fs::directory_iterator files(folder_.path() / "cache");
        return files->path();
    }

    TemporaryFolder folder_;
    ProgramCache cache_;
    std::string key_ = key_of({"source", "options"});
    Program stored_ = program(300);
};

TEST_F(ProgramCacheTest, GivesBackWhatWasStored) {
    EXPECT_EQ(cache_.load(key_), stored_);
    EXPECT_EQ(ProgramCache(folder_.path() / "cache").load(key_), stored_);
    EXPECT_EQ(cache_.load(key_of({"source", "other"})), std::nullopt);
    for (const std::size_t size : {std::size_t{1}, std::size_t{70000}}) {
        cache_.store(key_, program(size));
        EXPECT_EQ(cache_.load(key_), program(size));
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "cache"), {}), 1);
}

TEST_F(ProgramCacheTest, RemovesEntries) {
    cache_.remove(key_);
    EXPECT_EQ(cache_.load(key_), std::nullopt);
    cache_.remove(key_);  // what is not there is no error
}

TEST_F(ProgramCacheTest, EmptyProgramsAreNotKept) {
    const std::string other = key_of({"other"});
    cache_.store(other, {});
    EXPECT_EQ(cache_.load(other), std::nullopt);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path() / "cache"), {}), 1);
}

TEST_F(ProgramCacheTest, TruncatedEntriesReadAsAbsent) {
    const std::string whole = content(file());
    ASSERT_GT(whole.size(), stored_.size());
    for (std::size_t size = 0; size < whole.size(); size += 7) {
        overwrite(file(), whole.substr(0, size));
        EXPECT_EQ(cache_.load(key_), std::nullopt) << size << " bytes";
    }
    overwrite(file(), whole + "x");
    EXPECT_EQ(cache_.load(key_), std::nullopt);
    overwrite(file(), whole);
    EXPECT_EQ(cache_.load(key_), stored_);
}

TEST_F(ProgramCacheTest, EveryFlippedByteReadsAsAbsent) {
    const std::string whole = content(file());
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        overwrite(file(), damaged);
        EXPECT_EQ(cache_.load(key_), std::nullopt) << "byte " << at;
    }
}

TEST_F(ProgramCacheTest, AnEntryUnderAnotherNameReadsAsAbsent) {
    const std::string other = key_of({"another"});
    cache_.store(other, program(10));
    fs::path moved;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "cache"))
        if (content(entry.path()).find(other) != std::string::npos) moved = entry.path();
    ASSERT_FALSE(moved.empty());
    const std::string whole = content(moved);
    cache_.remove(other);
    overwrite(file(), whole);
    EXPECT_EQ(cache_.load(key_), std::nullopt);
}

TEST_F(ProgramCacheTest, AFolderInPlaceOfAnEntryReadsAsAbsent) {
    const fs::path path = file();
    fs::remove(path);
    fs::create_directories(path / "inside");
    EXPECT_EQ(cache_.load(key_), std::nullopt);
    cache_.store(key_, stored_);
    cache_.remove(key_);
    EXPECT_EQ(cache_.load(key_), std::nullopt);
}

TEST_F(ProgramCacheTest, ABrokenLinkReadsAsAbsent) {
    const fs::path path = file();
    fs::remove(path);
    fs::create_symlink(folder_.path() / "nowhere" / "else", path);
    EXPECT_EQ(cache_.load(key_), std::nullopt);
    cache_.store(key_, stored_);  // whether this mends it or not, it is no error
    cache_.remove(key_);
    EXPECT_EQ(cache_.load(key_), std::nullopt);
}

TEST_F(ProgramCacheTest, OthersMayNotWriteToItsFolder) {
    struct stat status {};
    ASSERT_EQ(::stat((folder_.path() / "cache").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700u);
    // With folders to be made on the way, too.
    const ProgramCache deep(folder_.path() / "a" / "b");
    deep.store(key_, stored_);
    ASSERT_EQ(::stat((folder_.path() / "a" / "b").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700u);
    EXPECT_EQ(deep.load(key_), stored_);
}

TEST_F(ProgramCacheTest, WhatCannotBeWrittenIsNoError) {
    // A file in the place of the folder: nobody, root included, can write there.
    const ProgramCache cache(folder_.write("file", "text") / "cache");
    cache.store(key_, stored_);
    EXPECT_EQ(cache.load(key_), std::nullopt);
    cache.remove(key_);
    EXPECT_EQ(content(folder_.path() / "file"), "text");
    if (::geteuid() == 0) return;  // root writes everywhere
    const fs::path closed = folder_.path() / "closed";
    fs::create_directory(closed);
    fs::permissions(closed, fs::perms::owner_read | fs::perms::owner_exec);
    const ProgramCache read_only(closed);
    read_only.store(key_, stored_);
    EXPECT_EQ(read_only.load(key_), std::nullopt);
    fs::permissions(closed, fs::perms::owner_all);
}

TEST_F(ProgramCacheTest, WithoutAFolderThereIsNoCache) {
    const ProgramCache none{fs::path()};
    none.store(key_, stored_);
    EXPECT_EQ(none.load(key_), std::nullopt);
    none.remove(key_);
}

TEST(ProgramCacheKey, DiffersWithEveryPart) {
    std::set<std::string> keys;
    const std::vector<std::vector<std::string_view>> different{
        {},         {""},         {"", ""},      {"a"},        {"b"},          {"ab"},
        {"a", "b"}, {"b", "a"},   {"ab", ""},    {"", "ab"},   {"a", "", "b"}, {"a", "b", ""},
        {"a\nb"},   {"a", "b\n"}, {"abc", "de"}, {"ab", "cde"}};
    for (const auto& parts : different) {
        const std::string key = key_of(parts);
        EXPECT_EQ(key.size(), 32u);
        EXPECT_EQ(key.find_first_not_of("0123456789abcdef"), std::string::npos);
        keys.insert(key);
    }
    EXPECT_EQ(keys.size(), different.size());
    EXPECT_EQ(key_of({"a", "b"}), key_of({"a", "b"}));
}

TEST(ProgramCacheKey, BothHalvesDependOnEveryBit) {
    std::set<std::string> low;
    std::set<std::string> high;
    std::string text(64, 'k');
    for (std::size_t at = 0; at < text.size(); ++at)
        for (int bit = 0; bit < 8; ++bit) {
            text[at] = static_cast<char>(text[at] ^ 1 << bit);
            const std::string key = key_of({"first", text});
            low.insert(key.substr(0, 16));
            high.insert(key.substr(16));
            text[at] = static_cast<char>(text[at] ^ 1 << bit);
        }
    EXPECT_EQ(low.size(), 512u);
    EXPECT_EQ(high.size(), 512u);
}

/// Sets variables of the environment for the time it lives; null unsets.
class Variables {
  public:
    explicit Variables(std::vector<std::pair<const char*, const char*>> values) {
        for (const auto& [name, value] : values) {
            const char* const old = std::getenv(name);
            old_.emplace_back(name,
                              old == nullptr ? std::nullopt : std::optional<std::string>(old));
            set(name, value);
        }
    }
    ~Variables() {
        for (const auto& [name, value] : old_) set(name, value ? value->c_str() : nullptr);
    }
    Variables(const Variables&) = delete;
    Variables& operator=(const Variables&) = delete;

  private:
    static void set(const char* name, const char* value) {
        if (value == nullptr)
            ::unsetenv(name);
        else
            ::setenv(name, value, 1);
    }
    std::vector<std::pair<const char*, std::optional<std::string>>> old_;
};

TEST(ProgramCacheFolder, ComesFromTheEnvironment) {
    {
        const Variables variables(
            {{"WEFT_CACHE_DIR", "/a"}, {"XDG_CACHE_HOME", "/b"}, {"HOME", "/c"}});
        EXPECT_EQ(default_cache_folder(), "/a");
    }
    {
        const Variables variables(
            {{"WEFT_CACHE_DIR", nullptr}, {"XDG_CACHE_HOME", "/b"}, {"HOME", "/c"}});
        EXPECT_EQ(default_cache_folder(), "/b/weft");
    }
    // A relative XDG folder is to be ignored, says its specification.
    for (const char* xdg : {static_cast<const char*>(nullptr), "", "relative"}) {
        const Variables variables(
            {{"WEFT_CACHE_DIR", ""}, {"XDG_CACHE_HOME", xdg}, {"HOME", "/c"}});
        EXPECT_EQ(default_cache_folder(), "/c/.cache/weft");
    }
    const Variables variables(
        {{"WEFT_CACHE_DIR", nullptr}, {"XDG_CACHE_HOME", nullptr}, {"HOME", nullptr}});
    EXPECT_EQ(default_cache_folder(), "");
}

}  // namespace
}  // namespace weft::program_cache_test

#endif
