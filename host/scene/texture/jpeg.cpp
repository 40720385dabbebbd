// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/texture/jpeg.h"

#include <csetjmp>
#include <cstdio>  // jpeglib.h needs FILE
#include <vector>

#include "base/error.h"
#include "base/quote.h"

#include <jerror.h>
#include <jpeglib.h>

namespace weft {
namespace {

constexpr int max_scans = 64;

/// libjpeg's decoder with error handling that returns to the caller. No object with a destructor
/// may live between a setjmp here and the calls it guards.
class Decoder {
  public:
    explicit Decoder(std::span<const std::byte> bytes) {
        info_.err = jpeg_std_error(&errors_);
        errors_.error_exit = fail;
        errors_.emit_message = note;
        progress_.progress_monitor = count_scans;
        info_.client_data = this;
        if (setjmp(escape_) != 0) return;
        jpeg_create_decompress(&info_);
        info_.progress = &progress_;
        jpeg_mem_src(&info_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    }
    ~Decoder() { jpeg_destroy_decompress(&info_); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;

    /// Reads up to the first scan; false where that fails.
    bool read_header() {
        if (message_[0] != '\0' || setjmp(escape_) != 0) return false;
        jpeg_read_header(&info_, TRUE);
        const bool inks = info_.jpeg_color_space == JCS_CMYK || info_.jpeg_color_space == JCS_YCCK;
        info_.out_color_space = inks ? JCS_CMYK : JCS_RGB;
        return true;
    }

    /// Decodes row by row into `row` (4 bytes a pixel are enough), calling `take` after each.
    bool read_rows(unsigned char* row, void (*take)(void*, const unsigned char*), void* taker) {
        if (setjmp(escape_) != 0) return false;
        jpeg_start_decompress(&info_);
        while (info_.output_scanline < info_.output_height) {
            JSAMPROW rows[] = {row};
            jpeg_read_scanlines(&info_, rows, 1);
            if (info_.out_color_space == JCS_CMYK) inks_to_light(row);
            take(taker, row);
        }
        jpeg_finish_decompress(&info_);
        return true;
    }

    [[nodiscard]] std::uint32_t width() const { return info_.image_width; }
    [[nodiscard]] std::uint32_t height() const { return info_.image_height; }
    [[nodiscard]] const char* message() const { return message_; }

  private:
    /// Converts four inks a pixel to red, green and blue, in place. Adobe's files store ink
    /// inverted: 255 is none.
    void inks_to_light(unsigned char* row) const {
        for (std::uint32_t x = 0; x < info_.output_width; ++x)
            for (std::uint32_t c = 0; c < 3; ++c) {
                const unsigned flip = info_.saw_Adobe_marker != 0 ? 0 : 255;
                const unsigned ink = row[4 * x + c] ^ flip;
                const unsigned black = row[4 * x + 3] ^ flip;
                row[3 * x + c] = static_cast<unsigned char>((ink * black + 127) / 255);
            }
    }

    static Decoder& self(j_common_ptr info) { return *static_cast<Decoder*>(info->client_data); }

    [[noreturn]] static void fail(j_common_ptr info) {
        info->err->format_message(info, self(info).message_);
        std::longjmp(self(info).escape_, 1);
    }

    /// Takes a warning of libjpeg: an image that ends too early is an error, others are ignored.
    static void note(j_common_ptr info, int level) {
        if (level < 0 && info->err->msg_code == JWRN_JPEG_EOF) fail(info);
    }

    static void count_scans(j_common_ptr info) {
        const auto* decoder = reinterpret_cast<j_decompress_ptr>(info);
        if (decoder->input_scan_number <= max_scans) return;
        std::snprintf(self(info).message_, JMSG_LENGTH_MAX, "more than %d scans", max_scans);
        std::longjmp(self(info).escape_, 1);
    }

    jpeg_decompress_struct info_{};
    jpeg_error_mgr errors_{};
    jpeg_progress_mgr progress_{};
    std::jmp_buf escape_{};
    char message_[JMSG_LENGTH_MAX] = {};
};

[[noreturn]] void throw_damaged(const std::string& place, const char* message) {
    throw input_error(
        place, "image is damaged (" + quote(message) + "), expected a PNG, JPEG, BMP or TGA image");
}

}  // namespace

bool is_jpeg(std::span<const std::byte> bytes) {
    return bytes.size() >= 2 && bytes[0] == std::byte{0xFF} && bytes[1] == std::byte{0xD8};
}

Texture decode_jpeg(std::span<const std::byte> bytes, const std::string& place,
                    void (*check_size)(std::uint32_t, std::uint32_t, const std::string&)) {
    Decoder decoder(bytes);
    if (!decoder.read_header()) throw_damaged(place, decoder.message());
    check_size(decoder.width(), decoder.height(), place);
    Texture texture;
    texture.name = place;
    texture.width = decoder.width();
    texture.height = decoder.height();
    texture.rgba.reserve(std::size_t{4} * texture.width * texture.height);
    std::vector<unsigned char> row(std::size_t{4} * texture.width);
    const auto take = [](void* taker, const unsigned char* rgb) {
        auto& out = *static_cast<Texture*>(taker);
        for (std::uint32_t x = 0; x < out.width; ++x) {
            out.rgba.insert(out.rgba.end(), rgb + std::size_t{3} * x, rgb + std::size_t{3} * x + 3);
            out.rgba.push_back(255);
        }
    };
    if (!decoder.read_rows(row.data(), take, &texture)) throw_damaged(place, decoder.message());
    return texture;
}

}  // namespace weft
