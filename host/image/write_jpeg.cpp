// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/write_jpeg.h"

#include <csetjmp>
#include <cstdio>  // jpeglib.h needs FILE
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <jpeglib.h>

namespace weft {
namespace {

/// libjpeg's encoder with error handling that returns to the caller. No object with a destructor
/// may live between a setjmp here and the calls it guards.
class Encoder {
  public:
    Encoder() {
        info_.err = jpeg_std_error(&errors_);
        errors_.error_exit = fail;
        errors_.output_message = [](j_common_ptr) {};
        info_.client_data = this;
        if (setjmp(escape_) == 0) jpeg_create_compress(&info_);
    }
    ~Encoder() {
        jpeg_destroy_compress(&info_);
        std::free(bytes_);
    }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    /// Returns false where libjpeg refuses.
    bool encode(const std::uint32_t* colours, std::uint32_t width, std::uint32_t height,
                const JpegSettings& settings, unsigned char* row) {
        if (message_[0] != '\0' || setjmp(escape_) != 0) return false;
        jpeg_mem_dest(&info_, &bytes_, &size_);
        info_.image_width = width;
        info_.image_height = height;
        info_.input_components = 3;
        info_.in_color_space = JCS_RGB;
        jpeg_set_defaults(&info_);
        jpeg_set_quality(&info_, settings.quality, TRUE);
        const int share = settings.halves_colour ? 2 : 1;
        info_.comp_info[0].h_samp_factor = share;
        info_.comp_info[0].v_samp_factor = share;
        jpeg_start_compress(&info_, TRUE);
        while (info_.next_scanline < height) {
            const std::uint32_t* const from =
                colours + static_cast<std::size_t>(info_.next_scanline) * width;
            for (std::uint32_t x = 0; x < width; ++x)
                for (std::uint32_t c = 0; c < 3; ++c)
                    row[3 * x + c] = static_cast<unsigned char>(from[x] >> (8 * c) & 0xFFU);
            JSAMPROW rows[] = {row};
            jpeg_write_scanlines(&info_, rows, 1);
        }
        jpeg_finish_compress(&info_);
        return true;
    }

    [[nodiscard]] std::span<const std::byte> bytes() const {
        return std::as_bytes(std::span(bytes_, size_));
    }
    [[nodiscard]] const char* message() const { return message_; }

  private:
    [[noreturn]] static void fail(j_common_ptr info) {
        auto& self = *static_cast<Encoder*>(info->client_data);
        info->err->format_message(info, self.message_);
        std::longjmp(self.escape_, 1);
    }

    jpeg_compress_struct info_{};
    jpeg_error_mgr errors_{};
    std::jmp_buf escape_{};
    char message_[JMSG_LENGTH_MAX] = {};
    unsigned char* bytes_ = nullptr;
    unsigned long size_ = 0;
};

}  // namespace

std::vector<std::byte> jpeg_bytes(std::span<const std::uint32_t> colours, std::uint32_t width,
                                  std::uint32_t height, const JpegSettings& settings) {
    if (width == 0 || height == 0 || colours.size() < std::size_t{width} * height)
        throw std::runtime_error("the image has too few pixels");
    std::vector<unsigned char> row(std::size_t{3} * width);
    Encoder encoder;
    if (!encoder.encode(colours.data(), width, height, settings, row.data()))
        throw std::runtime_error(encoder.message());
    return {encoder.bytes().begin(), encoder.bytes().end()};
}

}  // namespace weft
