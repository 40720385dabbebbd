// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/texture/image_file.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/testing/temporary_folder.h"

namespace weft::image_file_test {
namespace {

/// 2 x 2 pixels: red, green above blue, white at half opacity.
constexpr std::array<unsigned char, 76> small_png = {
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44, 0x52,
    0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x06, 0x00, 0x00, 0x00, 0x72, 0xB6, 0x0D,
    0x24, 0x00, 0x00, 0x00, 0x13, 0x49, 0x44, 0x41, 0x54, 0x78, 0xDA, 0x63, 0xF8, 0xCF, 0xC0, 0xF0,
    0x1F, 0x0C, 0x81, 0x34, 0x08, 0x34, 0x00, 0x00, 0x49, 0x49, 0x09, 0x78, 0x9C, 0x51, 0x17, 0x92,
    0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

/// 2 x 1 pixels of 16 bits a channel: (0x80FF, 0, 0), (0, 0xFFFF, 0).
constexpr std::array<unsigned char, 73> deep_png = {
    0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44,
    0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x10, 0x02, 0x00, 0x00, 0x00, 0x2B,
    0xD0, 0x34, 0x9E, 0x00, 0x00, 0x00, 0x10, 0x49, 0x44, 0x41, 0x54, 0x78, 0xDA, 0x63, 0x68,
    0xF8, 0xCF, 0x00, 0x06, 0xFF, 0x81, 0x34, 0x00, 0x17, 0xFB, 0x03, 0x7E, 0xD9, 0xDD, 0xAB,
    0x48, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};

std::vector<std::byte> bytes_of(std::span<const unsigned char> values) {
    const auto bytes = std::as_bytes(values);
    return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> bytes_of(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    return {bytes.begin(), bytes.end()};
}

/// Uncompressed 24 bit TGA, bottom row first, of the stated size.
std::string tga(unsigned width, unsigned height, const std::string& bgr) {
    std::string file(18, '\0');
    file[2] = 2;
    file[12] = static_cast<char>(width & 0xFFU);
    file[13] = static_cast<char>(width >> 8);
    file[14] = static_cast<char>(height & 0xFFU);
    file[15] = static_cast<char>(height >> 8);
    file[16] = 24;
    return file + bgr;
}

std::string message_of(const std::vector<std::byte>& bytes) {
    try {
        (void)decode_image(bytes, "scene.gltf#/images/0");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

TEST(ImageFile, DecodesPngTopRowFirst) {
    const Texture texture = decode_image(bytes_of(small_png), "p");
    EXPECT_EQ(texture.width, 2U);
    EXPECT_EQ(texture.height, 2U);
    const std::vector<std::uint8_t> expected = {255, 0, 0,   255, 0,   255, 0,   255,
                                                0,   0, 255, 255, 255, 255, 255, 128};
    EXPECT_EQ(texture.rgba, expected);
}

TEST(ImageFile, ReducesSixteenBitsToEight) {
    const Texture texture = decode_image(bytes_of(deep_png), "p");
    const std::vector<std::uint8_t> expected = {0x80, 0, 0, 255, 0, 255, 0, 255};
    EXPECT_EQ(texture.rgba, expected);
}

TEST(ImageFile, DecodesTgaWithTheRowsTurnedRound) {
    const Texture texture = decode_image(bytes_of(tga(1, 2, "\x01\x02\x03\x04\x05\x06")), "p");
    const std::vector<std::uint8_t> expected = {6, 5, 4, 255, 3, 2, 1, 255};
    EXPECT_EQ(texture.rgba, expected);
}

TEST(ImageFile, ReadsFilesAndNamesThem) {
    const TemporaryFolder folder;
    const auto path = folder.write(
        "wood.png",
        std::string_view(reinterpret_cast<const char*>(small_png.data()), small_png.size()));
    EXPECT_EQ(read_image(path, "scene.xml:3").name, "wood.png");
    EXPECT_THROW((void)read_image(folder.path() / "none.png", "scene.xml:3"), Error);
}

TEST(ImageFile, RefusesWhatIsNoImage) {
    const std::string expected = "scene.gltf#/images/0: image cannot be decoded, ";
    EXPECT_EQ(message_of({}).rfind(expected, 0), 0U);
    EXPECT_EQ(message_of(bytes_of(std::string("hello"))).rfind(expected, 0), 0U);
    // Formats whose decoders are left out.
    EXPECT_EQ(message_of(bytes_of(std::string("GIF89a\1\0\1\0\0\0\0", 13))).rfind(expected, 0), 0U);
    EXPECT_EQ(
        message_of(bytes_of(std::string("#?RADIANCE\n\n-Y 1 +X 1\n\0\0\0\0"))).rfind(expected, 0),
        0U);
}

TEST(ImageFile, RefusesEveryTruncatedPng) {
    for (std::size_t length = 0; length < 60; ++length) {
        const std::span<const unsigned char> part(small_png.data(), length);
        EXPECT_NE(message_of(bytes_of(part)), "no error") << length;
    }
}

TEST(ImageFile, RefusesHugeEdgesBeforeDecoding) {
    EXPECT_EQ(message_of(bytes_of(tga(16385, 1, ""))),
              "scene.gltf#/images/0: image of 16385 x 1 pixels, expected at most 16384 along "
              "each edge");
    std::vector<std::byte> png = bytes_of(small_png);
    png[16] = std::byte{0x7F};  // highest byte of the width
    EXPECT_NE(message_of(png), "no error");
}

TEST(ImageFile, RefusesJpegsWithEndlessScans) {
    // A start of a progressive JPEG of 8 x 8 pixels, followed by more scans than any encoder makes.
    std::string jpeg("\xFF\xD8\xFF\xC2\x00\x0B\x08\x00\x08\x00\x08\x01\x01\x11\x00", 15);
    for (int i = 0; i < 100; ++i)
        jpeg += std::string("\xFF\xDA\x00\x08\x01\x01\x00\x00\x00\x00", 10);
    EXPECT_TRUE(message_of(bytes_of(jpeg)).starts_with("scene.gltf#/images/0: image is damaged"))
        << message_of(bytes_of(jpeg));
}

TEST(ImageFile, AcceptsAnEmptyChunkOfData) {
    std::vector<std::byte> png = bytes_of(small_png);
    // Length 0, type IDAT, checksum; between the header and the real data.
    const std::string empty("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12);
    const std::vector<std::byte> chunk = bytes_of(empty);
    png.insert(png.begin() + 33, chunk.begin(), chunk.end());
    EXPECT_EQ(decode_image(png, "p").rgba.size(), 16U);
}

TEST(ImageFile, SurvivesEveryFlippedByte) {
    for (std::size_t i = 0; i < small_png.size(); ++i) {
        for (const unsigned flip : {0x01U, 0x80U, 0xFFU}) {
            std::vector<std::byte> png = bytes_of(small_png);
            png[i] ^= static_cast<std::byte>(flip);
            try {
                const Texture texture = decode_image(png, "p");
                EXPECT_EQ(texture.rgba.size(), std::size_t{4} * texture.width * texture.height);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::bad_input);
            }
        }
    }
}

}  // namespace
}  // namespace weft::image_file_test
