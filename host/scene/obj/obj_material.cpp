// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/texture/image_file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr float default_albedo = 0.8F;
constexpr WarningUnit obj_material_unit{"material", "materials"};

/// The words of an `mtllib`; a backslash keeps the blank behind it in the name.
std::vector<std::string> split_names(std::string_view text) {
    std::vector<std::string> names;
    std::string name;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        const bool end = i == text.size();
        const bool escape = !end && text[i] == '\\' && i + 1 < text.size() &&
                            (text[i + 1] == ' ' || text[i + 1] == '\t');
        if (escape) {
            name += text[++i];
        } else if (end || text[i] == ' ' || text[i] == '\t') {
            if (!name.empty()) names.push_back(std::move(name));
            name.clear();
        } else {
            name += text[i];
        }
    }
    return names;
}

ObjUvs uvs_of(const MtlMap& map) {
    return {map.scale, map.offset};
}

/// The same for coordinates whose v runs downwards.
glm::dmat3 to_uv_of(const MtlMap& map) {
    return {glm::dvec3(map.scale.x, 0.0, 0.0), glm::dvec3(0.0, map.scale.y, 0.0),
            glm::dvec3(map.offset.x, 1.0 - map.scale.y - map.offset.y, 1.0)};
}

/// Whether an image is anywhere not opaque.
bool has_transparency(const Texture& texture) {
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
        if (texture.rgba[i] != 255) return true;
    return false;
}

/// The channel that a map names, else the luminance.
Channel channel_of(const MtlMap& map) {
    switch (map.channel) {
        case 'r':
            return Channel::red;
        case 'g':
            return Channel::green;
        case 'b':
            return Channel::blue;
        case 'm':
            return Channel::alpha;
        default:
            return Channel::luminance;
    }
}

}  // namespace

ObjMaterials::ObjMaterials(fs::path obj_file, WarningCollector& report, MaterialDetail detail,
                           Scene& scene)
    : obj_file_(std::move(obj_file)), report_(report), detail_(detail), scene_(scene) {}

/// Finds the file of a reference. Writers on Windows separate folders by backslashes, and often
/// give absolute paths, which are never followed: returns nothing then, with the reason in `why`.
std::optional<fs::path> ObjMaterials::find_file(std::string_view reference,
                                                std::string& why) const {
    std::string name(reference);
    std::replace(name.begin(), name.end(), '\\', '/');
    fs::path path;
    try {
        path = resolve_reference(obj_file_, name, "", false);
    } catch (const Error& error) {
        why = error.what();
        return std::nullopt;
    }
    std::error_code error;
    if (fs::exists(path, error)) return path;
    why = "the file is missing";
    return std::nullopt;
}

bool ObjMaterials::read_file_named(std::string_view reference, const std::string& place,
                                   std::string& why) {
    const std::optional<fs::path> path = find_file(reference, why);
    if (!path) return false;
    if (!libraries_.insert(*path).second) return true;
    if (libraries_.size() > limits::max_mtl_files)
        throw input_error(place, fmt::format("more than {} material files, expected fewer",
                                             limits::max_mtl_files));
    const std::vector<std::byte> bytes = read_file(*path, limits::max_mtl_file_bytes, place);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    parse_mtl(text, path->string(), report_, detail_, sources_);
    return true;
}

void ObjMaterials::read_library(const ObjLibrary& library) {
    std::string why;
    if (library.names.empty()) {
        report_.once(library.place, "'mtllib' names no file");
        return;
    }
    if (read_file_named(library.names, library.place, why)) return;
    const std::vector<std::string> names = split_names(library.names);
    if (names.size() == 1) {
        if (!read_file_named(names[0], library.place, why)) report_lost(library, names[0], why);
        return;
    }
    for (const std::string& name : names) {
        if (!read_file_named(name, library.place, why)) report_lost(library, name, why);
    }
}

void ObjMaterials::report_lost(const ObjLibrary& library, const std::string& name,
                               const std::string& why) {
    library_lost_ = true;
    report_.count(library.place + " " + quote(name), {"MTL file", "MTL files"},
                  why + ", its materials are replaced by grey");
}

const ObjSurface& ObjMaterials::default_surface() {
    if (default_) return *default_;
    Material material;
    material.name = "default";
    material.surface = DiffuseSurface{glm::vec3(default_albedo)};
    default_ = ObjSurface{static_cast<std::uint32_t>(scene_.materials.size())};
    scene_.materials.push_back(std::move(material));
    return *default_;
}

const ObjSurface& ObjMaterials::surface(const std::string& name, const std::string& place) {
    if (const auto known = surfaces_.find(name); known != surfaces_.end()) return known->second;
    const auto source = sources_.find(name);
    if (source != sources_.end())
        return surfaces_.emplace(name, make_surface(name, source->second)).first->second;
    // That of a missing file is told already.
    if (!name.empty() && !library_lost_)
        report_.count(place + " " + quote(name), obj_material_unit,
                      "no MTL file defines it, grey is rendered instead");
    return surfaces_.emplace(name, default_surface()).first->second;
}

ObjSurface ObjMaterials::make_surface(const std::string& name, const MtlMaterial& source) {
    Material material;
    material.name = name.substr(0, limits::max_name_bytes);
    material.emission.both_sides = true;
    ObjSurface surface;
    DiffuseSurface diffuse;
    if (source.diffuse_map) {
        diffuse.albedo_texture = add_texture(*source.diffuse_map);
        if (diffuse.albedo_texture >= 0) surface.diffuse_uvs = uvs_of(*source.diffuse_map);
    }
    const bool textured = surface.diffuse_uvs.has_value();
    diffuse.albedo = source.diffuse.value_or(glm::vec3(textured ? 1.0F : default_albedo));
    if (textured && diffuse.albedo == glm::vec3(0.0F)) {
        report_.count(source.place, obj_material_unit,
                      "black Kd would hide the texture, it is taken as white");
        diffuse.albedo = glm::vec3(1.0F);
    }
    material.surface = diffuse;
    material.emission.radiance = source.emission;
    if (source.emission_map && source.emission != glm::vec3(0.0F)) {
        material.emission.texture = add_texture(*source.emission_map);
        if (material.emission.texture >= 0) surface.emission_uvs = uvs_of(*source.emission_map);
    } else if (source.emission_map) {
        report_.count(source.emission_map->place, obj_material_unit,
                      "map_Ke without Ke is ignored");
    }
    if (detail_ == MaterialDetail::full) {
        ColourParameter colour{diffuse.albedo};
        if (textured)
            colour.map = {diffuse.albedo_texture, 0, to_uv_of(*source.diffuse_map), Channel::rgb};
        material.description = describe_mtl(
            source, colour, [&](const MtlMap& map, MtlMapUse use) { return add_map(map, use); },
            report_);
        surface.has_maps = material.description && !texture_maps(*material.description).empty();
    }
    surface.material = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
    return surface;
}

TextureMap ObjMaterials::add_map(const MtlMap& map, MtlMapUse use) {
    TextureMap found;
    found.texture = add_texture(map, use == MtlMapUse::colour);
    if (!found.present()) return found;
    found.to_uv = to_uv_of(map);
    if (use == MtlMapUse::colour || use == MtlMapUse::normals) return found;
    Texture& texture = scene_.textures[static_cast<std::size_t>(found.texture)];
    found.channel = channel_of(map);
    // Images of transparency have it as alpha, or as grey.
    if (use == MtlMapUse::alpha && map.channel == 0 && has_transparency(texture))
        found.channel = Channel::alpha;
    texture.has_alpha |= found.channel == Channel::alpha;
    return found;
}

/// Reads an image. One that is missing, or of a kind that is not read, leaves the material its
/// plain colour.
std::optional<Texture> ObjMaterials::read_map(const MtlMap& map) {
    std::string why;
    const std::optional<fs::path> path = find_file(map.file, why);
    Texture texture;
    try {
        if (path) texture = read_image(*path, "");
    } catch (const Error& error) {
        why = error.what();
        // The warning names the image behind its place.
        const std::string place = path->string() + ": ";
        if (why.starts_with(place)) why.erase(0, place.size());
    }
    if (texture.rgba.empty()) {
        report_.count(map.place + " " + quote(map.file), {"texture", "textures"},
                      why + ", the plain colour is used");
        return std::nullopt;
    }
    decoded_bytes_ += texture.rgba.size();
    if (decoded_bytes_ > limits::max_texture_bytes)
        throw input_error(map.place,
                          fmt::format("all images together exceed the limit of {} decoded bytes",
                                      limits::max_texture_bytes));
    return texture;
}

int ObjMaterials::add_texture(const MtlMap& map, bool srgb) {
    const auto [known, added] = textures_.try_emplace({map.file, map.clamp, srgb}, -1);
    if (!added) return known->second;
    std::optional<Texture> texture = read_map(map);
    if (!texture) return -1;
    texture->srgb = srgb;
    texture->wrap_u = texture->wrap_v = map.clamp ? Wrap::clamp : Wrap::repeat;
    known->second = static_cast<int>(scene_.textures.size());
    scene_.textures.push_back(*std::move(texture));
    return known->second;
}

}  // namespace weft
