// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/export_scene/exported_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "bench/common/machine.h"
#include "bench/export_scene/exported_surfaces.h"
#include "scene/field_of_view.h"

namespace weft::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie");

constexpr std::uint32_t no_vertex = 0xFFFFFFFFU;

glm::dvec3 world_point(const FlatScene& flat, const shared::float4& p) {
    return glm::dvec3(p.x, p.y, p.z) / flat.units.scale + flat.units.centre;
}

/// Values of one vertex, appended where the scene has such an attribute.
void append(const std::vector<float>& from, std::size_t vertex, std::size_t width,
            std::vector<float>& to) {
    if (from.empty()) return;
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(width * vertex);
    to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(width));
}

bool has_normal(const FlatScene& flat, std::uint32_t vertex) {
    if (flat.normals.empty()) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (flat.normals[3 * vertex + k] != 0.0F) return true;
    return false;
}

/// Gathers triangles into meshes. The vertices of the scene are numbered anew in each mesh.
class MeshGatherer {
  public:
    MeshGatherer(const Scene& scene, const FlatScene& flat) : scene_(scene), flat_(flat) {
        for (const Material& material : scene.materials)
            coordinates_.push_back(surface_coordinates(material));
    }

    void add(const shared::Triangle& triangle) {
        if (!(triangle_area(flat_, triangle) > 0.0)) return;
        const std::uint32_t vertices[3] = {triangle.v0, triangle.v1, triangle.v2};
        bool smooth = true;
        for (const std::uint32_t vertex : vertices) smooth &= has_normal(flat_, vertex);
        const std::uint32_t material = flat_.instances[triangle.instance].material;
        Numbered& mesh = meshes_[{material, smooth}];
        mesh.mesh.material = material;
        for (const std::uint32_t vertex : vertices)
            mesh.mesh.triangles.push_back(number_of(mesh, triangle.instance, vertex, smooth));
    }

    [[nodiscard]] std::vector<ExportedMesh> take() {
        std::vector<ExportedMesh> taken;
        for (auto& [key, numbered] : meshes_) {
            ExportedMesh& mesh = numbered.mesh;
            // Attributes that change nothing would cost other renderers time.
            if (!has_described_surface(scene_.materials[mesh.material]) &&
                flat_.materials[mesh.material].texture == INVALID_INDEX)
                mesh.uvs.clear();
            const auto plain = [](float value) { return value == 1.0F; };
            if (std::all_of(mesh.colours.begin(), mesh.colours.end(), plain)) mesh.colours.clear();
            taken.push_back(std::move(mesh));
        }
        return taken;
    }

  private:
    struct Numbered {
        ExportedMesh mesh;
        std::map<std::uint32_t, std::uint32_t> numbers;  ///< by vertex of the scene
    };

    /// The coordinates of a vertex that the maps of the instance's surface have.
    void append_uv(std::uint32_t instance, std::uint32_t vertex, std::vector<float>& uvs) const {
        const std::uint32_t material = flat_.instances[instance].material;
        if (!has_described_surface(scene_.materials[material])) {
            append(flat_.texture_coordinates, vertex, 2, uvs);
            return;
        }
        const std::optional<SurfaceCoordinates>& wanted = coordinates_[material];
        if (!wanted) return;
        const std::uint32_t to_first =
            flat_.surfaces.of_instances[instance * SURFACE_INSTANCE_WORDS + wanted->uv_set];
        const std::size_t at = 2 * static_cast<std::size_t>(to_first + vertex);
        const glm::dvec3 own(flat_.surfaces.coordinates[at], flat_.surfaces.coordinates[at + 1],
                             1.0);
        const glm::vec3 uv(wanted->to_uv * own);
        uvs.insert(uvs.end(), {uv.x, uv.y});
    }

    std::uint32_t number_of(Numbered& numbered, std::uint32_t instance, std::uint32_t vertex,
                            bool smooth) {
        ExportedMesh& mesh = numbered.mesh;
        const auto next = static_cast<std::uint32_t>(mesh.positions.size() / 3);
        const auto [entry, is_new] = numbered.numbers.try_emplace(vertex, next);
        if (!is_new) return entry->second;
        const glm::vec3 p(world_point(flat_, flat_.positions[vertex]));
        mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
        if (smooth) append(flat_.normals, vertex, 3, mesh.normals);
        append_uv(instance, vertex, mesh.uvs);
        append(flat_.vertex_colours, vertex, 3, mesh.colours);
        return next;
    }

    const Scene& scene_;
    const FlatScene& flat_;
    std::vector<std::optional<SurfaceCoordinates>> coordinates_;  ///< by material
    std::map<std::pair<std::uint32_t, bool>, Numbered> meshes_;   ///< by material, with normals?
};

json colour_json(const shared::float4& c) {
    return {c.x, c.y, c.z};
}
json vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
json vector_json(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

/// Names of files in a folder, each written as soon as it is named.
class ArrayFolder {
  public:
    explicit ArrayFolder(fs::path folder) : folder_(std::move(folder)) {}

    /// Null for an empty array.
    template <typename T>
    json write(const std::string& name, const std::vector<T>& values) const {
        if (values.empty()) return nullptr;
        write_file_atomically(folder_ / name, std::as_bytes(std::span(values)));
        return name;
    }

  private:
    fs::path folder_;
};

json mesh_json(const ArrayFolder& folder, const std::string& stem, const ExportedMesh& mesh) {
    return {{"vertex_count", mesh.positions.size() / 3},
            {"triangle_count", mesh.triangles.size() / 3},
            {"positions", folder.write(stem + "-positions.f32", mesh.positions)},
            {"normals", folder.write(stem + "-normals.f32", mesh.normals)},
            {"uvs", folder.write(stem + "-uvs.f32", mesh.uvs)},
            {"colours", folder.write(stem + "-colours.f32", mesh.colours)},
            {"triangles", folder.write(stem + "-triangles.u32", mesh.triangles)}};
}

json meshes_json(const ArrayFolder& folder, const Scene& scene, const FlatScene& flat) {
    json list = json::array();
    for (const ExportedMesh& mesh : exported_meshes(scene, flat)) {
        list.push_back(mesh_json(folder, fmt::format("mesh-{}", list.size()), mesh));
        list.back()["material"] = mesh.material;
    }
    return list;
}

json materials_json(const Scene& scene, const FlatScene& flat) {
    json list = json::array();
    for (std::size_t m = 0; m < flat.materials.size(); ++m) {
        const shared::MaterialRecord& record = flat.materials[m];
        json texture;
        if (record.texture != INVALID_INDEX) texture = record.texture;
        const bool emits = (record.flags & MATERIAL_EMITS) != 0;
        list.push_back(
            {{"name", scene.materials[m].name},
             {"lambertian",
              is_lambertian(scene.materials[m]) && !has_described_surface(scene.materials[m])},
             {"surface", exported_surface(scene.materials[m])},
             {"reflectance", colour_json(record.albedo)},
             {"texture", texture},
             {"radiance", emits ? colour_json(record.emission) : json{0, 0, 0}},
             {"textured_emission", emits && record.emission_texture != INVALID_INDEX},
             {"emits_both_sides", emits && (record.flags & MATERIAL_EMITS_BOTH_SIDES) != 0},
             {"two_sided", (record.flags & MATERIAL_TWO_SIDED) != 0}});
    }
    return list;
}

json textures_json(const ArrayFolder& folder, const Scene& scene, const FlatScene& flat) {
    const auto name_of = [](Wrap wrap) {
        return wrap == Wrap::repeat ? "repeat" : wrap == Wrap::clamp ? "clamp" : "mirror";
    };
    json list = json::array();
    for (std::size_t t = 0; t < flat.textures.size(); ++t) {
        const Texture& texture = scene.textures[t];
        list.push_back({{"file", folder.write(fmt::format("texture-{}.rgba8", t), texture.rgba)},
                        {"width", texture.width},
                        {"height", texture.height},
                        {"srgb", texture.srgb},
                        {"nearest", texture.nearest},
                        {"wrap_u", name_of(texture.wrap_u)},
                        {"wrap_v", name_of(texture.wrap_v)}});
    }
    return list;
}

json lights_json(const Scene& scene) {
    json list = json::array();
    for (const PunctualLight& light : scene.lights) {
        if (!(luminance(light.intensity) > 0.0)) continue;
        const char* const type = light.type == LightType::point  ? "point"
                                 : light.type == LightType::spot ? "spot"
                                                                 : "directional";
        list.push_back({{"type", type},
                        {"position", vector_json(light.position)},
                        {"direction", vector_json(light.direction)},
                        {"intensity", vector_json(light.intensity)},
                        {"cos_inner", light.cos_inner},
                        {"cos_outer", light.cos_outer},
                        {"linear_edge", light.linear_edge}});
    }
    return list;
}

/// Number of the medium at a point that these boundaries enclose, or null: the smallest counts.
json medium_within(const FlatMedia& media, std::uint32_t boundaries) {
    if (!media.present()) return nullptr;
    const std::uint32_t medium =
        boundaries == 0 ? media.space.outside : media.space.interior[std::countr_zero(boundaries)];
    return medium == NO_MEDIUM ? json() : json(medium);
}

json media_json(const FlatScene& flat) {
    json list = json::array();
    for (const shared::MediumRecord& medium : flat.media.records) {
        const auto scaled = [&](const shared::float4& c) -> json {
            return {c.x * flat.units.scale, c.y * flat.units.scale, c.z * flat.units.scale};
        };
        list.push_back({{"extinction", scaled(medium.sigma_t)},
                        {"albedo", colour_json(medium.albedo)},
                        {"emission", scaled(medium.emission)},
                        {"anisotropy", medium.anisotropy},
                        {"homogeneous", medium.grid == INVALID_INDEX}});
    }
    return list;
}

/// The image of the environment, and what turns its frame to the world, by columns; null where
/// there is none.
json environment_image_json(const ArrayFolder& folder, const Scene& scene) {
    if (!scene.environment || scene.environment->image == nullptr) return nullptr;
    const EnvironmentImage& image = *scene.environment->image;
    json to_world = json::array();
    for (int column = 0; column < 3; ++column)
        to_world.push_back(vector_json(scene.environment->to_world[column]));
    return {{"file", folder.write("environment.f32", image.radiance)},
            {"width", image.width},
            {"height", image.height},
            {"rows_at_poles", image.rows_at_poles},
            {"to_world", to_world}};
}

json boundaries_json(const ArrayFolder& folder, const FlatScene& flat) {
    json list = json::array();
    for (const ExportedMesh& mesh : exported_boundaries(flat)) {
        const auto number = static_cast<std::uint32_t>(list.size());
        list.push_back(mesh_json(folder, fmt::format("boundary-{}", number), mesh));
        const std::uint32_t bit = 1U << number;
        list.back()["interior"] = medium_within(flat.media, bit);
        list.back()["exterior"] = nullptr;
        if (mesh.positions.empty()) continue;
        const glm::dvec3 vertex(mesh.positions[0], mesh.positions[1], mesh.positions[2]);
        const std::uint32_t around = boundaries_around(flat.media, flat.units.point(vertex));
        // Only those with larger volumes are about this one; smaller ones lie inside.
        list.back()["exterior"] = medium_within(flat.media, around & ~(bit | (bit - 1U)));
    }
    return list;
}

/// The camera as kernels use it: rigid, its axes of unit length.
json camera_json(const Camera& camera, const FilmSize& size) {
    const glm::dmat3 axes(camera.to_world);
    const glm::dvec3 backward = glm::normalize(axes[2]);
    const glm::dvec3 right = glm::normalize(axes[0] - glm::dot(axes[0], backward) * backward);
    const glm::dvec3 up = glm::normalize(axes[1] - glm::dot(axes[1], backward) * backward -
                                         glm::dot(axes[1], right) * right);
    const double tangent = vertical_tangent(
        camera, static_cast<double>(size.width) / static_cast<double>(size.height));
    return {{"name", camera.name},
            {"position", vector_json(glm::dvec3(camera.to_world[3]))},
            {"right", vector_json(right)},
            {"up", vector_json(up)},
            {"backward", vector_json(backward)},
            {"vertical_fov", 2.0 * std::atan(tangent)},
            {"mirror_x", camera.mirror_x},
            {"size", {size.width, size.height}},
            {"lens_radius", 0.0}};
}

}  // namespace

std::vector<ExportedMesh> exported_meshes(const Scene& scene, const FlatScene& flat) {
    MeshGatherer gatherer(scene, flat);
    for (const shared::Triangle& triangle : flat.triangles) gatherer.add(triangle);
    return gatherer.take();
}

std::vector<ExportedMesh> exported_boundaries(const FlatScene& flat) {
    std::vector<ExportedMesh> meshes(flat.media.space.boundaries);
    std::vector<std::uint32_t> numbers(flat.media.positions.size(), no_vertex);
    for (const shared::Triangle& triangle : flat.media.triangles) {
        // No two boundaries share a vertex, so that one list of numbers serves all of them.
        ExportedMesh& mesh = meshes[triangle.instance];
        for (const std::uint32_t vertex : {triangle.v0, triangle.v1, triangle.v2}) {
            if (numbers[vertex] == no_vertex) {
                numbers[vertex] = static_cast<std::uint32_t>(mesh.positions.size() / 3);
                const glm::vec3 p(world_point(flat, flat.media.positions[vertex]));
                mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
            }
            mesh.triangles.push_back(numbers[vertex]);
        }
    }
    return meshes;
}

void write_exported_scene(const fs::path& folder, const Scene& scene, const FlatScene& flat,
                          const Camera& camera, const FilmSize& size) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Error(ExitCode::output, folder.string(), "cannot be made, " + error.message());
    const ArrayFolder arrays(folder);
    const glm::dvec3 eye(camera.to_world[3]);
    const std::uint32_t around = boundaries_around(flat.media, flat.units.point(eye));
    write_json(folder / "scene.json",
               {{"weft_scene_export", 1},
                {"scene", fs::path(scene.source).filename().string()},
                {"camera", camera_json(camera, size)},
                {"materials", materials_json(scene, flat)},
                {"textures", textures_json(arrays, scene, flat)},
                {"meshes", meshes_json(arrays, scene, flat)},
                {"lights", lights_json(scene)},
                {"environment", vector_json(flat.environment)},
                {"environment_image", environment_image_json(arrays, scene)},
                {"media", media_json(flat)},
                {"boundaries", boundaries_json(arrays, flat)},
                {"camera_medium", medium_within(flat.media, around)},
                {"radius", static_cast<double>(flat.radius) / flat.units.scale},
                {"centre", vector_json(flat.units.centre)}});
}

}  // namespace weft::bench
