// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/texture/environment_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "image/exr.h"
#include "tests/testing/temporary_folder.h"

// Images of the environment in files: where their texels come to lie, and that broken files give
// one error. Damage to the formats themselves is tested in tests/image.
namespace weft::environment_file_test {
namespace {

/// A Radiance image of 2 x 2 flat pixels of exponent 129: mantissas are 128ths.
std::string small_hdr() {
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n";
    for (const int value : {128, 64, 32, 16})
        text += {static_cast<char>(value), static_cast<char>(value / 2), '\0', '\x81'};
    return text;
}

Image beauty(const std::string& channels, std::vector<float> values, std::uint32_t width,
             std::uint32_t height) {
    Image image;
    image.width = width;
    image.height = height;
    image.layers = {{"", channels, std::move(values)}};
    return image;
}

std::string error_of(const std::filesystem::path& path) {
    try {
        (void)read_environment(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

TEST(EnvironmentFile, ReadsRadianceImages) {
    const TemporaryFolder folder;
    const EnvironmentFile file = read_environment(folder.write("sky.hdr", small_hdr()));
    EXPECT_EQ(file.image->name, "sky.hdr");
    EXPECT_EQ(file.image->width, 2U);
    EXPECT_EQ(file.image->height, 2U);
    EXPECT_FALSE(file.image->rows_at_poles);
    EXPECT_EQ(file.mended, 0U);
    // rgb of each texel, the top row first.
    EXPECT_EQ(file.image->radiance, (std::vector<float>{1.0F, 0.5F, 0.0F, 0.5F, 0.25F, 0.0F, 0.25F,
                                                        0.125F, 0.0F, 0.125F, 0.0625F, 0.0F}));
}

TEST(EnvironmentFile, ReadsOpenExrImages) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "sky.exr";
    write_exr(path, beauty("RGB", {1, 2, 10, 20, 100, 200}, 2, 1));
    EXPECT_EQ(read_environment(path).image->radiance, (std::vector<float>{1, 10, 100, 2, 20, 200}));
    // Planes of a file may be in any order and have others among them, or be luminance alone.
    write_exr(path, beauty("RGBA", {1, 10, 100, 0}, 1, 1));
    EXPECT_EQ(read_environment(path).image->radiance, (std::vector<float>{1, 10, 100}));
    write_exr(path, beauty("Y", {3}, 1, 1));
    EXPECT_EQ(read_environment(path).image->radiance, (std::vector<float>{3, 3, 3}));
}

TEST(EnvironmentFile, ReplacesValuesThatAreNoRadiance) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "sky.exr";
    constexpr float infinity = std::numeric_limits<float>::infinity();
    write_exr(path, beauty("RGB",
                           {infinity, -0.5F, -infinity, 1.0F,
                            std::numeric_limits<float>::quiet_NaN(), 2.0F},
                           2, 1));
    const EnvironmentFile file = read_environment(path);
    EXPECT_EQ(file.mended, 4U);
    EXPECT_EQ(file.image->radiance, (std::vector<float>{65504, 0, 0, 0, 1, 2}));
}

TEST(EnvironmentFile, RefusesWhatIsNoImage) {
    const TemporaryFolder folder;
    const auto in_folder = [&](const std::string& name) { return (folder.path() / name).string(); };
    EXPECT_EQ(error_of(in_folder("none.hdr")),
              in_folder("none.hdr") + ": cannot be opened: No such file or directory");
    EXPECT_EQ(error_of(folder.path()), folder.path().string() + ": is not a regular file");
    EXPECT_EQ(
        error_of(folder.write("text.hdr", "not an image")),
        in_folder("text.hdr") + ": is not an image, expected an OpenEXR, Radiance HDR or PNG file");
    EXPECT_EQ(error_of(folder.write("empty.exr", "")),
              in_folder("empty.exr") +
                  ": is not an image, expected an OpenEXR, Radiance HDR or PNG file");
    std::string cut = small_hdr();
    cut.resize(cut.size() - 3);
    EXPECT_EQ(error_of(folder.write("cut.hdr", cut)),
              in_folder("cut.hdr") + ": is cut off, expected all scan lines");
    // A size that the file cannot hold is refused before there is memory for it.
    EXPECT_NE(error_of(folder.write("large.hdr", "#?RADIANCE\n\n-Y 16384 +X 16384\nabcd"))
                  .find("claims 16384 x 16384 pixels"),
              std::string::npos);
    write_exr(folder.path() / "depth.exr", beauty("Z", {1, 2}, 2, 1));
    EXPECT_EQ(error_of(folder.path() / "depth.exr"),
              in_folder("depth.exr") +
                  ": has no colour to light a scene with, expected the channels R, G and B");
    write_exr(folder.path() / "red.exr", beauty("R", {1, 2}, 2, 1));
    EXPECT_EQ(error_of(folder.path() / "red.exr"),
              in_folder("red.exr") +
                  ": has no colour to light a scene with, expected the channels R, G and B");
}

}  // namespace
}  // namespace weft::environment_file_test
