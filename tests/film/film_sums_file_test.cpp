// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/film_sums_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "image/exr.h"
#include "shared/shared_types.h"
#include "tests/testing/temporary_folder.h"

// The sums of path tracing in files: every bit comes back, and what is damaged is refused.
namespace weft::film_sums_file_test {
namespace {

constexpr std::uint32_t width = 7;
constexpr std::uint32_t height = 3;

/// Sums of any bits, among them those of every kind of NaN.
FilmSums some_sums() {
    FilmSums sums;
    sums.width = width;
    sums.height = height;
    sums.identity = "0123456789abcdef";
    sums.backends = {"native", "opencl"};
    sums.light_exponent = -7;
    sums.depth_unit = 0x1p-12;
    sums.ranges = {{0, 64}, {128, 0xFFFFFFFFU}};
    std::mt19937 random(1);
    sums.words.resize(FILM_PIXEL_WORDS * std::size_t{width} * height);
    for (std::uint32_t& word : sums.words) word = static_cast<std::uint32_t>(random());
    const std::uint32_t special[] = {0,          0x7F800001, 0xFFFFFFFF, 0x7FC00000,
                                     0x80000000, 0x00000001, 0xFF800000, 0x7FBFFFFF};
    std::copy(std::begin(special), std::end(special), sums.words.begin());
    return sums;
}

/// An image with sums attached.
Image some_image() {
    Image image;
    image.width = width;
    image.height = height;
    image.layers.push_back({"", "RGB", std::vector<float>(3 * std::size_t{width} * height, 0.5F)});
    image.metadata["software"] = "a test";
    attach_sums(some_sums(), image);
    return image;
}

void expect_same(const FilmSums& a, const FilmSums& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.identity, b.identity);
    EXPECT_EQ(a.backends, b.backends);
    EXPECT_EQ(a.light_exponent, b.light_exponent);
    EXPECT_EQ(a.depth_unit, b.depth_unit);
    EXPECT_EQ(a.ranges, b.ranges);
    EXPECT_EQ(a.words, b.words);
}

/// That the sums are refused as bad input, in one line that names the file and holds `what`.
void expect_refused(const Image& image, const std::string& what = "") {
    try {
        (void)sums_of(image, "the-file.exr");
        FAIL() << "was not refused, expected: " << what;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        const std::string text = error.what();
        EXPECT_NE(text.find(what), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
}

TEST(FilmSumsFile, RangesHaveAText) {
    EXPECT_EQ(ranges_text({}), "");
    EXPECT_EQ(ranges_text({{0, 64}}), "0:64");
    EXPECT_EQ(ranges_text({{0, 64}, {128, 4294967295U}}), "0:64,128:4294967295");
}

TEST(FilmSumsFile, AllBitsComeBack) {
    expect_same(sums_of(some_image(), "x"), some_sums());
}

TEST(FilmSumsFile, AllBitsComeBackFromAFile) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "x.exr";
    for (int times = 0; times < 2; ++times) {
        write_exr(path, some_image());
        const Image image = read_exr(path);
        expect_same(sums_of(image, path.string()), some_sums());
        EXPECT_EQ(image.metadata.at("software"), "a test");
        ASSERT_NE(image.find(""), nullptr);
        EXPECT_EQ(image.find("")->values, some_image().layers.front().values);
    }
}

TEST(FilmSumsFile, BackendsMayBeUnknownButNotDamaged) {
    EXPECT_EQ(backends_text({"opencl", "embree"}), "embree,opencl");
    Image image = some_image();
    EXPECT_EQ(image.metadata.at("weft.backends"), "native,opencl");
    for (const char* text : {"", ",", "native,", ",native", "native,,opencl", "native,native",
                             "native opencl", "native\n"}) {
        image.metadata["weft.backends"] = text;
        expect_refused(image, "weft.backends");
    }
    image.metadata.erase("weft.backends");
    EXPECT_TRUE(sums_of(image, "x").backends.empty());
}

TEST(FilmSumsFile, NoSamplesYetComeBack) {
    FilmSums sums = some_sums();
    sums.ranges.clear();
    Image image;
    image.width = width;
    image.height = height;
    attach_sums(sums, image);
    expect_same(sums_of(image, "x"), sums);
}

TEST(FilmSumsFile, ImagesWithoutSumsAreRefused) {
    Image image = some_image();
    image.metadata.clear();
    expect_refused(image, "the-file.exr: holds no sums");
    for (const char* key :
         {"weft.picture", "weft.samples", "weft.light_exponent", "weft.depth_exponent"}) {
        image = some_image();
        ASSERT_EQ(image.metadata.erase(key), 1U) << key;
        expect_refused(image, "the-file.exr: holds no sums");
    }
}

TEST(FilmSumsFile, DamagedRangesAreRefused) {
    for (const char* text : {"64",
                             "64:",
                             ":64",
                             "0:64,",
                             ",0:64",
                             "0:64 ",
                             " 0:64",
                             "0-64",
                             "0:64;1",
                             "64:0",
                             "5:5",
                             "-1:5",
                             "0:-5",
                             "+0:5",
                             "0x0:5",
                             "0:4294967296",
                             "99999999999999999999:5",
                             "0:64,,64:65",
                             "a:b",
                             "0:1:2"}) {
        Image image = some_image();
        image.metadata["weft.samples"] = text;
        SCOPED_TRACE(text);
        expect_refused(image, "the-file.exr: has damaged metadata weft.samples");
    }
    // Well-formed, but samples that would count twice.
    for (const char* text : {"0:64,63:65", "0:64,0:64", "10:20,0:100"}) {
        Image image = some_image();
        image.metadata["weft.samples"] = text;
        expect_refused(image, "twice");
    }
}

TEST(FilmSumsFile, RangesOutOfOrderAreSorted) {
    Image image = some_image();
    image.metadata["weft.samples"] = "64:128,0:64,200:201";
    EXPECT_EQ(sums_of(image, "x").ranges, (std::vector<SampleRange>{{0, 128}, {200, 201}}));
}

TEST(FilmSumsFile, DamagedExponentsAreRefused) {
    for (const char* key : {"weft.light_exponent", "weft.depth_exponent"})
        for (const char* text : {"", "a", "1a", "1.0", " 1", "--1", "+1", "1001", "-1001",
                                 "2147483647", "-2147483648", "2147483648", "9999999999999"}) {
            Image image = some_image();
            image.metadata[key] = text;
            SCOPED_TRACE(std::string(key) + " " + text);
            expect_refused(image, std::string("the-file.exr: has damaged metadata ") + key);
        }
}

TEST(FilmSumsFile, MissingOrDamagedLayersAreRefused) {
    const auto damaged = [](const std::function<void(Image&, Layer&)>& damage) {
        for (const std::size_t plane : {std::size_t{0}, std::size_t{FILM_PIXEL_WORDS} - 1}) {
            Image image = some_image();
            damage(image, image.layers.at(1 + plane));
            expect_refused(image, "the-file.exr: lacks a part of its sums");
        }
    };
    damaged([](Image& image, Layer& layer) {
        const auto at = &layer - image.layers.data();
        image.layers.erase(image.layers.begin() + at);
    });
    damaged([](Image&, Layer& layer) { layer.name += "x"; });
    damaged([](Image&, Layer& layer) { layer.words = false; });
    damaged([](Image&, Layer& layer) { layer.values.pop_back(); });
    damaged([](Image&, Layer& layer) { layer.values.insert(layer.values.end(), 21, 0.0F); });
}

TEST(FilmSumsFile, TruncatedFilesAreRefused) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "x.exr";
    write_exr(path, some_image());
    const auto size = std::filesystem::file_size(path);
    for (int part = 0; part < 10; ++part) {
        std::filesystem::resize_file(path, size * static_cast<unsigned>(9 - part) / 10);
        try {
            (void)sums_of(read_exr(path), path.string());
            FAIL() << part << " tenths are missing";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
        }
    }
}

}  // namespace
}  // namespace weft::film_sums_file_test
