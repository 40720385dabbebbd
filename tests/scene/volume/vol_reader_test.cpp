// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/vol_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/testing/vol_bytes.h"

namespace weft::vol_reader_test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

DensityGrid decode(const std::string& bytes, Diagnostics& diagnostics) {
    return decode_vol(std::as_bytes(std::span(bytes)), "smoke.vol", diagnostics);
}

DensityGrid decode(const std::string& bytes) {
    Diagnostics diagnostics;
    DensityGrid grid = decode(bytes, diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty());
    return grid;
}

std::string error_of(const std::string& bytes) {
    Diagnostics diagnostics;
    try {
        (void)decode(bytes, diagnostics);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

TEST(VolReader, ReadsVoxelsWithXFirst) {
    const DensityGrid grid = decode(vol_file({3, 2, 1}, {0, 1, 2, 3, 4, 5.5F}));
    EXPECT_EQ(grid.size, (GridSize{3, 2, 1}));
    EXPECT_EQ(grid.densities, (std::vector<float>{0, 1, 2, 3, 4, 5.5F}));
    EXPECT_EQ(grid.placement, glm::dmat4(1.0));
}

TEST(VolReader, PlacesTheCubeInTheBoundingBox) {
    std::string bytes = vol_header({1, 1, 1}, 1, {-1, 2, 3, 1, 2.5F, 13});
    put(bytes, 1.0F);
    const DensityGrid grid = decode(bytes);
    EXPECT_EQ(glm::dvec3(grid.placement * glm::dvec4(0, 0, 0, 1)), glm::dvec3(-1, 2, 3));
    EXPECT_EQ(glm::dvec3(grid.placement * glm::dvec4(1, 1, 1, 1)), glm::dvec3(1, 2.5, 13));
}

TEST(VolReader, ABoundingBoxThatIsNoneCountsAsTheUnitCube) {
    for (const std::array<float, 6>& box :
         {std::array<float, 6>{0, 0, 0, 0, 1, 1}, std::array<float, 6>{0, 0, 2, 1, 1, 1},
          std::array<float, 6>{0, -infinity, 0, 1, 1, 1},
          std::array<float, 6>{0, 0, 0, 1, std::numeric_limits<float>::quiet_NaN(), 1}}) {
        std::string bytes = vol_header({1, 1, 1}, 1, box);
        put(bytes, 1.0F);
        Diagnostics diagnostics;
        EXPECT_EQ(decode(bytes, diagnostics).placement, glm::dmat4(1.0));
        ASSERT_EQ(diagnostics.warnings().size(), 1U);
        EXPECT_EQ(diagnostics.warnings()[0].substr(0, 28), "smoke.vol: bounding box from");
    }
}

TEST(VolReader, ThreeChannelsFollowOneAnother) {
    const DensityGrid grid = decode(vol_file({2, 1, 1}, {1, 2, 3, 4, 5, 6}, {0, 0, 0, 1, 1, 1}, 3));
    EXPECT_EQ(grid.channels, 3U);
    EXPECT_EQ(grid.densities, (std::vector<float>{1, 4, 2, 5, 3, 6}));
    EXPECT_EQ(greatest_density(grid), 6.0F);
    EXPECT_EQ(mean_density(grid), glm::dvec3(2.5, 3.5, 4.5));
    EXPECT_EQ(greatest_channels(grid).densities, (std::vector<float>{3, 6}));
}

TEST(VolReader, TakesAnEmptyGrid) {
    for (const std::array<std::uint32_t, 3>& size :
         {std::array<std::uint32_t, 3>{0, 0, 0}, {5, 0, 5}, {2147483647, 2147483647, 0}})
        EXPECT_TRUE(decode(vol_header(size)).densities.empty());
}

TEST(VolReader, IgnoresWhatFollowsTheVoxels) {
    Diagnostics diagnostics;
    EXPECT_EQ(decode(vol_file({1, 1, 1}, {2}) + "x", diagnostics).densities.size(), 1U);
    ASSERT_EQ(diagnostics.warnings().size(), 1U);
    EXPECT_EQ(diagnostics.warnings()[0], "smoke.vol: data after the last voxel is ignored");
}

TEST(VolReader, RefusesOtherFiles) {
    const std::string no_vol = "smoke.vol: not a grid volume, expected a file that begins with VOL";
    EXPECT_EQ(error_of(""), no_vol);
    EXPECT_EQ(error_of("VO"), no_vol);
    EXPECT_EQ(error_of("ply\nformat ascii 1.0\n"), no_vol);
    std::string version = vol_file({1, 1, 1}, {1});
    version[3] = 4;
    EXPECT_EQ(error_of(version), "smoke.vol: grid volume of version 4, expected 3");
    std::string encoding = vol_file({1, 1, 1}, {1});
    encoding[4] = 3;
    EXPECT_EQ(error_of(encoding), "smoke.vol: voxels of encoding 3, expected 1 (float32)");
    EXPECT_EQ(error_of(vol_header({1, 1, 1}, 2) + std::string(8, '\0')),
              "smoke.vol: a grid volume of 2 channels, expected 1 or 3");
    EXPECT_EQ(error_of(vol_header({1, 1, 1}, 0)),
              "smoke.vol: a grid volume of 0 channels, expected 1 or 3");
    EXPECT_EQ(error_of(vol_header({2, 1, 1}, 3) + std::string(20, '\0')),
              "smoke.vol: the file holds 1 of 2 voxels");
}

TEST(VolReader, RefusesSizesThatTheFileDoesNotHold) {
    EXPECT_EQ(error_of(vol_header({1, 0xFFFFFFFE, 1})),
              "smoke.vol: a grid of -2 voxels along y, expected 0 or more");
    EXPECT_EQ(error_of(vol_header({2147483647, 2147483647, 2147483647})).substr(0, 64),
              "smoke.vol: a grid of 2147483647 x 2147483647 x 2147483647 voxels");
    // Allowed, but a gigabyte that is not there: refused before memory is taken.
    EXPECT_EQ(error_of(vol_header({1024, 512, 512})),
              "smoke.vol: the file holds 0 of 268435456 voxels");
    EXPECT_EQ(error_of(vol_file({2, 2, 2}, {1, 1, 1, 1, 1, 1, 1}) + "abc"),
              "smoke.vol: the file holds 7 of 8 voxels");
}

TEST(VolReader, RefusesVoxelsThatAreNoDensities) {
    EXPECT_EQ(error_of(vol_file({1, 2, 2}, {0, 1, 2, -1})),
              "smoke.vol: voxel (0, 1, 1) is -1, expected a finite density of at least 0");
    EXPECT_EQ(error_of(vol_file({2, 1, 1}, {0, infinity})),
              "smoke.vol: voxel (1, 0, 0) is inf, expected a finite density of at least 0");
}

TEST(VolReader, RefusesAFileThatIsCutAnywhere) {
    const std::string whole = vol_file({2, 2, 1}, {1, 2, 3, 4});
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(error_of(whole.substr(0, length)), "no error") << length;
    EXPECT_EQ(error_of(whole), "no error");
}

// Whatever a byte is changed to, the file is read or refused.
TEST(VolReader, ReadsOrRefusesAFileWithAnyByteChanged) {
    const std::string whole = vol_file({2, 2, 1}, {1, 2, 3, 4});
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (int value = 0; value < 256; ++value) {
            std::string changed = whole;
            changed[i] = static_cast<char>(value);
            EXPECT_NO_FATAL_FAILURE((void)error_of(changed));
        }
    }
}

}  // namespace
}  // namespace weft::vol_reader_test
