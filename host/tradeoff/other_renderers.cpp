// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/other_renderers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/file.h"
#include "base/json_file.h"
#include "base/limits.h"
#include "base/quote.h"
#include "image/load_image.h"

namespace weft {
namespace {

constexpr std::size_t max_file_bytes = std::size_t{1} << 20;
constexpr std::size_t max_images = 1000;
constexpr std::uint64_t max_pixels = std::uint64_t{1} << 28;  // 3 GiB
constexpr std::size_t max_notes = 100;
constexpr std::size_t max_note_bytes = 2000;
constexpr double seconds_per_year = 365.0 * 24.0 * 3600.0;

double number_of(const JsonValue& value, const char* key, double least, double most) {
    const JsonValue member = value.at(key);
    const double number = member.as_number();
    if (!(number >= least && number <= most))
        throw member.error(
            fmt::format("is {}, expected a number from {} to {}", number, least, most));
    return number;
}

std::string text_of(const JsonValue& value, std::size_t most) {
    const std::string& text = value.as_string();
    if (text.empty() || text.size() > most)
        throw value.error(fmt::format("has {} bytes, expected 1 to {}", text.size(), most));
    return text;
}

/// The beauty layer of an image as RGB, without other channels of its file, such as opacity.
Image colours_of(const Image& image, const FilmSize& size, const JsonValue& name) {
    const std::string file = quote(name.as_string());
    if (image.width != size.width || image.height != size.height)
        throw name.error(fmt::format("names {}, which is of {} x {} pixels, expected {} x {}", file,
                                     image.width, image.height, size.width, size.height));
    const Layer* const layer = image.find("");
    if (layer == nullptr || !layer->channels.starts_with("RGB"))
        throw name.error("names " + file + ", which has no channels R, G and B");
    const std::size_t count = 3 * std::size_t{image.width} * image.height;
    Layer colours{.name = "", .channels = "RGB", .values = {}};
    colours.values.assign(layer->values.begin(),
                          layer->values.begin() + static_cast<std::ptrdiff_t>(count));
    if (!std::all_of(colours.values.begin(), colours.values.end(),
                     [](float value) { return std::isfinite(value); }))
        throw name.error("names " + file + ", which holds values that are not finite");
    return {.width = image.width, .height = image.height, .layers = {colours}, .metadata = {}};
}

Image image_of(const std::filesystem::path& file, const JsonValue& name, const FilmSize& size) {
    const std::string& text = name.as_string();
    // Messages contain the path, and must stay on one line.
    const auto is_control = [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return code < 0x20 || code == 0x7F;
    };
    if (std::any_of(text.begin(), text.end(), is_control))
        throw name.error("is " + quote(text) + ", expected no control characters");
    const std::filesystem::path path = resolve_reference(file, text, name.place(), false);
    Image image;
    try {
        image = load_image(path);
    } catch (const Error& error) {
        throw name.error(error.what());
    }
    return colours_of(image, size, name);
}

OtherRendererPoint read_image(const std::filesystem::path& file, const JsonValue& value,
                              const nlohmann::json& json, const FilmSize& size) {
    OtherRendererPoint other;
    other.name = text_of(value.at("name"), limits::max_name_bytes);
    check_keys(value, json, {"name", "budget_s", "seconds", "samples", "denoised", "picture"});
    other.budget_s = number_of(value, "budget_s", 0.0, seconds_per_year);
    other.seconds = number_of(value, "seconds", 0.0, seconds_per_year);
    if (value.find("samples"))
        other.samples = number_of(value, "samples", 0.0, limits::max_samples_per_pixel);
    other.denoised = value.bool_or("denoised", false);
    other.image = image_of(file, value.at("picture"), size);
    return other;
}

std::size_t size_of(const JsonValue& list, std::size_t most) {
    const std::size_t count = list.size();
    if (count > most)
        throw list.error(fmt::format("has {} elements, expected at most {}", count, most));
    return count;
}

}  // namespace

OtherRenderers read_other_renderers(const std::filesystem::path& file, const FilmSize& size) {
    const nlohmann::json json = read_json_file(file, max_file_bytes);
    const JsonValue value(json, file.string() + "#");
    const JsonValue version = value.at("weft_peers");
    if (version.as_integer() != 1)
        throw version.error(fmt::format("is version {}, expected 1", version.as_integer()));
    check_keys(value, json, {"weft_peers", "pictures", "notes"});
    OtherRenderers others;
    // Notes first, since checking them takes no time.
    if (const auto notes = value.find("notes"))
        for (std::size_t i = 0; i < size_of(*notes, max_notes); ++i)
            others.notes.push_back(text_of(notes->element(i), max_note_bytes));
    const JsonValue images = value.at("pictures");
    const std::size_t count = size_of(images, max_images);
    const std::uint64_t pixels = std::uint64_t{size.width} * size.height;
    if (count * pixels > max_pixels)
        throw images.error(
            fmt::format("has {} images of {} x {} pixels, expected at most {} pixels together",
                        count, size.width, size.height, max_pixels));
    for (std::size_t i = 0; i < count; ++i)
        others.images.push_back(read_image(file, images.element(i), json.at("pictures")[i], size));
    return others;
}

}  // namespace weft
