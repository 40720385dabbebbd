// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/flat_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "base/error.h"
#include "base/limits.h"
#include "scene/emission_means.h"
#include "scene/mean_albedo.h"
#include "scene/mip_levels.h"
#include "scene/shown_parts.h"

namespace weft {
namespace {

/// Which optional attributes any instance of the scene has.
struct Attributes {
    bool normals = false;
    bool uvs = false;
    bool emission_textures = false;
    bool surface_textures = false;  ///< of materials that are more than diffuse
    bool colours = false;
    bool one_sided = false;
    bool lobes = false;  ///< other than Lambert's
};

Attributes attributes_of(const Scene& scene) {
    Attributes found;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const Material& material = scene.materials[instance.material];
        if (mesh.triangles.empty()) continue;
        found.normals |= !mesh.normals.empty();
        found.emission_textures |= material.emission.texture >= 0;
        found.uvs |=
            (!mesh.uvs.empty() && albedo_texture(material) >= 0) || material.emission.texture >= 0;
        found.surface_textures |=
            material.description.has_value() && !texture_maps(*material.description).empty();
        found.colours |= !mesh.colours.empty();
        found.one_sided |= !material.two_sided;
        found.lobes |= !is_lambertian(material);
    }
    return found;
}

/// Box of placed triangles.
struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const Mesh& mesh, const glm::dmat4& to_world) {
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t vertex : triangle)
                add(glm::dvec3(to_world * glm::dvec4(glm::dvec3(mesh.positions[vertex]), 1.0)));
    }
    /// The unit cube.
    void add_cube(const glm::dmat4& to_world) {
        for (int corner = 0; corner < 8; ++corner)
            add(glm::dvec3(to_world *
                           glm::dvec4(corner & 1, corner >> 1 & 1, corner >> 2 & 1, 1.0)));
    }
    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
};

KernelUnits kernel_units(const Scene& scene) {
    Extent extent;
    for (const Instance& instance : scene.instances)
        extent.add(scene.meshes[instance.mesh], instance.to_world);
    // Where there are surfaces their precision matters, however large the media about them.
    if (extent.empty()) {
        for (const MediumBoundary& boundary : scene.medium_boundaries)
            extent.add(scene.meshes[boundary.mesh], boundary.to_world);
        for (const Medium& medium : scene.media)
            if (medium.grid >= 0) extent.add_cube(medium.grid_to_world);
    }
    KernelUnits units;
    if (extent.empty()) return units;
    units.centre = 0.5 * (extent.low + extent.high);
    const glm::dvec3 half = 0.5 * (extent.high - extent.low);
    const double largest = std::max(half.x, std::max(half.y, half.z));
    // With a larger exponent the scale itself would overflow.
    constexpr int most = 1000;
    if (largest > 0.0) units.scale = std::ldexp(1.0, std::min(-std::ilogb(largest), most));
    return units;
}

/// Which vertices of a mesh a triangle uses.
std::vector<bool> used_vertices(const Mesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle) used[vertex] = true;
    return used;
}

/// Places the vertices of an instance from `first` on, where there is room for them. Those that no
/// triangle uses go to the centre: they must not count for the scene's extent, nor become infinite
/// in its units. So do those of an instance that is absent.
void place_vertices(const Mesh& mesh, const Instance& instance, std::size_t first,
                    FlatScene& flat) {
    const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(instance.to_world)));
    const double side = instance.flip_normals ? -1.0 : 1.0;
    const std::vector<bool> used = used_vertices(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        glm::vec3 p(0.0F);
        if (used[i] && instance.present)
            p = flat.units.point(
                glm::dvec3(instance.to_world * glm::dvec4(glm::dvec3(mesh.positions[i]), 1.0)));
        flat.positions[first + i] = {p.x, p.y, p.z, 0.0F};
        if (flat.normals.empty()) continue;
        glm::dvec3 n(0.0);
        if (!mesh.normals.empty()) n = side * (normal_matrix * glm::dvec3(mesh.normals[i]));
        const double length = glm::length(n);
        if (length > 0.0) n /= length;
        for (int k = 0; k < 3; ++k)
            flat.normals[3 * (first + i) + static_cast<std::size_t>(k)] = static_cast<float>(n[k]);
    }
}

/// Writes the triangles of an instance where there is room for them.
void place_triangles(const Mesh& mesh, const Instance& instance, std::uint32_t index,
                     FlatScene& flat) {
    // A mirroring transform reverses the winding; undone here, so that the outside stays outside.
    const bool mirrored = glm::determinant(glm::dmat3(instance.to_world)) < 0.0;
    const bool swap = mirrored != instance.flip_normals;
    const std::uint32_t base = flat.ranges[index].first_vertex;
    std::size_t at = flat.instances[index].first_triangle;
    for (const auto& t : mesh.triangles)
        flat.triangles[at++] = {base + t[0], base + t[swap ? 2 : 1], base + t[swap ? 1 : 2], index};
}

void append_instance(const Scene& scene, std::uint32_t index, const Attributes& attributes,
                     FlatScene& flat) {
    const Instance& instance = scene.instances[index];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const std::size_t first = flat.positions.size();
    const std::size_t first_triangle = flat.triangles.size();
    if (first + mesh.positions.size() > limits::max_vertices ||
        first_triangle + mesh.triangles.size() > limits::max_triangles)
        throw input_error(scene.source, "the instances together have too many triangles");
    flat.ranges[index] = {static_cast<std::uint32_t>(first),
                          static_cast<std::uint32_t>(mesh.positions.size()),
                          static_cast<std::uint32_t>(first_triangle),
                          static_cast<std::uint32_t>(mesh.triangles.size())};
    flat.instances[index] = {instance.material, static_cast<std::uint32_t>(first_triangle),
                             INVALID_INDEX, 0};
    flat.positions.resize(first + mesh.positions.size());
    if (attributes.normals) flat.normals.resize(3 * flat.positions.size());
    flat.triangles.resize(first_triangle + mesh.triangles.size());
    place_vertices(mesh, instance, first, flat);
    place_triangles(mesh, instance, index, flat);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (attributes.uvs)
            for (int k = 0; k < 2; ++k)
                flat.texture_coordinates.push_back(mesh.uvs.empty() ? 0.0F : mesh.uvs[i][k]);
        if (attributes.colours)
            for (int k = 0; k < 3; ++k)
                flat.vertex_colours.push_back(mesh.colours.empty() ? 1.0F : mesh.colours[i][k]);
    }
}

void append_instances(const Scene& scene, const Attributes& attributes, FlatScene& flat) {
    flat.instances.resize(scene.instances.size());
    flat.ranges.resize(scene.instances.size());
    for (const bool moving : {false, true}) {
        if (moving) {
            flat.first_moving_vertex = static_cast<std::uint32_t>(flat.positions.size());
            flat.first_moving_triangle = static_cast<std::uint32_t>(flat.triangles.size());
        }
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (scene.instances[i].may_move == moving) append_instance(scene, i, attributes, flat);
    }
}

/// Appends the texture coordinates of emission where they are not those of the surface, and
/// measures the emission of triangles.
void append_emission(const Scene& scene, FlatScene& flat) {
    flat.emission_means.resize(scene.instances.size());
    const auto texture_of = [&](std::size_t instance) {
        return scene.materials[scene.instances[instance].material].emission.texture;
    };
    // One texture after the other, since the averages of one take much memory.
    std::vector<std::size_t> order(scene.instances.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return texture_of(a) < texture_of(b); });
    EmissionMeans means(scene);
    for (const std::size_t i : order)
        if (texture_of(i) >= 0)
            flat.emission_means[i] = means.of(scene.meshes[scene.instances[i].mesh], texture_of(i));
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
        if (texture_of(i) < 0 || mesh.emission_uvs.empty()) continue;
        const auto end = static_cast<std::uint32_t>(flat.texture_coordinates.size() / 2);
        flat.instances[i].emission_uv = end - flat.ranges[i].first_vertex;
        for (const glm::vec2& uv : mesh.emission_uvs)
            flat.texture_coordinates.insert(flat.texture_coordinates.end(), {uv.x, uv.y});
    }
}

void append_textures(const Scene& scene, const std::vector<bool>& shown, FlatScene& flat) {
    std::size_t texels = 0;
    for (std::size_t t = 0; t < scene.textures.size(); ++t)
        if (shown[t]) texels += mip_texels(scene.textures[t].width, scene.textures[t].height);
    flat.texels.reserve(texels);
    for (std::size_t t = 0; t < scene.textures.size(); ++t) {
        const Texture& texture = scene.textures[t];
        shared::TextureRecord record{static_cast<std::uint32_t>(flat.texels.size()), texture.width,
                                     texture.height, 0};
        record.flags = (texture.nearest ? TEXTURE_NEAREST : 0U) |
                       (texture.srgb ? TEXTURE_SRGB : 0U) |
                       static_cast<std::uint32_t>(texture.wrap_u) << TEXTURE_WRAP_U_SHIFT |
                       static_cast<std::uint32_t>(texture.wrap_v) << TEXTURE_WRAP_V_SHIFT;
        if (shown[t]) append_mip_levels(texture, flat.texels);
        flat.textures.push_back(record);
    }
}

shared::MaterialRecord material_record(const Material& material,
                                       std::span<const TextureStatistics> statistics,
                                       bool textures) {
    shared::MaterialRecord record{};
    record.lobe = lobe_of(material);
    const glm::vec3 albedo = mean_albedo(material, statistics);
    record.albedo = {albedo.r, albedo.g, albedo.b, 0.0F};
    const int texture = albedo_texture(material);
    record.texture = textures && texture >= 0 ? static_cast<std::uint32_t>(texture) : INVALID_INDEX;
    const glm::vec4 parameters =
        std::visit([](const auto& surface) { return lobe_parameters(surface); }, material.surface);
    record.parameters = {parameters.x, parameters.y, parameters.z, parameters.w};
    const glm::vec3& radiance = material.emission.radiance;
    record.emission = {radiance.r, radiance.g, radiance.b, 0.0F};
    record.emission_texture = textures && material.emission.texture >= 0
                                  ? static_cast<std::uint32_t>(material.emission.texture)
                                  : INVALID_INDEX;
    record.flags = (material.two_sided ? MATERIAL_TWO_SIDED : 0U) |
                   (luminance(radiance) > 0.0 ? MATERIAL_EMITS : 0U) |
                   (material.emission.both_sides ? MATERIAL_EMITS_BOTH_SIDES : 0U);
    return record;
}

std::vector<double> texture_means(const Scene& scene, std::span<const TextureStatistics> textures) {
    std::vector<double> means;
    for (const Material& material : scene.materials) {
        const int texture = albedo_texture(material);
        means.push_back(
            texture >= 0 ? textures[static_cast<std::size_t>(texture)].mean_of(Channel::luminance)
                         : 1.0);
    }
    return means;
}

/// Adds the areas of triangles to those of their materials.
void add_areas(const FlatScene& flat, std::span<const shared::Triangle> triangles,
               std::vector<double>& areas) {
    for (const shared::Triangle& triangle : triangles)
        areas[flat.instances[triangle.instance].material] += triangle_area(flat, triangle);
}

struct SurfaceMeans {
    double area = 0.0;
    double reflectance = 0.0;
};

SurfaceMeans mean_surfaces(const FlatScene& flat) {
    std::vector<double> areas = flat.resting_areas;
    add_areas(flat, std::span(flat.triangles).subspan(flat.first_moving_triangle), areas);
    SurfaceMeans means;
    double reflected = 0.0;
    for (std::size_t m = 0; m < areas.size(); ++m) {
        means.area += areas[m];
        const shared::float4& albedo = flat.materials[m].albedo;
        reflected += areas[m] * luminance({albedo.x, albedo.y, albedo.z}) * flat.texture_means[m];
    }
    if (means.area > 0.0) means.reflectance = std::clamp(reflected / means.area, 0.0, 1.0);
    return means;
}

/// Grows `extent` and `radius` to hold vertices.
void grow(std::span<const shared::float4> vertices, double& extent, double& radius) {
    for (const shared::float4& p : vertices) {
        const glm::dvec3 q(p.x, p.y, p.z);
        radius = std::max(radius, glm::length(q));
        extent = std::max({extent, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    }
}

/// Measures the largest coordinate and distance of all vertices. Where some may move these change
/// in steps, so that light paths and offsets, which depend on them, rarely change for that alone.
void measure_extent(FlatScene& flat) {
    double extent = flat.resting_extent;
    double radius = flat.resting_radius;
    const auto moving = std::span(flat.positions).subspan(flat.first_moving_vertex);
    grow(moving, extent, radius);
    constexpr double steps = 8.0;  // of the radius, each time it doubles
    if (!moving.empty() && radius > 0.0) {
        extent = std::exp2(std::ceil(std::log2(extent)));
        radius = std::exp2(std::ceil(steps * std::log2(radius)) / steps);
    }
    flat.radius = static_cast<float>(radius > 0.0 ? radius * 1.001 : 1.0);
    flat.extent = static_cast<float>(extent > 0.0 ? extent : 1.0);
}

/// Sets which boundaries of media are around each light: for an area light, around the middle of
/// the first of its triangles that shines.
void put_lights_in_media(FlatScene& flat) {
    const auto vector = [](const shared::float4& v) { return glm::dvec3(v.x, v.y, v.z); };
    for (shared::LightRecord& light : flat.lights) {
        glm::dvec3 centre = vector(light.position);
        if (light.kind == EMITTER_DIRECTIONAL || light.kind == EMITTER_ENVIRONMENT) continue;
        if (light.kind == EMITTER_AREA) {
            const auto entries = std::span(flat.emissive).subspan(light.first, light.count);
            const auto shining =
                std::find_if(entries.begin(), entries.end(),
                             [](const auto& entry) { return entry.probability > 0.0F; });
            const shared::Triangle& t =
                flat.triangles[(shining == entries.end() ? entries.front() : *shining).triangle];
            centre = (vector(flat.positions[t.v0]) + vector(flat.positions[t.v1]) +
                      vector(flat.positions[t.v2])) /
                     3.0;
        }
        light.enclosing_media = boundaries_around(flat.media, centre);
    }
}

}  // namespace

double triangle_area(const FlatScene& flat, const shared::Triangle& t) {
    const auto vertex = [&](std::uint32_t i) {
        const shared::float4& p = flat.positions[i];
        return glm::dvec3(p.x, p.y, p.z);
    };
    const glm::dvec3 a = vertex(t.v0);
    return 0.5 * glm::length(glm::cross(vertex(t.v1) - a, vertex(t.v2) - a));
}

FlatScene flatten(const Scene& scene) {
    FlatScene flat;
    flat.units = kernel_units(scene);
    const Attributes attributes = attributes_of(scene);
    append_instances(scene, attributes, flat);
    const std::vector<bool> shown = shown_textures(scene);
    flat.texture_statistics = measure_textures(scene.textures, shown);
    if (attributes.uvs || attributes.surface_textures) append_textures(scene, shown, flat);
    if (attributes.emission_textures) append_emission(scene, flat);
    for (const Material& material : scene.materials)
        flat.materials.push_back(
            material_record(material, flat.texture_statistics, attributes.uvs));
    flat.features = (attributes.uvs ? FEATURE_TEXTURES : 0U) |
                    (attributes.colours ? FEATURE_VERTEX_COLOURS : 0U) |
                    (attributes.normals ? FEATURE_SMOOTH_NORMALS : 0U) |
                    (attributes.one_sided ? FEATURE_ONE_SIDED : 0U) |
                    (attributes.lobes ? FEATURE_LOBES : 0U) |
                    (attributes.emission_textures ? FEATURE_EMISSION_TEXTURES : 0U);
    flat.surfaces = flatten_surfaces(scene, flat);
    if (flat.surfaces.present())
        flat.features |= FEATURE_MATERIALS | (flat.surfaces.see_through ? FEATURE_SEE_THROUGH : 0U);
    flat.texture_means = texture_means(scene, flat.texture_statistics);
    flat.resting_areas.resize(scene.materials.size());
    add_areas(flat, std::span(flat.triangles).first(flat.first_moving_triangle),
              flat.resting_areas);
    const SurfaceMeans means = mean_surfaces(flat);
    flat.surface_area = means.area;
    flat.mean_reflectance = means.reflectance;
    flat.first_mean_reflectance = means.reflectance;
    grow(std::span(flat.positions).first(flat.first_moving_vertex), flat.resting_extent,
         flat.resting_radius);
    measure_extent(flat);
    if (scene.environment && scene.environment->image)
        flat.environment_image =
            flatten_environment(*scene.environment->image, scene.environment->to_world);
    build_light_table(scene, flat);
    flat.media = flatten_media(scene, flat.units);
    if (flat.media.present()) put_lights_in_media(flat);
    link_boundaries(scene, flat.media, flat.surfaces);
    return flat;
}

void update_flat(const Scene& scene, FlatScene& flat) {
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        flat.instances[i].light = INVALID_INDEX;
        if (!instance.may_move) continue;
        const Mesh& mesh = scene.meshes[instance.mesh];
        place_vertices(mesh, instance, flat.ranges[i].first_vertex, flat);
        place_triangles(mesh, instance, i, flat);
        if (!flat.surfaces.tangents.empty())
            place_tangents(scene, i, flat.ranges[i].first_vertex, flat.surfaces);
    }
    const bool textures = !flat.texture_coordinates.empty();
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
        flat.materials[m] = material_record(scene.materials[m], flat.texture_statistics, textures);
    update_surfaces(scene, flat.texture_statistics, flat.surfaces);
    flat.mean_reflectance = mean_surfaces(flat).reflectance;
    measure_extent(flat);
    flat.lights.clear();
    flat.emissive.clear();
    flat.area_lights = 0;
    flat.environment = glm::vec3(0.0F);
    flat.features &= ~(FEATURE_AREA_LIGHTS | FEATURE_PUNCTUAL_LIGHTS | FEATURE_DIRECTIONAL_LIGHTS |
                       FEATURE_ENVIRONMENT | FEATURE_IMAGE_ENVIRONMENT | FEATURE_LIGHT_TREE);
    build_light_table(scene, flat);
    if (flat.media.present()) put_lights_in_media(flat);
}

}  // namespace weft
