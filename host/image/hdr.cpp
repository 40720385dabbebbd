// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/hdr.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

// Most pixels that a byte of the file can encode. Old run lengths could encode more than twice as
// many, but only in rows of one colour that are wider than any image within the limits.
constexpr std::size_t max_expansion = 1024;

/// How rows and columns lie in the file.
struct Resolution {
    std::uint32_t width = 0, height = 0;
    bool by_columns = false;  ///< a scan line is a column
    bool flip_x = false, flip_y = false;
};

struct Header {
    Resolution resolution;
    std::array<double, 3> scale = {1.0, 1.0, 1.0};  ///< by which pixels were multiplied
};

/// The bytes of a file and the line a message is about.
class Source {
  public:
    Source(std::span<const std::byte> bytes, const std::string& place)
        : bytes_(bytes), place_(place) {}

    [[nodiscard]] Error error(const std::string& message) const {
        return input_error(line_ > 0 ? place_ + ":" + std::to_string(line_) : place_, message);
    }

    /// The next line of the header, without its end.
    std::string_view line() {
        ++line_;
        const std::string_view text(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
        const std::string_view rest =
            text.substr(0, std::min(text.size(), limits::max_hdr_header_bytes)).substr(position_);
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos)
            throw error("the header of the Radiance image has no end");
        position_ += end + 1;
        std::string_view result = rest.substr(0, end);
        if (result.ends_with('\r')) result.remove_suffix(1);
        return result;
    }
    void end_of_header() { line_ = 0; }

    [[nodiscard]] std::size_t left() const { return bytes_.size() - position_; }
    std::uint8_t byte() {
        if (left() == 0) throw error("is cut off, expected all scan lines");
        return std::to_integer<std::uint8_t>(bytes_[position_++]);
    }
    Rgbe pixel() {
        Rgbe result{};
        for (std::uint8_t& value : result) value = byte();
        return result;
    }
    void back(std::size_t count) { position_ -= count; }

  private:
    std::span<const std::byte> bytes_;
    const std::string& place_;
    std::size_t position_ = 0;
    std::size_t line_ = 0;
};

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Removes the next word from a line and returns it.
std::string_view next_word(std::string_view& text) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    text.remove_prefix(word.size());
    return word;
}

double read_scale(std::string_view& text, const Source& source) {
    const std::string_view word = next_word(text);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !(value > 0.0) ||
        !std::isfinite(value))
        throw source.error("exposure " + quote(word) + ", expected a positive number");
    return value;
}

std::uint32_t read_edge(std::string_view word, const Source& source) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || value == 0 ||
        value > limits::max_film_edge)
        throw source.error("image edge " + quote(word) + ", expected 1 to " +
                           std::to_string(limits::max_film_edge) + " pixels");
    return value;
}

/// `-Y H +X W` and its relatives: the axis of scan lines comes first.
Resolution read_resolution(Source& source) {
    std::string_view line = source.line();
    const std::string whole(line);
    Resolution result;
    bool seen_x = false;
    bool seen_y = false;
    for (int i = 0; i < 2; ++i) {
        const std::string_view axis = next_word(line);
        const std::string_view edge = next_word(line);
        if (axis == "+X" || axis == "-X") {
            result.by_columns = i == 0;
            result.flip_x = axis[0] == '-';
            result.width = read_edge(edge, source);
            seen_x = true;
        } else if (axis == "+Y" || axis == "-Y") {
            result.flip_y = axis[0] == '+';  // Y counts upwards, our rows downwards
            result.height = read_edge(edge, source);
            seen_y = true;
        }
    }
    if (!seen_x || !seen_y || !trimmed(line).empty())
        throw source.error("resolution " + quote(whole) + ", expected one like -Y 480 +X 640");
    return result;
}

Header read_header(Source& source) {
    Header header;
    if (!source.line().starts_with("#?"))
        throw source.error("is not a Radiance image, expected #?RADIANCE");
    for (std::string_view line = source.line(); !line.empty(); line = source.line()) {
        const std::size_t equals = line.find('=');
        if (line[0] == '#' || equals == std::string_view::npos) continue;
        const std::string_view name = line.substr(0, equals);
        std::string_view value = line.substr(equals + 1);
        if (name == "FORMAT" && trimmed(value) != "32-bit_rle_rgbe")
            throw source.error("format " + quote(trimmed(value)) + ", expected 32-bit_rle_rgbe");
        if (name == "EXPOSURE") {
            const double factor = read_scale(value, source);
            for (double& scale : header.scale) scale *= factor;
        }
        if (name == "COLORCORR")
            for (double& scale : header.scale) scale *= read_scale(value, source);
    }
    for (const double scale : header.scale)
        if (!(scale > 1e-30) || !(scale < 1e30))
            throw source.error("exposures multiply to a number that makes no image");
    header.resolution = read_resolution(source);
    source.end_of_header();
    return header;
}

/// Reads a row in the new format: all bytes of each mantissa and then of the exponent, each as runs
/// and literal pieces.
void read_new_runs(Source& source, std::vector<Rgbe>& row) {
    constexpr std::uint8_t run_mark = 128;
    for (std::size_t channel = 0; channel < 4; ++channel) {
        for (std::size_t x = 0; x < row.size();) {
            const std::uint8_t code = source.byte();
            const bool run = code > run_mark;
            const std::size_t count = run ? code - std::size_t{run_mark} : std::size_t{code};
            if (count == 0 || count > row.size() - x)
                throw source.error("is damaged: a run leaves its scan line");
            std::uint8_t value = run ? source.byte() : std::uint8_t{0};
            for (std::size_t i = 0; i < count; ++i, ++x) {
                if (!run) value = source.byte();
                row[x][channel] = value;
            }
        }
    }
}

/// Reads a row in the old format: whole pixels; 1 1 1 n repeats the last one, and consecutive runs
/// are digits of one count.
void read_old_runs(Source& source, std::vector<Rgbe>& row) {
    unsigned shift = 0;
    for (std::size_t x = 0; x < row.size();) {
        const Rgbe pixel = source.pixel();
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            row[x++] = pixel;
            shift = 0;
            continue;
        }
        const std::size_t count = shift <= 16 ? std::size_t{pixel[3]} << shift : row.size();
        if (x == 0 || count > row.size() - x)
            throw source.error("is damaged: a run leaves its scan line");
        std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
        x += count;
        shift += 8;
    }
}

void read_row(Source& source, std::vector<Rgbe>& row) {
    constexpr std::size_t min_new = 8;
    constexpr std::size_t max_new = 0x7FFF;
    if (row.size() >= min_new && row.size() <= max_new) {
        const Rgbe mark = source.pixel();
        if (mark[0] == 2 && mark[1] == 2 && mark[2] < 128) {
            if (mark[2] * std::size_t{256} + mark[3] != row.size())
                throw source.error("is damaged: a scan line of another length");
            return read_new_runs(source, row);
        }
        source.back(mark.size());
    }
    read_old_runs(source, row);
}

/// Refuses sizes for which the file has too few bytes.
void check_size(const Resolution& size, const Source& source) {
    const std::size_t pixels = std::size_t{size.width} * size.height;
    if (pixels > limits::max_film_pixels || pixels / max_expansion > source.left())
        throw source.error("claims " + std::to_string(size.width) + " x " +
                           std::to_string(size.height) +
                           " pixels, more than the file can hold or the limit of " +
                           std::to_string(limits::max_film_pixels));
}

float decode(std::uint8_t mantissa, std::uint8_t exponent, double scale, const Source& source) {
    if (exponent == 0) return 0.0F;
    const double value = std::ldexp(static_cast<double>(mantissa), exponent - 136) / scale;
    if (value > double{std::numeric_limits<float>::max()})
        throw source.error("has a value that is too large without its exposure");
    return static_cast<float>(value);
}

}  // namespace

Image decode_hdr(std::span<const std::byte> bytes, const std::string& place) {
    Source source(bytes, place);
    const Header header = read_header(source);
    const Resolution& size = header.resolution;
    check_size(size, source);
    const std::size_t pixels = std::size_t{size.width} * size.height;
    Image image;
    image.width = size.width;
    image.height = size.height;
    image.layers = {{"", "RGB", std::vector<float>(3 * pixels)}};
    std::vector<float>& values = image.layers[0].values;
    std::vector<Rgbe> row(size.by_columns ? size.height : size.width);
    const std::size_t lines = size.by_columns ? size.width : size.height;
    for (std::size_t line = 0; line < lines; ++line) {
        read_row(source, row);
        for (std::size_t i = 0; i < row.size(); ++i) {
            std::size_t x = size.by_columns ? line : i;
            std::size_t y = size.by_columns ? i : line;
            if (size.flip_x) x = size.width - 1 - x;
            if (size.flip_y) y = size.height - 1 - y;
            for (std::size_t c = 0; c < 3; ++c)
                values[c * pixels + y * size.width + x] =
                    decode(row[i][c], row[i][3], header.scale[c], source);
        }
    }
    return image;
}

Image read_hdr(const std::filesystem::path& path) {
    return decode_hdr(read_file(path, limits::max_image_file_bytes), path.string());
}

}  // namespace weft
