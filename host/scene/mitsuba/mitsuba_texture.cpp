// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/texture/image_file.h"

namespace weft::mitsuba {

namespace {

Wrap read_wrap(Object& object) {
    const std::string mode = object.text("wrap_mode").value_or("repeat");
    if (mode == "repeat") return Wrap::repeat;
    if (mode == "mirror") return Wrap::mirror;
    if (mode == "clamp") return Wrap::clamp;
    throw input_error(object.place(),
                      "wrap_mode " + quote(mode) + ", expected repeat, mirror or clamp");
}

bool read_nearest(Object& object) {
    const std::string filter = object.text("filter_type").value_or("bilinear");
    if (filter != "bilinear" && filter != "nearest")
        throw input_error(object.place(),
                          "filter_type " + quote(filter) + ", expected bilinear or nearest");
    return filter == "nearest";
}

/// The first two rows of the transform of (u, v, 0, 1).
glm::dmat3 read_to_uv(Object& object) {
    const glm::dmat4 matrix = object.transform("to_uv");
    return {glm::dvec3(glm::dvec2(matrix[0]), 0.0), glm::dvec3(glm::dvec2(matrix[1]), 0.0),
            glm::dvec3(glm::dvec2(matrix[3]), 1.0)};
}

/// Two values as bytes, with a factor in [0, 1] that they are multiplied with.
struct BytePair {
    double factor = 1.0;
    std::array<std::uint8_t, 2> bytes{};
};

/// The pair of bytes whose ratio is nearest to that of two values in [0, 1].
BytePair encode_pair(double first, double second) {
    const double most = std::max(first, second);
    const double least = std::min(first, second);
    if (most == 0.0) return {};
    long best_high = 255;
    long best_low = 0;
    double best_error = 2.0;
    for (long high = 255; high >= 1 && static_cast<double>(high) >= 255.0 * most; --high) {
        const long low = std::lround(static_cast<double>(high) * least / most);
        const double error =
            std::abs(static_cast<double>(low) / static_cast<double>(high) - least / most);
        if (error >= best_error) continue;
        best_error = error;
        best_high = high;
        best_low = low;
    }
    BytePair pair;
    pair.factor = std::min(most * 255.0 / static_cast<double>(best_high), 1.0);
    const auto high = static_cast<std::uint8_t>(best_high);
    const auto low = static_cast<std::uint8_t>(best_low);
    pair.bytes = first >= second ? std::array{high, low} : std::array{low, high};
    return pair;
}

}  // namespace

const ColourParameter& TextureReader::reflectance(const Element& element) {
    if (const auto known = read_.find(&element); known != read_.end()) return known->second;
    ColourParameter colour;
    if (is_colour(element)) {
        colour.factor = parse_colour(element, ColourUse::reflectance, context_.warnings);
    } else {
        if (element.tag != "texture")
            throw input_error(element.place(), "reflectance is a " + quote(element.tag) +
                                                   ", expected rgb, spectrum, float or texture");
        colour = read_texture(element);
    }
    return read_.emplace(&element, colour).first->second;
}

ColourParameter TextureReader::reflectance(Object& object, std::string_view name,
                                           const glm::vec3& missing) {
    const Element* const found = object.find(name);
    return found == nullptr ? ColourParameter{missing} : reflectance(*found);
}

ScalarParameter TextureReader::scalar(Object& object, std::string_view name, double missing,
                                      double most) {
    const Element* const found = object.find(name);
    if (found == nullptr) return {static_cast<float>(missing)};
    if (found->tag == "float" || found->tag == "integer") {
        const double value = parse_number(*found, found->required("value"));
        if (!(value >= 0.0 && value <= most))
            throw input_error(found->place(), fmt::format("{} is {}, expected 0 to {:g}",
                                                          quote(name), value, most));
        return {static_cast<float>(value)};
    }
    const ColourParameter& colour = reflectance(*found);
    ScalarParameter number;
    // A texture's factor is grey but for checkerboards of colours, which are rare here.
    const bool grey = colour.factor == glm::vec3(colour.factor.r);
    const glm::vec3 weights(0.212671F, 0.715160F, 0.072169F);
    number.factor = grey ? colour.factor.r : std::min(glm::dot(colour.factor, weights), 1.0F);
    number.map = colour.map;
    number.map.channel = Channel::luminance;
    return number;
}

TextureMap TextureReader::vectors(const Element& element) {
    if (element.tag != "texture")
        throw input_error(element.place(),
                          "normals are a " + quote(element.tag) + ", expected a texture");
    return reflectance(element).map;
}

ColourParameter TextureReader::read_texture(const Element& element) {
    Object object(element, context_);
    ColourParameter colour;
    if (object.type() == "bitmap") {
        colour = read_bitmap(object);
    } else if (object.type() == "checkerboard") {
        colour = read_checkerboard(object);
    } else {
        context_.warnings.count(
            element, {"texture", "textures"},
            "type " + quote(object.type()) + " is not supported, grey 0.5 is used");
        return {glm::vec3(0.5F)};
    }
    object.report_unused();
    return colour;
}

ColourParameter TextureReader::read_bitmap(Object& object) {
    const std::filesystem::path path = object.file();
    const bool raw = object.boolean("raw", false);
    const bool nearest = read_nearest(object);
    const Wrap wrap = read_wrap(object);
    ColourParameter colour;
    colour.map.to_uv = read_to_uv(object);
    object.ignore({"format", "accel"});
    const std::string key =
        fmt::format("{}|{}|{}|{}", path.string(), raw, nearest, static_cast<unsigned>(wrap));
    const auto [entry, added] = bitmaps_.emplace(key, static_cast<int>(scene_.textures.size()));
    colour.map.texture = entry->second;
    if (!added) return colour;
    Texture texture = read_image(path, object.place());
    bytes_ += texture.rgba.size();
    if (bytes_ > limits::max_texture_bytes)
        throw input_error(object.place(), fmt::format("textures of more than {} bytes in the scene",
                                                      limits::max_texture_bytes));
    texture.name = path.filename().string();
    texture.srgb = !raw;
    texture.nearest = nearest;
    texture.wrap_u = texture.wrap_v = wrap;
    scene_.textures.push_back(std::move(texture));
    return colour;
}

ColourParameter TextureReader::read_checkerboard(Object& object) {
    const glm::vec3 first = object.colour("color0", ColourUse::reflectance, glm::vec3(0.4F));
    const glm::vec3 second = object.colour("color1", ColourUse::reflectance, glm::vec3(0.2F));
    Texture texture;
    texture.name = object.id_or("checkerboard");
    texture.width = texture.height = 2;
    texture.srgb = false;
    texture.nearest = true;
    texture.rgba.assign(16, 255);
    ColourParameter colour;
    for (int c = 0; c < 3; ++c) {
        const BytePair pair = encode_pair(first[c], second[c]);
        colour.factor[c] = static_cast<float>(pair.factor);
        // The first colour lies where both coordinates are below or above one half.
        for (const std::size_t texel : {0U, 1U, 2U, 3U})
            texture.rgba[4 * texel + static_cast<std::size_t>(c)] =
                pair.bytes[texel == 0 || texel == 3 ? 0 : 1];
    }
    colour.map.to_uv = read_to_uv(object);
    colour.map.texture = static_cast<int>(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
    return colour;
}

}  // namespace weft::mitsuba
