// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "image/hdr.h"
#include "tests/testing/temporary_folder.h"

namespace weft::hdr_image_test {
namespace {

const std::string format = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

std::string bytes_of(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text += static_cast<char>(value);
    return text;
}

Image decode(const std::string& text) {
    return decode_hdr(std::as_bytes(std::span(text)), "picture.hdr");
}

/// The one line of an error; empty where the image was read.
std::string refusal(const std::string& text) {
    try {
        static_cast<void>(decode(text));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos);
        return message;
    }
    return {};
}

bool refuses(const std::string& text, const std::string& part) {
    const std::string message = refusal(text);
    EXPECT_NE(message.find(part), std::string::npos) << "says: " << message;
    return message.find(part) != std::string::npos;
}

/// The red values of an image.
std::vector<float> red_of(const Image& image) {
    const auto& values = image.layers.at(0).values;
    return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 3)};
}

TEST(HdrImage, ReadsFlatPixels) {
    const Image image =
        decode(format + "-Y 1 +X 3\n" + bytes_of({128, 64, 32, 129, 255, 1, 0, 136, 9, 9, 9, 0}));
    EXPECT_EQ(image.width, 3u);
    EXPECT_EQ(image.height, 1u);
    ASSERT_EQ(image.layers.size(), 1u);
    EXPECT_EQ(image.layers[0].channels, "RGB");
    EXPECT_EQ(image.layers[0].values,
              (std::vector<float>{1.0F, 255.0F, 0.0F, 0.5F, 1.0F, 0.0F, 0.25F, 0.0F, 0.0F}));
}

TEST(HdrImage, ReadsExtremeExponents) {
    const Image image = decode(format + "-Y 1 +X 2\n" + bytes_of({255, 0, 0, 255, 1, 0, 0, 1}));
    EXPECT_EQ(red_of(image), (std::vector<float>{0x1.FEp+126F, 0x1p-135F}));
}

TEST(HdrImage, ReadsOldRuns) {
    // A pixel five times, another one, and that 260 = 4 + 1 * 256 times more.
    const Image image =
        decode(format + "-Y 1 +X 266\n" +
               bytes_of({128, 0, 0, 129, 1, 1, 1, 4, 128, 0, 0, 130, 1, 1, 1, 4, 1, 1, 1, 1}));
    std::vector<float> expected(266, 2.0F);
    std::fill_n(expected.begin(), 5, 1.0F);
    EXPECT_EQ(red_of(image), expected);
    // Between runs with a pixel in between, the digits begin anew.
    const Image twice = decode(format + "-Y 1 +X 6\n" +
                               bytes_of({128, 0, 0, 129, 1, 1, 1, 2, 128, 0, 0, 130, 1, 1, 1, 2}));
    EXPECT_EQ(red_of(twice), (std::vector<float>{1, 1, 1, 2, 2, 2}));
}

TEST(HdrImage, ReadsNewRuns) {
    const std::string row =
        bytes_of({2,        2,   0, 10,                             // a scan line of ten
                  128 + 10, 128,                                    // red: a run
                  10,       0,   1, 2,  3,       4, 5, 6, 7, 8, 9,  // green: a piece
                  3,        7,   7, 7,  128 + 5, 8, 2, 9, 9,        // blue: both
                  128 + 9,  129, 1, 130});                          // exponents
    const Image image = decode(format + "-Y 2 +X 10\n" + row + row);
    const auto& values = image.layers[0].values;
    for (std::size_t i = 0; i < 20; ++i) {
        const float unit = i % 10 == 9 ? 0x1p-6F : 0x1p-7F;
        EXPECT_EQ(values[i], 128.0F * unit) << i;
        EXPECT_EQ(values[20 + i], static_cast<float>(i % 10) * unit) << i;
        EXPECT_EQ(values[40 + i], (i % 10 < 3 ? 7.0F : i % 10 < 8 ? 8.0F : 9.0F) * unit) << i;
    }
}

// Rows too short or too long for new runs have none, whatever they begin with.
TEST(HdrImage, ShortRowsHaveNoNewRuns) {
    const Image image = decode(format + "-Y 1 +X 2\n" + bytes_of({2, 2, 0, 136, 2, 2, 0, 137}));
    EXPECT_EQ(red_of(image), (std::vector<float>{2.0F, 4.0F}));
}

TEST(HdrImage, EightOrientations) {
    // Six pixels in the order of the file, and where they belong in an image of 3 x 2 or 2 x 3.
    const std::string pixels = bytes_of(
        {1, 0, 0, 136, 2, 0, 0, 136, 3, 0, 0, 136, 4, 0, 0, 136, 5, 0, 0, 136, 6, 0, 0, 136});
    const std::vector<std::pair<std::string, std::vector<float>>> cases = {
        {"-Y 2 +X 3", {1, 2, 3, 4, 5, 6}}, {"-Y 2 -X 3", {3, 2, 1, 6, 5, 4}},
        {"+Y 2 +X 3", {4, 5, 6, 1, 2, 3}}, {"+Y 2 -X 3", {6, 5, 4, 3, 2, 1}},
        {"+X 3 -Y 2", {1, 3, 5, 2, 4, 6}}, {"-X 3 -Y 2", {5, 3, 1, 6, 4, 2}},
        {"+X 3 +Y 2", {2, 4, 6, 1, 3, 5}}, {"-X 3 +Y 2", {6, 4, 2, 5, 3, 1}}};
    for (const auto& [resolution, expected] : cases) {
        const Image image = decode(format + resolution + "\n" + pixels);
        EXPECT_EQ(image.width, 3u);
        EXPECT_EQ(image.height, 2u);
        EXPECT_EQ(red_of(image), expected) << resolution;
    }
}

TEST(HdrImage, ExposuresAreTakenOut) {
    const std::string pixel = "-Y 1 +X 1\n" + bytes_of({128, 128, 128, 129});
    const Image image = decode(
        "#?RGBE\nSOFTWARE=x\n# EXPOSURE=9\nEXPOSURE= 2.0\nEXPOSURE=4\r\n"
        "COLORCORR= 1 0.5 0.25\n\n" +
        pixel);
    EXPECT_EQ(image.layers[0].values, (std::vector<float>{0.125F, 0.25F, 0.5F}));
    EXPECT_TRUE(refuses("#?RGBE\nEXPOSURE=0\n\n" + pixel, "picture.hdr:2: exposure '0'"));
    EXPECT_TRUE(refuses("#?RGBE\nEXPOSURE=nan\n\n" + pixel, "expected a positive number"));
    EXPECT_TRUE(refuses("#?RGBE\nCOLORCORR=1 2\n\n" + pixel, "expected a positive number"));
    EXPECT_TRUE(refuses("#?RGBE\nEXPOSURE=1e-3\n\n-Y 1 +X 1\n" + bytes_of({255, 0, 0, 255}),
                        "too large without its exposure"));
    EXPECT_TRUE(refuses("#?RGBE\nEXPOSURE=1e30\nEXPOSURE=1e30\n\n" + pixel, "no image"));
}

TEST(HdrImage, RefusesBadHeaders) {
    EXPECT_TRUE(refuses("", "picture.hdr:1: the header of the Radiance image has no end"));
    EXPECT_TRUE(refuses("P6\n", "picture.hdr:1: is not a Radiance image"));
    EXPECT_TRUE(refuses("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234",
                        "picture.hdr:2: format '32-bit_rle_xyze', expected 32-bit_rle_rgbe"));
    EXPECT_TRUE(refuses("#?RADIANCE\n" + std::string(1 << 17, '#') + "\n\n", "has no end"));
    for (const char* resolution : {"", "-Y 1", "-Y 1 +Y 1", "-Y 1 +X", "-Y 1 +X 1 +X 1", "1 1",
                                   "-Z 1 +X 1", "+X 1 +X 1", "-Y 1 +X 1 1"})
        EXPECT_TRUE(refuses(format + resolution + "\n1234", "expected")) << resolution;
    for (const char* edge : {"0", "-1", "32769", "99999999999999999999", "1.5", "0x10"})
        EXPECT_TRUE(refuses(format + "-Y 1 +X " + edge + "\n1234", "image edge")) << edge;
}

TEST(HdrImage, RefusesSizesThatTheFileCannotHold) {
    EXPECT_TRUE(refuses(format + "-Y 32768 +X 32768\n" + bytes_of({1, 0, 0, 136}), "claims"));
    EXPECT_TRUE(refuses(format + "-Y 8000 +X 8000\n" + bytes_of({1, 0, 0, 136}), "claims"));
}

TEST(HdrImage, RefusesBadRuns) {
    const std::string ten = format + "-Y 1 +X 10\n" + bytes_of({2, 2, 0, 10});
    EXPECT_TRUE(refuses(ten + bytes_of({128 + 11, 1}), "a run leaves its scan line"));
    EXPECT_TRUE(refuses(ten + bytes_of({0, 1}), "a run leaves its scan line"));
    EXPECT_TRUE(
        refuses(ten + bytes_of({128}) + std::string(128, '\1'), "a run leaves its scan line"));
    EXPECT_TRUE(refuses(ten + bytes_of({11, 1}), "a run leaves its scan line"));
    EXPECT_TRUE(refuses(format + "-Y 1 +X 10\n" + bytes_of({2, 2, 0, 9, 1}),
                        "a scan line of another length"));
    const std::string old = format + "-Y 1 +X 10\n";
    EXPECT_TRUE(refuses(old + bytes_of({1, 1, 1, 4}), "a run leaves its scan line"));
    EXPECT_TRUE(refuses(old + bytes_of({9, 9, 9, 9, 1, 1, 1, 10}), "a run leaves its scan line"));
    // Runs without length move no further, but their digits end.
    std::string endless = old + bytes_of({9, 9, 9, 9});
    for (int i = 0; i < 5; ++i) endless += bytes_of({1, 1, 1, 0});
    EXPECT_TRUE(refuses(endless, "a run leaves its scan line"));
}

TEST(HdrImage, RefusesCutFiles) {
    const std::string row =
        bytes_of({2, 2, 0, 8, 128 + 8, 1, 128 + 8, 2, 8, 1, 2, 3, 4, 5, 6, 7, 8, 128 + 8, 128});
    const std::string whole = format + "-Y 2 +X 8\n" + row + row;
    EXPECT_EQ(refusal(whole), "");
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(refusal(whole.substr(0, length)), "") << length;
}

// Any byte may change: the image is read or refused, and never too large.
TEST(HdrImage, SurvivesChangedBytes) {
    const std::string row =
        bytes_of({2, 2, 0, 8, 128 + 8, 1, 128 + 8, 2, 8, 1, 2, 3, 4, 5, 6, 7, 8, 128 + 8, 128});
    const std::string whole = format + "-Y 2 +X 8\n" + row + row;
    int read = 0;
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const int mask : {1, 2, 0x10, 0x80, 0xFF}) {
            std::string changed = whole;
            changed[i] = static_cast<char>(changed[i] ^ mask);
            read += refusal(changed).empty() ? 1 : 0;
        }
    EXPECT_GT(read, 20);
}

TEST(HdrImage, ReadsFiles) {
    const TemporaryFolder folder;
    const std::string text = format + "-Y 1 +X 1\n" + bytes_of({1, 2, 3, 136});
    const std::filesystem::path path = folder.write("a.hdr", text);
    EXPECT_EQ(read_hdr(path).layers[0].values, (std::vector<float>{1, 2, 3}));
    EXPECT_THROW(static_cast<void>(read_hdr(folder.path() / "missing.hdr")), Error);
    EXPECT_THROW(static_cast<void>(read_hdr(folder.path())), Error);
}

// A photograph whose mean logarithmic luminance is known.
TEST(HdrImage, ReadsAPublishedImage) {
    const char* shared = std::getenv("WEFT_SHARED");
    const std::filesystem::path path =
        (shared != nullptr ? std::filesystem::path(shared)
                           : std::filesystem::path(WEFT_SOURCE_DIR) / "../shared") /
        "data/metrics/hdrvdp-pair/test/memorial_mask.hdr";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "there is no " << path;
    const Image image = read_hdr(path);
    ASSERT_EQ(image.width, 512u);
    ASSERT_EQ(image.height, 768u);
    const std::size_t pixels = std::size_t{512} * 768;
    const auto& values = image.layers[0].values;
    double smallest = 1e30;
    std::vector<double> luminances;
    for (std::size_t i = 0; i < pixels; ++i) {
        luminances.push_back(0.212656 * double{values[i]} + 0.715158 * double{values[pixels + i]} +
                             0.072186 * double{values[2 * pixels + i]});
        if (luminances.back() > 0.0) smallest = std::min(smallest, luminances.back());
    }
    double sum = 0.0;
    for (const double y : luminances) sum += std::log(std::max(y, smallest));
    EXPECT_NEAR(std::exp(sum / static_cast<double>(pixels)), 8.60722, 1e-4);
}

}  // namespace
}  // namespace weft::hdr_image_test
