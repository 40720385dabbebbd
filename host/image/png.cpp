// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/srgb.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// The three planes of the beauty layer; all the same one where it is grey.
struct ColourPlanes {
    std::array<std::span<const float>, 3> plane;
    std::size_t pixels = 0;
    std::span<const float> alpha{};  ///< empty where there is none
};

/// Empty where the image holds no beauty layer of the right size.
ColourPlanes find_colour(const Image& image) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    const Layer* beauty = image.find("");
    if (beauty == nullptr || pixels == 0 || pixels > limits::max_film_pixels ||
        beauty->values.size() != pixels * beauty->channels.size())
        return {};
    const std::span<const float> values = beauty->values;
    if (beauty->channels == "Y") return {{values, values, values}, pixels, alpha_of(image)};
    if (!beauty->channels.starts_with("RGB")) return {};
    return {
        {values.first(pixels), values.subspan(pixels, pixels), values.subspan(2 * pixels, pixels)},
        pixels,
        alpha_of(image)};
}

/// Threshold in (0, 1) of the 8x8 Bayer matrix, whose 64 values are (k + 1/2) / 64.
double dither_threshold(std::uint32_t x, std::uint32_t y) {
    std::uint32_t rank = 0;
    for (std::uint32_t bit = 0; bit < 3; ++bit) {
        const std::uint32_t x_bit = (x >> bit) & 1u;
        const std::uint32_t y_bit = (y >> bit) & 1u;
        rank = rank * 4 + ((x_bit ^ y_bit) * 2 + y_bit);
    }
    return (rank + 0.5) / 64.0;
}

png_byte encode_value(double linear, double threshold) {
    if (!(linear > 0.0)) return 0;
    const double value = 255.0 * srgb_from_linear(std::min(linear, 1.0));
    return static_cast<png_byte>(std::min(255.0, std::floor(value + threshold)));
}

/// libpng's state. Its errors leave by longjmp, past which no destructor runs: all that the
/// encoder allocates belongs to this object, outside of the jump.
class PngWriter {
  public:
    explicit PngWriter(const PngSettings& settings) : settings_(settings) {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) throw std::bad_alloc();
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    [[nodiscard]] std::vector<std::byte> encode(const Image& image, const ColourPlanes& colour) {
        width_ = image.width;
        height_ = image.height;
        row_.resize(std::size_t{width_} * channels());
        for (const auto& [key, value] : image.metadata) add_text(key, value);
        const double scale = std::exp2(settings_.exposure_ev);
        const bool written = encode_rows([&](std::uint32_t y) { fill_row(colour, scale, y); });
        if (out_of_memory_) throw std::bad_alloc();
        if (!written) throw std::runtime_error(message_.data());
        return std::move(bytes_);
    }

  private:
    void add_text(const std::string& key, const std::string& value) {
        const bool ascii = std::all_of(value.begin(), value.end(),
                                       [](char c) { return static_cast<unsigned char>(c) < 0x80; });
        png_text text{};
        // libpng takes its own copy of the strings and only reads them.
        text.key = const_cast<char*>(key.c_str());
        text.text = const_cast<char*>(value.c_str());
        text.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        text_.push_back(text);
    }

    /// Bytes of a pixel: alpha is written where the background is transparent.
    [[nodiscard]] std::size_t channels() const {
        return settings_.background && settings_.background->transparent ? 4 : 3;
    }

    /// What is shown of an exposed, premultiplied colour. Without alpha in the file that is the sum
    /// of its light and what it lets through.
    [[nodiscard]] glm::dvec3 shown(glm::dvec3 exposed, double alpha) const {
        const bool straight = channels() == 4;
        if (straight) exposed = alpha > 0.0 ? exposed / alpha : glm::dvec3(0.0);
        if (settings_.tone != ToneCurve::none) exposed = toned(settings_.tone, glm::vec3(exposed));
        if (settings_.background && !straight)
            exposed += (1.0 - alpha) * glm::dvec3(settings_.background->colour);
        return exposed;
    }

    void fill_row(const ColourPlanes& colour, double scale, std::uint32_t y) {
        const std::size_t first = std::size_t{y} * width_;
        png_byte* byte = row_.data();
        for (std::uint32_t x = 0; x < width_; ++x) {
            const double threshold = dither_threshold(x, y);
            const double given = colour.alpha.empty() ? 1.0 : double{colour.alpha[first + x]};
            const double alpha = given > 0.0 ? std::min(given, 1.0) : 0.0;
            glm::dvec3 exposed(0.0);
            for (glm::length_t c = 0; c < 3; ++c)
                exposed[c] = scale * double{colour.plane[static_cast<std::size_t>(c)][first + x]};
            const glm::dvec3 linear = shown(exposed, alpha);
            for (glm::length_t c = 0; c < 3; ++c) *byte++ = encode_value(linear[c], threshold);
            if (channels() == 4) *byte++ = static_cast<png_byte>(std::lround(255.0 * alpha));
        }
    }

    /// Encodes all rows; false when libpng failed. Nothing here may own memory: see the class.
    template <typename FillRow>
    bool encode_rows(const FillRow& fill_row) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_write_fn(png_, this, on_write, on_flush);
        png_set_IHDR(png_, info_, width_, height_, 8,
                     channels() == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
        png_set_text(png_, info_, text_.data(), static_cast<int>(text_.size()));
        png_write_info(png_, info_);
        for (row_index_ = 0; row_index_ < height_; ++row_index_) {
            fill_row(row_index_);
            png_write_row(png_, row_.data());
        }
        png_write_end(png_, nullptr);
        return true;
    }

    /// Appends bytes. Exceptions must not cross libpng, so a lack of memory becomes a libpng error.
    bool append(std::span<const std::byte> bytes) noexcept {
        try {
            bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        } catch (const std::bad_alloc&) {
            out_of_memory_ = true;
        }
        return !out_of_memory_;
    }

    [[noreturn]] static void on_error(png_structp png, png_const_charp text) {
        auto* self = static_cast<PngWriter*>(png_get_error_ptr(png));
        const std::string_view reason = text;
        reason.copy(self->message_.data(), self->message_.size() - 1);
        png_longjmp(png, 1);
    }
    static void on_warning(png_structp, png_const_charp) {}
    static void on_write(png_structp png, png_bytep bytes, std::size_t size) {
        auto* self = static_cast<PngWriter*>(png_get_io_ptr(png));
        if (!self->append(std::as_bytes(std::span(bytes, size)))) png_error(png, "out of memory");
    }
    static void on_flush(png_structp) {}

    PngSettings settings_;
    std::vector<std::byte> bytes_;
    bool out_of_memory_ = false;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::uint32_t row_index_ = 0;
    std::vector<png_byte> row_;
    std::vector<png_text> text_;
    std::array<char, 200> message_{};
};

float luminance_of(float red, float green, float blue) {
    return 0.2126f * red + 0.7152f * green + 0.0722f * blue;
}

/// Drops luminances of pixels that are nearly black: a single one would brighten the whole image.
void drop_nearly_black(std::vector<float>& luminances) {
    double sum = 0.0;
    for (const float y : luminances) sum += double{y};
    const double floor = std::ldexp(sum / static_cast<double>(luminances.size()), -20);
    std::erase_if(luminances, [&](float y) { return !(double{y} > floor); });
}

double mean_log2(std::span<const float> luminances) {
    double sum = 0.0;
    for (const float y : luminances) sum += std::log2(double{y});
    return sum / static_cast<double>(luminances.size());
}

}  // namespace

std::vector<std::byte> png_bytes(const Image& image, const PngSettings& settings) {
    const ColourPlanes colour = find_colour(image);
    if (colour.pixels == 0 || image.width > limits::max_film_edge ||
        image.height > limits::max_film_edge)
        throw std::invalid_argument("the image has no colour layer, expected RGB or Y");
    return PngWriter(settings).encode(image, colour);
}

std::vector<std::byte> png_bytes(const Image& image, double exposure_ev) {
    return png_bytes(image, PngSettings{.exposure_ev = exposure_ev});
}

void write_png(const fs::path& path, const Image& image, const PngSettings& settings,
               WriteMode mode) {
    std::vector<std::byte> bytes;
    try {
        bytes = png_bytes(image, settings);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ExitCode::output, path.string(),
                    std::string("cannot be written: ") + error.what());
    }
    write_file_atomically(path, bytes, mode);
}

void write_png(const fs::path& path, const Image& image, double exposure_ev, WriteMode mode) {
    write_png(path, image, PngSettings{.exposure_ev = exposure_ev}, mode);
}

double auto_exposure(const Image& image) {
    const ColourPlanes colour = find_colour(image);
    const Layer* const emission = image.find("emission");
    const bool knows_lamps = emission != nullptr && emission->channels == "RGB" &&
                             emission->values.size() == 3 * colour.pixels;
    std::vector<float> luminances;
    std::vector<float> of_surfaces;
    luminances.reserve(colour.pixels);
    for (std::size_t i = 0; i < colour.pixels; ++i) {
        const float y = luminance_of(colour.plane[0][i], colour.plane[1][i], colour.plane[2][i]);
        if (!std::isfinite(y) || !(y > 0.0f)) continue;
        luminances.push_back(y);
        if (!knows_lamps) continue;
        const float* const values = emission->values.data() + i;
        const float emitted =
            luminance_of(values[0], values[colour.pixels], values[2 * colour.pixels]);
        if (emitted < 0.5f * y) of_surfaces.push_back(y);
    }
    if (luminances.empty()) return 0.0;
    // Lamps and the sky have no say in how bright the things that they light should be, unless
    // there is next to nothing else.
    const bool judge_surfaces = of_surfaces.size() * 100 >= luminances.size();
    drop_nearly_black(luminances);
    drop_nearly_black(of_surfaces);
    const double key = std::log2(0.18) - mean_log2(judge_surfaces ? of_surfaces : luminances);
    const auto percentile =
        luminances.begin() + static_cast<std::ptrdiff_t>((luminances.size() - 1) * 95 / 100);
    std::nth_element(luminances.begin(), percentile, luminances.end());
    const double highlights = -std::log2(double{*percentile});
    return std::max(key - 2.0, std::min(key, highlights));
}

}  // namespace weft
