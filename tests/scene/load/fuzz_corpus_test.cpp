// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/hdr.h"
#include "image/read_png.h"
#include "plan/preset.h"
#include "scene/load/load_scene.h"
#include "scene/texture/image_file.h"
#include "scene/volume/nanovdb_reader.h"
#include "scene/volume/vol_reader.h"
#include "tests/fuzz/readers.h"
#include "tests/testing/temporary_folder.h"
#include "tradeoff/other_renderers.h"
#include "view/view_message.h"

namespace weft::fuzz_corpus_test {
namespace {

namespace fs = std::filesystem;

fs::path fuzz_folder() {
    return fs::path(WEFT_SOURCE_DIR) / "tests" / "fuzz";
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::set<fs::path> files;
    if (fs::is_directory(folder))
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            files.insert(entry.path());
    return {files.begin(), files.end()};
}

std::vector<std::byte> bytes_of(const fs::path& file) {
    return read_file(file, std::size_t{1} << 20);
}

TEST(FuzzCorpus, IsReadOrRefusedWell) {
    for (const fuzz::Reader& reader : fuzz::readers()) {
        const std::vector<fs::path> files = files_in(fuzz_folder() / "corpus" / reader.name);
        EXPECT_GE(files.size(), 3u) << reader.name;
        for (const fs::path& file : files) EXPECT_NO_THROW(reader.read(bytes_of(file))) << file;
    }
}

TEST(FuzzCorpus, WhatOnceFailedDoesNotFail) {
    for (const fuzz::Reader& reader : fuzz::readers())
        for (const fs::path& file : files_in(fuzz_folder() / "regressions" / reader.name))
            EXPECT_NO_THROW(reader.read(bytes_of(file))) << file;
}

// Cut files take the paths that valid ones do not.
TEST(FuzzCorpus, IsReadOrRefusedWellWhenCut) {
    for (const fuzz::Reader& reader : fuzz::readers()) {
        for (const fs::path& file : files_in(fuzz_folder() / "corpus" / reader.name)) {
            const std::vector<std::byte> bytes = bytes_of(file);
            for (const std::size_t part : {1u, 4u, 7u}) {
                const std::size_t length = bytes.size() * part / 8;
                EXPECT_NO_THROW(reader.read(fuzz::Bytes(bytes).first(length)))
                    << file << " cut to " << length;
            }
        }
    }
}

/// Reads a file of the corpus for what it is; throws Error where the reader refuses it.
void read_valid(const std::string& kind, const TemporaryFolder& folder, const fs::path& file) {
    const std::vector<std::byte> bytes = bytes_of(file);
    const fs::path copy =
        folder.write(file.filename().string(),
                     std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    Diagnostics ignored;
    if (kind == "image")
        static_cast<void>(decode_image(bytes, "picture"));
    else if (kind == "hdr")
        static_cast<void>(decode_hdr(bytes, "picture"));
    else if (kind == "png")
        static_cast<void>(decode_png(bytes, "picture"));
    else if (kind == "vol")
        static_cast<void>(decode_vol(bytes, "grid", ignored));
    else if (kind == "nanovdb")
        static_cast<void>(decode_nanovdb(bytes, "", "grid", ignored));
    else if (kind == "exr")
        static_cast<void>(read_exr(copy));
    else if (kind == "preset")
        static_cast<void>(read_preset(copy));
    else if (kind == "view")
        static_cast<void>(
            read_view_message({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
    else if (kind == "peers")
        static_cast<void>(read_other_renderers(copy, fuzz::pair_size));
    else
        static_cast<void>(load_scene(copy, ignored));
}

// A corpus of files that are all refused would find little.
TEST(FuzzCorpus, IsValidButForBadFiles) {
    const TemporaryFolder folder;
    fuzz::write_companions(folder);
    for (const fuzz::Reader& reader : fuzz::readers()) {
        const std::string kind = reader.name;
        if (kind == "options") continue;
        for (const fs::path& file : files_in(fuzz_folder() / "corpus" / kind)) {
            if (file.filename().string().starts_with("bad")) {
                EXPECT_THROW(read_valid(kind, folder, file), Error) << file;
            } else {
                EXPECT_NO_THROW(read_valid(kind, folder, file)) << file;
            }
        }
    }
}

}  // namespace
}  // namespace weft::fuzz_corpus_test
