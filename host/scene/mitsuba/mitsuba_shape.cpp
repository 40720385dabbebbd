// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/mesh_edit.h"
#include "scene/obj/obj_reader.h"
#include "scene/ply/ply_reader.h"
#include "scene/shapes.h"

namespace weft::mitsuba {

namespace {

constexpr WarningUnit shape_unit{"shape", "shapes"};

bool is_supported(std::string_view type) {
    static constexpr std::array<std::string_view, 6> types = {"ply",  "obj",    "rectangle",
                                                              "cube", "sphere", "disk"};
    return std::find(types.begin(), types.end(), type) != types.end();
}

bool is_mesh_file(std::string_view type) {
    return type == "ply" || type == "obj";
}

/// Refuses transforms without an inverse; returns whether the transform changes handedness.
bool check_mirroring(Object& object, const glm::dmat4& to_world) {
    const glm::dmat3 linear(to_world);
    const double lengths = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    const double determinant = glm::determinant(linear);
    constexpr double flattest = 1e-12;
    if (!(std::abs(determinant) > flattest * lengths) || !std::isfinite(lengths))
        throw input_error(
            object.place(),
            "to_world cannot be inverted, expected a transform that flattens nothing");
    return determinant < 0.0;
}

const Element* single(Object& object, const char* tag) {
    const std::vector<const Element*> found = object.nested(tag);
    if (found.size() > 1)
        throw input_error(object.place(), fmt::format("{} nested <{}> elements in a shape, "
                                                      "expected one",
                                                      found.size(), tag));
    return found.empty() ? nullptr : found.front();
}

}  // namespace

ShapeReader::Source ShapeReader::read_source(Object& object) {
    Source source;
    source.type = object.type();
    source.flip_normals = object.boolean("flip_normals", false);
    source.to_world = object.transform("to_world");
    if (is_mesh_file(source.type)) {
        source.path = object.file().string();
        source.face_normals = object.boolean("face_normals", false);
        source.flip_v = object.boolean("flip_tex_coords", source.type == "obj");
    } else if (source.type == "sphere") {
        const glm::dvec3 centre = object.vector("center").value_or(glm::dvec3(0.0));
        const double radius = object.number("radius", 1.0);
        if (!(radius > 0.0))
            throw input_error(object.place(),
                              fmt::format("sphere of radius {}, expected more than 0", radius));
        source.to_world = glm::scale(glm::translate(source.to_world, centre), glm::dvec3(radius));
    }
    source.mirrored = check_mirroring(object, source.to_world);
    if (source.mirrored) source.to_world[0] = -source.to_world[0];
    return source;
}

void ShapeReader::read(const Element& element) {
    Object object(element, context_);
    if (!is_supported(object.type())) {
        context_.warnings.count(element, shape_unit,
                                "type " + quote(object.type()) + " is not supported, left out");
        return;
    }
    if (scene_.instances.size() + scene_.medium_boundaries.size() >= limits::max_nodes)
        throw input_error(object.place(), fmt::format("more than {} shapes", limits::max_nodes));
    const Source source = read_source(object);
    MediumBoundary boundary;
    boundary.interior = media_.index(object.find("interior"));
    boundary.exterior = media_.index(object.find("exterior"));
    const Element* const bsdf = single(object, "bsdf");
    const Element* const emitter = single(object, "emitter");
    const MitsubaSurface& surface = materials_.surface(bsdf);
    const std::uint32_t mesh = add_mesh(object, source, surface);
    count_triangles(object, mesh);
    if (!is_within_limits(scene_.meshes[mesh], source.to_world))
        throw input_error(object.place(),
                          "the shape reaches too far out, expected coordinates "
                          "below 1e15");
    if (surface.invisible && emitter != nullptr)
        context_.warnings.count(element, shape_unit,
                                "an emitter has a null bsdf, it is rendered as opaque");
    scene_.light_named = scene_.light_named || emitter != nullptr;
    if (!surface.invisible || emitter != nullptr) {
        const std::string& fallback = scene_.meshes[mesh].name;
        scene_.instances.push_back({object.id_or(fallback), mesh,
                                    materials_.material(bsdf, emitter), source.to_world,
                                    source.flip_normals});
    }
    if (boundary.interior >= 0 || boundary.exterior >= 0)
        add_boundary(object, source, mesh, surface, boundary);
    object.report_unused();
}

void ShapeReader::add_boundary(Object& object, const Source& source, std::uint32_t mesh,
                               const MitsubaSurface& surface, MediumBoundary boundary) {
    const bool see_through = surface.description && transmits(*surface.description);
    if (!surface.invisible && !see_through) {
        context_.warnings.count(object.element(), shape_unit,
                                "a medium behind an opaque surface is ignored");
        return;
    }
    boundary.mesh = mesh;
    boundary.to_world = source.to_world;
    if (!surface.invisible) boundary.surface = static_cast<int>(scene_.instances.size()) - 1;
    if (source.flip_normals) std::swap(boundary.interior, boundary.exterior);
    scene_.medium_boundaries.push_back(boundary);
}

void ShapeReader::count_triangles(Object& object, std::uint32_t mesh) {
    const std::size_t count = scene_.meshes[mesh].triangles.size();
    if (count > limits::max_triangles - triangles_)
        throw input_error(object.place(), fmt::format("more than {} triangles in the scene",
                                                      limits::max_triangles));
    triangles_ += count;
}

std::uint32_t ShapeReader::add_mesh(Object& object, const Source& source,
                                    const MitsubaSurface& surface) {
    const std::string key = fmt::format(
        "{}|{}|{}|{}|{}|{}|{}|{}", source.type, source.path, source.face_normals, source.flip_v,
        source.mirrored, surface.texture >= 0, surface.has_maps(), surface.has_direction());
    const auto shared = shared_meshes_.find(key);
    const bool plain_uvs = surface.to_uv == glm::dmat3(1.0);
    if (shared != shared_meshes_.end() && plain_uvs) return shared->second;
    Mesh mesh = make_mesh(object, source);
    const bool smooth = is_mesh_file(source.type) && !source.face_normals && mesh.normals.empty();
    if (smooth) add_smooth_normals(mesh, glm::dmat3(source.to_world));
    fit_texture(object, surface, mesh);
    const auto index = static_cast<std::uint32_t>(scene_.meshes.size());
    // Smooth normals depend on the transform.
    if (plain_uvs && !smooth) shared_meshes_.emplace(key, index);
    scene_.meshes.push_back(std::move(mesh));
    return index;
}

Mesh ShapeReader::read_mesh_file(Object& object, const Source& source) {
    Diagnostics& diagnostics = context_.warnings.diagnostics();
    Mesh mesh;
    if (source.type == "ply") {
        mesh = read_ply(source.path, object.place(), diagnostics);
        if (source.flip_v)
            for (glm::vec2& uv : mesh.uvs) uv.y = 1.0F - uv.y;
        // Mitsuba's surfaces use vertex colours only where a texture refers to them.
        mesh.colours.clear();
    } else {
        mesh = read_obj_mesh(source.path, object.place(), source.flip_v, diagnostics);
    }
    if (source.face_normals) mesh.normals.clear();
    if (mesh.triangles.empty())
        context_.warnings.count(object.element(), shape_unit,
                                source.type == "ply" ? "the PLY file holds no triangles"
                                                     : "the OBJ file holds no triangles");
    return mesh;
}

Mesh ShapeReader::make_mesh(Object& object, const Source& source) {
    Mesh mesh;
    if (is_mesh_file(source.type)) {
        mesh = read_mesh_file(object, source);
    } else if (source.type == "rectangle") {
        mesh = make_rectangle();
    } else if (source.type == "cube") {
        mesh = make_cube();
    } else if (source.type == "sphere") {
        mesh = make_sphere();
    } else {
        mesh = make_disk();
    }
    if (source.mirrored) mirror_mesh(mesh);
    if (source.type == "sphere") {
        // A mirrored sphere faces inwards in Mitsuba, unlike every other shape with normals.
        if (source.mirrored)
            for (glm::vec3& normal : mesh.normals) normal = -normal;
    } else {
        orient_by_normals(mesh);
    }
    return mesh;
}

void ShapeReader::fit_texture(Object& object, const MitsubaSurface& surface, Mesh& mesh) {
    const bool described = surface.has_maps();
    const bool bare = mesh.uvs.empty();
    if (surface.texture < 0 && !described) {
        if (surface.has_direction() && !bare) mesh.uv_sets = {mesh.uvs};
        return;
    }
    if (bare && !add_barycentric_uvs(mesh))
        throw input_error(object.place(),
                          "too many triangles for a texture without texture "
                          "coordinates, expected a smaller mesh");
    if (described) mesh.uv_sets = {mesh.uvs};
    if (surface.texture >= 0)
        transform_uvs(mesh, surface.to_uv);
    else if (bare)
        mesh.uvs.clear();
}

}  // namespace weft::mitsuba
