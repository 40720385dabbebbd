// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/film_sums_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "shared/shared_types.h"

namespace weft {
namespace {

constexpr const char* identity_key = "weft.picture";
constexpr const char* ranges_key = "weft.samples";
constexpr const char* exponent_key = "weft.light_exponent";
constexpr const char* unit_key = "weft.depth_exponent";
constexpr const char* backends_key = "weft.backends";
constexpr int largest_exponent = 1000;

std::string layer_name(std::size_t plane) {
    return fmt::format("{}.{:02}", word_layer_prefix, plane);
}

class Reader {
  public:
    Reader(const Image& image, const std::string& place) : image_(image), place_(place) {}

    [[nodiscard]] std::string text(const char* key) const {
        const auto found = image_.metadata.find(key);
        if (found == image_.metadata.end())
            throw input_error(
                place_, "holds no sums, expected an image written with --samples or --resume");
        return found->second;
    }

    [[nodiscard]] int exponent(const char* key) const {
        const std::string value = text(key);
        int number = 0;
        const auto [end, error] =
            std::from_chars(value.data(), value.data() + value.size(), number);
        if (error != std::errc() || end != value.data() + value.size() ||
            number < -largest_exponent || number > largest_exponent)
            throw damaged(key);
        return number;
    }

    [[nodiscard]] std::vector<SampleRange> ranges() const {
        const std::string value = text(ranges_key);
        std::vector<SampleRange> ranges;
        const char* at = value.data();
        const char* const end = at + value.size();
        while (at != end) {
            SampleRange range;
            at = number(at, end, range.first);
            if (at == end || *at++ != ':') throw damaged(ranges_key);
            at = number(at, end, range.end);
            if (range.first >= range.end) throw damaged(ranges_key);
            ranges.push_back(range);
            if (at != end && (*at++ != ',' || at == end)) throw damaged(ranges_key);
        }
        return joined(std::move(ranges));
    }

    /// None in files of versions that did not write them.
    [[nodiscard]] std::set<std::string> backends() const {
        std::set<std::string> names;
        if (!image_.metadata.contains(backends_key)) return names;
        std::string name;
        for (const char c : text(backends_key) + ",") {
            if (c != ',' && (c < 'a' || c > 'z')) throw damaged(backends_key);
            if (c != ',')
                name += c;
            else if (!names.insert(std::exchange(name, "")).second)
                throw damaged(backends_key);
        }
        if (names.contains("")) throw damaged(backends_key);
        return names;
    }

    [[nodiscard]] const Layer& words(std::size_t plane) const {
        const Layer* const layer = image_.find(layer_name(plane));
        const std::size_t pixels = std::size_t{image_.width} * image_.height;
        if (layer == nullptr || !layer->words || layer->values.size() != pixels)
            throw input_error(place_,
                              "lacks a part of its sums, expected layer " + layer_name(plane));
        return *layer;
    }

  private:
    [[nodiscard]] Error damaged(const char* key) const {
        return input_error(place_, std::string("has damaged metadata ") + key);
    }

    const char* number(const char* at, const char* end, std::uint32_t& value) const {
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc()) throw damaged(ranges_key);
        return next;
    }

    const Image& image_;
    const std::string& place_;
};

}  // namespace

std::string ranges_text(const std::vector<SampleRange>& ranges) {
    std::string text;
    for (const SampleRange& range : ranges)
        text += fmt::format("{}{}:{}", text.empty() ? "" : ",", range.first, range.end);
    return text;
}

std::string backends_text(const std::set<std::string>& backends) {
    std::string text;
    for (const std::string& name : backends) text += (text.empty() ? "" : ",") + name;
    return text;
}

void attach_sums(const FilmSums& sums, Image& image) {
    image.metadata[identity_key] = sums.identity;
    image.metadata[ranges_key] = ranges_text(sums.ranges);
    if (!sums.backends.empty()) image.metadata[backends_key] = backends_text(sums.backends);
    image.metadata[exponent_key] = std::to_string(sums.light_exponent);
    image.metadata[unit_key] = std::to_string(std::ilogb(sums.depth_unit));  // a power of two
    const std::size_t pixels = std::size_t{sums.width} * sums.height;
    for (std::size_t plane = 0; plane < FILM_PIXEL_WORDS; ++plane) {
        Layer layer{layer_name(plane), "Y", {}, true};
        layer.values.reserve(pixels);
        for (std::size_t pixel = 0; pixel < pixels; ++pixel)
            layer.values.push_back(
                std::bit_cast<float>(sums.words[pixel * FILM_PIXEL_WORDS + plane]));
        image.layers.push_back(std::move(layer));
    }
}

FilmSums sums_of(const Image& image, const std::string& place) {
    const Reader reader(image, place);
    FilmSums sums;
    sums.width = image.width;
    sums.height = image.height;
    sums.identity = reader.text(identity_key);
    sums.ranges = reader.ranges();
    sums.backends = reader.backends();
    sums.light_exponent = reader.exponent(exponent_key);
    sums.depth_unit = std::ldexp(1.0, reader.exponent(unit_key));
    sums.words.resize(std::size_t{FILM_PIXEL_WORDS} * image.width * image.height);
    for (std::size_t plane = 0; plane < FILM_PIXEL_WORDS; ++plane) {
        std::size_t at = plane;
        for (const float word : reader.words(plane).values) {
            sums.words[at] = std::bit_cast<std::uint32_t>(word);
            at += FILM_PIXEL_WORDS;
        }
    }
    return sums;
}

}  // namespace weft
