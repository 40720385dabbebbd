// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <new>
#include <span>
#include <stdexcept>

#include "base/error.h"
#include "tests/testing/temporary_folder.h"

namespace weft::file_test {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

template <typename Action>
Error error_of(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    return {ExitCode::success, "no error"};
}

TEST(FileRead, ReturnsAllBytesUpToTheLimit) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("a.bin", std::string_view("a\0b\n", 4));
    const std::vector<std::byte> bytes = read_file(path, 4);
    ASSERT_EQ(bytes.size(), 4U);
    EXPECT_EQ(bytes[1], std::byte{0});
    EXPECT_EQ(bytes[3], std::byte{'\n'});
    EXPECT_TRUE(read_file(folder.write("empty", ""), 0).empty());
}

TEST(FileRead, RefusesLongerFiles) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("a.bin", "12345");
    const Error error = error_of([&] { (void)read_file(path, 4); });
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_EQ(std::string(error.what()), path.string() + ": is longer than the limit of 4 bytes");
}

TEST(FileRead, NamesThePlaceThatRefersToAMissingFile) {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "none.bin";
    const Error error = error_of([&] { (void)read_file(path, 4, "scene.xml:7"); });
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_EQ(std::string(error.what()).rfind("scene.xml:7: file '", 0), 0U);
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
}

TEST(FileRead, RefusesFoldersAndPipesWithoutWaiting) {
    const TemporaryFolder folder;
    EXPECT_EQ(error_of([&] { (void)read_file(folder.path(), 4); }).code(), ExitCode::bad_input);
    const fs::path pipe = folder.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(std::string(error_of([&] { (void)read_file(pipe, 4); }).what()),
              pipe.string() + ": is not a regular file");
}

TEST(FileRead, GivesTheFirstBytes) {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.bin", "abcd");
    const auto head = [&](std::size_t most_bytes) {
        const std::vector<std::byte> bytes = read_file_head(path, most_bytes);
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    EXPECT_EQ(head(3), "abc");
    EXPECT_EQ(head(4), "abcd");
    EXPECT_EQ(head(1000), "abcd");
    const std::string long_name = (folder.path() / std::string(300, 'a')).string();
    EXPECT_EQ(std::string(error_of([&] { (void)read_file_head(long_name, 4); }).what()),
              long_name + ": cannot be opened: File name too long");
}

TEST(FileReference, ResolvesAgainstTheFolderOfTheScene) {
    EXPECT_EQ(resolve_reference("dir/scene.gltf", "sub/a.bin", "p", true), "dir/sub/a.bin");
    EXPECT_EQ(resolve_reference("scene.gltf", "a%20b.bin", "p", true), "a b.bin");
    EXPECT_EQ(resolve_reference("scene.xml", "a%20b.bin", "p", false), "a%20b.bin");
    EXPECT_EQ(resolve_reference("scene.xml", "a..b/..c", "p", false), "a..b/..c");
}

TEST(FileReference, RefusesWhatLeavesTheFolder) {
    for (const char* hostile :
         {"", "/etc/passwd", "../a", "a/../b", "a/..", "..", "..\\a", "\\\\host\\a", "C:\\a",
          "http://a/b", "file:///a", "%2e%2e/a", "%2Fetc/passwd", "a%00b", "file%3A//a"}) {
        const Error error =
            error_of([&] { (void)resolve_reference("dir/s.gltf", hostile, "s.gltf#/x", true); });
        EXPECT_EQ(error.code(), ExitCode::bad_input) << hostile;
        EXPECT_EQ(std::string(error.what()).rfind("s.gltf#/x: reference '", 0), 0U) << hostile;
    }
    EXPECT_EQ(error_of([&] {
                  (void)resolve_reference("s.xml", std::string("a\0b", 3), "p", false);
              }).code(),
              ExitCode::bad_input);
}

TEST(FileReference, RefusesBrokenEscapes) {
    for (const char* broken : {"%", "a%2", "%zz", "%-1"})
        EXPECT_EQ(error_of([&] { (void)resolve_reference("s", broken, "p", true); }).code(),
                  ExitCode::bad_input)
            << broken;
}

TEST(FileReference, MessagesStayOnOneShortLine) {
    const std::string hostile = "../\n\x1b[31m" + std::string(5000, 'x');
    const Error error = error_of([&] { (void)resolve_reference("s", hostile, "p", false); });
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos);
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_LT(text.size(), 250U);
}

TEST(FileWrite, CreatesAndReplaces) {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "out.png";
    write_file_atomically(path, bytes_of("first"));
    EXPECT_EQ(content_of(path), "first");
    write_file_atomically(path, bytes_of("second"));
    EXPECT_EQ(content_of(path), "second");
    EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(FileWrite, GivesTheWriterAFileBesideTheTargetWithItsExtension) {
    const TemporaryFolder folder;
    fs::path seen;
    write_file_atomically(folder.path() / "out.exr", [&](const fs::path& temporary) {
        seen = temporary;
        std::ofstream(temporary) << "x";
    });
    EXPECT_EQ(seen.parent_path(), folder.path());
    EXPECT_EQ(seen.extension(), ".exr");
    EXPECT_NE(seen.filename(), "out.exr");
}

TEST(FileWrite, ARehearsalWritesEverythingAndLeavesNoTrace) {
    const TemporaryFolder folder;
    const fs::path old = folder.write("old.txt", "old");
    std::uintmax_t written = 0;
    for (const fs::path& path : {old, folder.path() / "new.txt"}) {
        const auto write = [&](const fs::path& temporary) {
            std::ofstream(temporary) << "twelve bytes";
            written += fs::file_size(temporary);
        };
        write_file_atomically(path, write, WriteMode::rehearsed);
    }
    EXPECT_EQ(written, 24U);
    EXPECT_EQ(folder.entry_count(), 1U);
    EXPECT_EQ(fs::file_size(old), 3U);
}

TEST(FileWrite, WhatNeedNotBeFlushedIsReplacedAllTheSame) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("a.txt", "old");
    const std::string text = "newer";
    write_file_atomically(path, std::as_bytes(std::span(text)), WriteMode::unflushed);
    EXPECT_EQ(fs::file_size(path), 5U);
    EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(FileWrite, KeepsTheOldFileWhenTheWriterFails) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("out.png", "old");
    const Error error = error_of([&] {
        write_file_atomically(path, [](const fs::path& temporary) {
            std::ofstream(temporary) << "half";
            throw std::runtime_error("disk on fire");
        });
    });
    EXPECT_EQ(error.code(), ExitCode::output);
    EXPECT_EQ(std::string(error.what()), path.string() + ": cannot be written: disk on fire");
    EXPECT_EQ(content_of(path), "old");
    EXPECT_EQ(folder.entry_count(), 1U);
    EXPECT_THROW(write_file_atomically(path, [](const fs::path&) { throw std::bad_alloc(); }),
                 std::bad_alloc);
    EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(FileWrite, FailsWithExitCode5WhereNothingCanBeWritten) {
    const TemporaryFolder folder;
    for (const fs::path& path :
         {folder.path() / "none" / "out.png", folder.path(), fs::path(), fs::path("/dev/null")})
        EXPECT_EQ(error_of([&] { write_file_atomically(path, bytes_of("x")); }).code(),
                  ExitCode::output)
            << path;
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(FileWrite, ReplacesNoReadOnlyFileAndKeepsPermissions) {
    const TemporaryFolder folder;
    const fs::path file = folder.write("kept.txt", "old");
    fs::permissions(file, fs::perms::owner_read);
    EXPECT_EQ(error_of([&] { write_file_atomically(file, bytes_of("new")); }).code(),
              ExitCode::output);
    EXPECT_EQ(error_of([&] { check_output(file); }).code(), ExitCode::output);
    EXPECT_EQ(content_of(file), "old");
    EXPECT_EQ(folder.entry_count(), 1U);
    constexpr fs::perms own = fs::perms::owner_read | fs::perms::owner_write;
    fs::permissions(file, own);
    check_output(file);
    write_file_atomically(file, bytes_of("new"));
    EXPECT_EQ(content_of(file), "new");
    EXPECT_EQ(fs::status(file).permissions(), own);
    EXPECT_EQ(error_of([&] { check_output(folder.path() / "none" / "x.png"); }).code(),
              ExitCode::output);
    EXPECT_EQ(error_of([&] { check_output(folder.path()); }).code(), ExitCode::output);
}

TEST(FileWrite, WritesThroughSymbolicLinks) {
    const TemporaryFolder folder;
    const fs::path real = folder.write("real.txt", "old");
    const fs::path link = folder.path() / "link.txt";
    fs::create_symlink("real.txt", link);
    write_file_atomically(link, bytes_of("new"));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(content_of(real), "new");
}

}  // namespace
}  // namespace weft::file_test
