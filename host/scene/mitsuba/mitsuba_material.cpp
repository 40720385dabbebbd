// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

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

/// Bsdfs that scatter light arriving from either side without a `twosided` around them.
bool is_two_sided_type(std::string_view type) {
    static constexpr std::array<std::string_view, 5> types = {
        "dielectric", "thindielectric", "roughdielectric", "principledthin", "hair"};
    return std::find(types.begin(), types.end(), type) != types.end();
}

}  // namespace

const MitsubaSurface& MaterialReader::surface(const Element* bsdf) {
    if (const auto found = surfaces_.find(bsdf); found != surfaces_.end()) return found->second;
    MitsubaSurface surface;
    surface.name = "default";
    if (bsdf != nullptr) {
        if (std::find(open_.begin(), open_.end(), bsdf) != open_.end())
            throw input_error(bsdf->place(), "bsdf refers to itself, expected no cycle");
        if (open_.size() > static_cast<std::size_t>(limits::max_nesting))
            throw input_error(bsdf->place(), fmt::format("bsdfs nested deeper than {} levels",
                                                         limits::max_nesting));
        open_.push_back(bsdf);
        surface = read_bsdf(*bsdf);
        open_.pop_back();
    }
    return surfaces_.emplace(bsdf, std::move(surface)).first->second;
}

MitsubaSurface MaterialReader::read_bsdf(const Element& element) {
    Object object(element, context_);
    MitsubaSurface surface;
    if (object.type() == "diffuse") {
        if (const Element* const reflectance = object.find("reflectance"))
            read_reflectance(*reflectance, surface);
    } else if (object.type() == "twosided") {
        read_twosided(object, surface);
    } else if (object.type() == "null") {
        surface.invisible = true;
    } else {
        read_unsupported(object, surface);
        surface.name = object.id_or(object.type());
        return surface;
    }
    surface.name = object.id_or(object.type());
    object.report_unused();
    return surface;
}

void MaterialReader::read_twosided(Object& object, MitsubaSurface& surface) {
    const std::vector<const Element*> sides = object.nested("bsdf");
    if (sides.empty() || sides.size() > 2)
        throw input_error(object.place(), fmt::format("twosided with {} nested bsdfs, expected 1 "
                                                      "or 2",
                                                      sides.size()));
    surface = this->surface(sides[0]);
    surface.two_sided = true;
    if (sides.size() == 2)
        context_.warnings.count(object.element(), {"bsdf", "bsdfs"},
                                "twosided holds two, the first is used on both sides");
}

void MaterialReader::read_unsupported(Object& object, MitsubaSurface& surface) {
    context_.warnings.count(
        object.element(), {"bsdf", "bsdfs"},
        "type " + quote(object.type()) + " is not supported, rendered as diffuse");
    surface.two_sided = is_two_sided_type(object.type());
    for (const char* name :
         {"diffuse_reflectance", "base_color", "reflectance", "specular_reflectance"}) {
        const Element* const colour = object.find(name);
        if (colour == nullptr) continue;
        read_reflectance(*colour, surface);
        return;
    }
    const std::vector<const Element*> inner = object.nested("bsdf");
    if (!inner.empty()) surface = this->surface(inner.front());
}

void MaterialReader::read_reflectance(const Element& element, MitsubaSurface& surface) {
    if (is_colour(element)) {
        surface.albedo = parse_colour(element, ColourUse::reflectance, context_.warnings);
        return;
    }
    if (element.tag != "texture")
        throw input_error(element.place(), "reflectance is a " + quote(element.tag) +
                                               ", expected rgb, spectrum, float or texture");
    Object texture(element, context_);
    if (texture.type() == "bitmap") {
        read_bitmap(texture, surface);
        texture.report_unused();
        return;
    }
    context_.warnings.count(
        element, {"texture", "textures"},
        "type " + quote(texture.type()) + " is not supported, its mean colour is used");
    if (texture.type() != "checkerboard") return;
    const ColourUse use = ColourUse::reflectance;
    surface.albedo = 0.5F * (texture.colour("color0", use, glm::vec3(0.4F)) +
                             texture.colour("color1", use, glm::vec3(0.2F)));
}

void MaterialReader::read_bitmap(Object& object, MitsubaSurface& surface) {
    const std::filesystem::path path = object.file();
    const bool raw = object.boolean("raw", false);
    const bool nearest = read_nearest(object);
    const Wrap wrap = read_wrap(object);
    surface.to_uv = object.transform("to_uv");
    surface.albedo = glm::vec3(1.0F);
    object.ignore({"format", "accel"});
    const std::string key =
        fmt::format("{}|{}|{}|{}", path.string(), raw, nearest, static_cast<unsigned>(wrap));
    const auto [entry, added] = textures_.emplace(key, static_cast<int>(scene_.textures.size()));
    surface.texture = entry->second;
    if (!added) return;
    Texture texture = read_image(path, object.place());
    texture_bytes_ += texture.rgba.size();
    if (texture_bytes_ > limits::max_texture_bytes)
        throw input_error(object.place(), fmt::format("textures of more than {} bytes in the scene",
                                                      limits::max_texture_bytes));
    texture.name = path.filename().string();
    texture.srgb = !raw;
    texture.nearest = nearest;
    texture.wrap_u = texture.wrap_v = wrap;
    scene_.textures.push_back(std::move(texture));
}

glm::vec3 MaterialReader::read_radiance(const Element& emitter) {
    Object object(emitter, context_);
    if (object.type() != "area")
        throw input_error(object.place(),
                          "emitter " + quote(object.type()) + " inside a shape, expected 'area'");
    const glm::vec3 radiance = object.colour("radiance", ColourUse::emission, glm::vec3(1.0F));
    object.ignore({"sampling_weight"});
    object.report_unused();
    return radiance;
}

std::uint32_t MaterialReader::material(const Element* bsdf, const Element* emitter) {
    const auto key = std::make_pair(bsdf, emitter);
    if (const auto found = materials_.find(key); found != materials_.end()) return found->second;
    const MitsubaSurface& parsed = surface(bsdf);
    Material material;
    material.name = parsed.name;
    material.surface =
        DiffuseSurface{parsed.invisible ? glm::vec3(0.0F) : parsed.albedo, parsed.texture};
    material.two_sided = parsed.two_sided;
    if (emitter != nullptr) material.emission.radiance = read_radiance(*emitter);
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
    materials_.emplace(key, index);
    return index;
}

}  // namespace weft::mitsuba
