// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/density_grid_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "tests/testing/temporary_folder.h"

namespace weft::density_grid_file_test {
namespace {

namespace fs = std::filesystem;

fs::path corpus(const std::string& name) {
    return fs::path(WEFT_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / name;
}

std::string error_of(const fs::path& path) {
    Diagnostics ignored;
    try {
        (void)read_density_grid(path, "", "scene.xml:3", ignored);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

TEST(DensityGridFile, TellsFormatsApartByTheirBytes) {
    const TemporaryFolder folder;
    Diagnostics ignored;
    for (const char* name : {"vol/blob.vol", "nanovdb/zip.nvdb"}) {
        const fs::path copy = folder.path() / "grid.any";
        fs::copy_file(corpus(name), copy, fs::copy_options::overwrite_existing);
        EXPECT_FALSE(read_density_grid(copy, "", "scene.xml:3", ignored).densities.empty()) << name;
    }
}

TEST(DensityGridFile, NamesWhatIsWrong) {
    const TemporaryFolder folder;
    EXPECT_EQ(error_of(folder.path() / "none.vol").substr(0, 11), "scene.xml:3");
    const fs::path other = folder.write("smoke.vol", "ply\n");
    EXPECT_EQ(error_of(other), other.string() +
                                   ": not a density grid, expected a Mitsuba grid "
                                   "volume (VOL) or a NanoVDB file (NanoVDB0)");
    EXPECT_EQ(error_of(folder.write("empty.vol", "")).find("not a density grid"),
              (folder.path() / "empty.vol").string().size() + 2);
}

}  // namespace
}  // namespace weft::density_grid_file_test
