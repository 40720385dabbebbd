// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/read_png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <new>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "base/srgb.h"

namespace weft {
namespace {

// Most decoded bytes that a byte of the file can encode: deflate's bound is 1032.
constexpr std::size_t max_inflation = 1100;

/// libpng's state. Its errors leave by longjmp, past which no destructor runs: all that the decoder
/// allocates belongs to this object, outside of the jumps.
class PngDecoder {
  public:
    explicit PngDecoder(std::span<const std::byte> bytes) : bytes_(bytes) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
    }
    ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngDecoder(const PngDecoder&) = delete;
    PngDecoder& operator=(const PngDecoder&) = delete;

    Image decode(const std::string& place) {
        if (!read_header()) throw damaged(place);
        const std::size_t pixels = std::size_t{width_} * height_;
        // A pixel may be a single bit.
        if (pixels > limits::max_film_pixels || pixels / 8 / max_inflation > bytes_.size())
            throw input_error(place, "claims " + std::to_string(width_) + " x " +
                                         std::to_string(height_) +
                                         " pixels, more than the file can hold or the limit of " +
                                         std::to_string(limits::max_film_pixels));
        data_.resize(row_bytes_ * height_);
        for (std::size_t y = 0; y < height_; ++y) rows_.push_back(data_.data() + y * row_bytes_);
        if (!read_rows()) throw damaged(place);
        return to_image();
    }

  private:
    [[nodiscard]] Error damaged(const std::string& place) const {
        return input_error(place, "is damaged: " + quote(message_.data()));
    }

    bool read_header() {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        constexpr png_alloc_size_t max_chunk = std::size_t{8} << 20;
        png_set_read_fn(png_, this, on_read);
        png_set_user_limits(png_, limits::max_film_edge, limits::max_film_edge);
        png_set_chunk_malloc_max(png_, max_chunk);
        png_set_chunk_cache_max(png_, 100);
        // A wrong checksum is damage even in chunks that are not used.
        png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
        png_read_info(png_, info_);
        png_set_expand(png_);
        png_set_strip_alpha(png_);
        png_set_gray_to_rgb(png_);
        static_cast<void>(png_set_interlace_handling(png_));
        png_read_update_info(png_, info_);
        width_ = png_get_image_width(png_, info_);
        height_ = png_get_image_height(png_, info_);
        sample_bytes_ = png_get_bit_depth(png_, info_) == 16 ? 2 : 1;
        row_bytes_ = png_get_rowbytes(png_, info_);
        if (row_bytes_ != std::size_t{3} * sample_bytes_ * width_)
            png_error(png_, "a row of an unexpected length");
        return true;
    }

    bool read_rows() {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_image(png_, rows_.data());
        png_read_end(png_, nullptr);
        return true;
    }

    [[nodiscard]] Image to_image() const {
        const std::size_t codes = sample_bytes_ == 2 ? 65536 : 256;
        std::vector<float> linear(codes);
        for (std::size_t i = 0; i < codes; ++i)
            linear[i] = static_cast<float>(
                linear_from_srgb(static_cast<double>(i) / static_cast<double>(codes - 1)));
        const std::size_t pixels = std::size_t{width_} * height_;
        Image image;
        image.width = width_;
        image.height = height_;
        image.layers = {{"", "RGB", std::vector<float>(3 * pixels)}};
        for (std::size_t i = 0; i < 3 * pixels; ++i) {
            const png_byte* sample = data_.data() + i * sample_bytes_;
            const std::size_t code =
                sample_bytes_ == 2 ? sample[0] * std::size_t{256} + sample[1] : sample[0];
            image.layers[0].values[i % 3 * pixels + i / 3] = linear[code];
        }
        return image;
    }

    [[noreturn]] static void on_error(png_structp png, png_const_charp text) {
        auto* self = static_cast<PngDecoder*>(png_get_error_ptr(png));
        const std::string_view reason = text;
        reason.copy(self->message_.data(), self->message_.size() - 1);
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void on_read(png_structp png, png_bytep target, std::size_t size) {
        auto* self = static_cast<PngDecoder*>(png_get_io_ptr(png));
        if (size > self->bytes_.size() - self->position_) png_error(png, "the file is cut off");
        std::memcpy(target, self->bytes_.data() + self->position_, size);
        self->position_ += size;
    }

    std::span<const std::byte> bytes_;
    std::size_t position_ = 0;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::size_t sample_bytes_ = 1;
    std::size_t row_bytes_ = 0;
    std::vector<png_byte> data_;
    std::vector<png_bytep> rows_;
    std::array<char, 80> message_{};
};

}  // namespace

Image decode_png(std::span<const std::byte> bytes, const std::string& place) {
    return PngDecoder(bytes).decode(place);
}

}  // namespace weft
