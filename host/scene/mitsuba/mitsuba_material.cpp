// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/mitsuba/mitsuba_bsdf.h"

namespace weft::mitsuba {

namespace {

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
        read_replaced(object, surface);
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

void MaterialReader::read_replaced(Object& object, MitsubaSurface& surface) {
    surface.two_sided = is_two_sided_type(object.type());
    bool coloured = false;
    for (const char* name :
         {"diffuse_reflectance", "base_color", "reflectance", "specular_reflectance"}) {
        const Element* const colour = object.find(name);
        if (colour == nullptr) continue;
        read_reflectance(*colour, surface);
        coloured = true;
        break;
    }
    const std::vector<const Element*> inner = object.nested("bsdf");
    if (!coloured && !inner.empty()) surface = this->surface(inner.front());
    if (detail_ == MaterialDetail::full && describe(object, inner, surface)) return;
    context_.warnings.count(
        object.element(), {"bsdf", "bsdfs"},
        "type " + quote(object.type()) + " is not supported, rendered as diffuse");
}

bool MaterialReader::describe(Object& object, const std::vector<const Element*>& inner,
                              MitsubaSurface& surface) {
    const bool adapts = object.type() == "mask" || object.type() == "normalmap";
    if (std::optional<SurfaceModel> model = read_bsdf_model(object, textures_, context_)) {
        surface.description = SurfaceDescription{*model, {}, {}};
    } else if (adapts) {
        if (inner.size() != 1)
            throw input_error(object.place(), fmt::format("{} with {} nested bsdfs, expected 1",
                                                          object.type(), inner.size()));
        if (surface.invisible) return true;
        if (!surface.description)
            surface.description =
                SurfaceDescription{LambertSurface{{surface.albedo, surface.map()}}, {}, {}};
        if (object.type() == "mask")
            surface.description->opacity =
                combine(object, surface.description->opacity, read_opacity(object, textures_));
        else
            surface.description->normal_map = read_normal_map(object, textures_);
    } else {
        return false;
    }
    if (object.type() == "principled")
        context_.warnings.count(object.element(), {"bsdf", "bsdfs"},
                                "type 'principled' is rendered as metallic-roughness");
    object.report_unused();
    return true;
}

Opacity MaterialReader::combine(Object& object, const Opacity& inner, Opacity outer) {
    if (inner.mode == OpacityMode::opaque) return outer;
    if (inner.alpha.map.present() && outer.alpha.map.present()) {
        context_.warnings.count(object.element(), {"bsdf", "bsdfs"},
                                "a mask with a texture holds another one, the outer is used");
        return outer;
    }
    if (inner.alpha.map.present()) outer.alpha.map = inner.alpha.map;
    outer.alpha.factor *= inner.alpha.factor;
    return outer;
}

void MaterialReader::read_reflectance(const Element& element, MitsubaSurface& surface) {
    const ColourParameter& colour = textures_.reflectance(element);
    surface.albedo = colour.factor;
    surface.texture = colour.map.texture;
    surface.to_uv = colour.map.to_uv;
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
    material.description = parsed.description;
    if (emitter != nullptr) material.emission.radiance = read_radiance(*emitter);
    const auto index = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
    materials_.emplace(key, index);
    return index;
}

}  // namespace weft::mitsuba
