// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/load_image.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/png.h"
#include "image/read_png.h"
#include "tests/testing/temporary_folder.h"

namespace weft::load_image_test {
namespace {

namespace fs = std::filesystem;

double linear(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

std::string png_of(int type, int depth, bool interlaced, std::uint32_t width, std::uint32_t height,
                   const std::vector<png_byte>& rows, bool key = false) {
    std::string text;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &text,
        [](png_structp self, png_bytep bytes, std::size_t size) {
            static_cast<std::string*>(png_get_io_ptr(self))
                ->append(reinterpret_cast<const char*>(bytes), size);
        },
        [](png_structp) {});
    png_set_IHDR(png, info, width, height, depth, type,
                 interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const std::vector<png_color> palette = {{0, 0, 0}, {255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
    if (type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 4);
    const png_byte transparent = 0;
    if (key) png_set_tRNS(png, info, &transparent, 1, nullptr);
    png_write_info(png, info);
    const std::size_t stride = rows.size() / height;
    std::vector<png_bytep> pointers;
    for (std::size_t y = 0; y < height; ++y)
        pointers.push_back(const_cast<png_bytep>(rows.data()) + y * stride);
    png_write_image(png, pointers.data());
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return text;
}

std::vector<float> values_of(const std::string& png) {
    const Image image = decode_png(std::as_bytes(std::span(png)), "picture.png");
    EXPECT_EQ(image.layers.at(0).channels, "RGB");
    return image.layers.at(0).values;
}

void expect_codes(const std::vector<float>& values, const std::vector<double>& codes) {
    ASSERT_EQ(values.size(), codes.size());
    for (std::size_t i = 0; i < codes.size(); ++i)
        EXPECT_NEAR(values[i], linear(codes[i]), 1e-7) << i;
}

std::string refusal(const std::string& png) {
    try {
        static_cast<void>(decode_png(std::as_bytes(std::span(png)), "picture.png"));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return {};
}

TEST(LoadImagePng, EightAndSixteenBits) {
    expect_codes(values_of(png_of(PNG_COLOR_TYPE_RGB, 8, false, 2, 1, {0, 10, 255, 128, 51, 1})),
                 {0, 128 / 255.0, 10 / 255.0, 51 / 255.0, 1, 1 / 255.0});
    expect_codes(values_of(png_of(PNG_COLOR_TYPE_RGB, 16, false, 1, 1, {1, 2, 128, 0, 255, 255})),
                 {258 / 65535.0, 32768 / 65535.0, 1});
    expect_codes(values_of(png_of(PNG_COLOR_TYPE_GRAY, 16, false, 1, 1, {1, 2})),
                 {258 / 65535.0, 258 / 65535.0, 258 / 65535.0});
}

TEST(LoadImagePng, GreyPaletteAndTransparency) {
    expect_codes(values_of(png_of(PNG_COLOR_TYPE_GRAY, 1, false, 3, 1, {0xA0})),
                 {1, 0, 1, 1, 0, 1, 1, 0, 1});
    expect_codes(values_of(png_of(PNG_COLOR_TYPE_GRAY, 4, false, 1, 1, {0x50})),
                 {1 / 3.0, 1 / 3.0, 1 / 3.0});
    for (const bool key : {false, true})
        expect_codes(values_of(png_of(PNG_COLOR_TYPE_PALETTE, 2, false, 4, 1, {0x1B}, key)),
                     {0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    expect_codes(values_of(png_of(PNG_COLOR_TYPE_RGB_ALPHA, 8, false, 1, 1, {255, 0, 51, 7})),
                 {1, 0, 0.2});
    expect_codes(values_of(png_of(PNG_COLOR_TYPE_GRAY_ALPHA, 8, false, 1, 1, {51, 0})),
                 {0.2, 0.2, 0.2});
}

TEST(LoadImagePng, Interlaced) {
    std::vector<png_byte> rows(std::size_t{9} * 7 * 3);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<png_byte>(i);
    EXPECT_EQ(values_of(png_of(PNG_COLOR_TYPE_RGB, 8, true, 9, 7, rows)),
              values_of(png_of(PNG_COLOR_TYPE_RGB, 8, false, 9, 7, rows)));
}

TEST(LoadImagePng, RefusesDamage) {
    std::vector<png_byte> rows(std::size_t{16} * 16 * 3);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<png_byte>(i * i);
    const std::string png = png_of(PNG_COLOR_TYPE_RGB, 8, false, 16, 16, rows);
    ASSERT_EQ(refusal(png), "");
    for (std::size_t length = 0; length < png.size(); ++length)
        EXPECT_NE(refusal(png.substr(0, length)), "") << length;
    for (std::size_t i = 0; i < png.size(); ++i) {
        std::string changed = png;
        changed[i] = static_cast<char>(changed[i] ^ 4);
        EXPECT_NE(refusal(changed), "") << "a checksum covers byte " << i;
    }
}

TEST(LoadImagePng, RefusesSizesThatTheFileCannotHold) {
    const std::string whole = png_of(PNG_COLOR_TYPE_GRAY, 1, false, 3000, 800,
                                     std::vector<png_byte>(std::size_t{375} * 800));
    EXPECT_EQ(refusal(whole), "") << "an honest image of zeros";
    EXPECT_NE(refusal(whole.substr(0, 100)).find("claims 3000 x 800 pixels"), std::string::npos);
}

TEST(LoadImage, TellsFormatsByTheirContent) {
    const TemporaryFolder folder;
    Image image;
    image.width = 2;
    image.height = 1;
    image.layers = {{"", "RGB", {0, 1, 0, 1, 0, 1}}};
    image.metadata["weft:display-referred"] = "sRGB";
    write_exr(folder.path() / "really.png", image);
    write_png(folder.path() / "really.hdr", image, 0.0);
    folder.write("really.exr", "#?RADIANCE\n\n-Y 1 +X 2\n\x80\x80\x80\x81\x80\x80\x80\x81");
    const Image exr = load_image(folder.path() / "really.png");
    EXPECT_EQ(exr.layers[0].values, image.layers[0].values);
    EXPECT_FALSE(is_display_referred(exr)) << "whatever it says of itself";
    const Image png = load_image(folder.path() / "really.hdr");
    EXPECT_EQ(png.layers[0].values, image.layers[0].values);
    EXPECT_TRUE(is_display_referred(png));
    const Image hdr = load_image(folder.path() / "really.exr");
    EXPECT_EQ(hdr.layers[0].values, std::vector<float>(6, 1.0F));
    EXPECT_FALSE(is_display_referred(hdr));
}

TEST(LoadImage, RefusesAnythingElse) {
    const TemporaryFolder folder;
    for (const std::string_view text : {"", "#", "P6 1 1 255\n123", "\x89PNG", "<scene/>"}) {
        try {
            static_cast<void>(load_image(folder.write("a.png", text)));
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_NE(std::string(error.what()).find("is not an image"), std::string::npos);
        }
    }
    EXPECT_THROW(static_cast<void>(load_image(folder.path() / "missing.png")), Error);
    EXPECT_THROW(static_cast<void>(load_image(folder.path())), Error);
}

}  // namespace
}  // namespace weft::load_image_test
