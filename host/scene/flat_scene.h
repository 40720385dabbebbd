// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_FLAT_SCENE_H
#define WEFT_SCENE_FLAT_SCENE_H

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/flat_environment.h"
#include "scene/flat_media.h"
#include "scene/flat_surfaces.h"
#include "scene/scene.h"
#include "scene/texture_statistics.h"
#include "shared/shared_types.h"

namespace weft {

/// How scene units become kernel units: centred on the geometry and scaled by a power of two, so
/// that kernels compute with floats near 1 wherever and however large the scene is.
struct KernelUnits {
    glm::dvec3 centre{0.0};  ///< scene units
    double scale = 1.0;      ///< kernel units per scene unit, a power of two

    [[nodiscard]] glm::dvec3 point(const glm::dvec3& p) const { return (p - centre) * scale; }
};

/// Where the vertices and triangles of an instance lie among those of all.
struct InstanceRange {
    std::uint32_t first_vertex = 0;
    std::uint32_t vertices = 0;
    std::uint32_t first_triangle = 0;
    std::uint32_t triangles = 0;
};

/// A scene as kernels read it: instances flattened to one list of triangles, with one table of
/// lights. All in kernel units.
struct FlatScene {
    KernelUnits units;
    std::vector<shared::float4> positions;
    std::vector<shared::Triangle> triangles;
    std::vector<shared::InstanceRecord> instances;
    std::vector<shared::MaterialRecord> materials;
    std::vector<float> normals;  ///< 3 a vertex, 0 where a mesh has none; or empty
    /// 2 a vertex, then those for emission that differ (InstanceRecord::emission_uv); or empty.
    std::vector<float> texture_coordinates;
    std::vector<float> vertex_colours;  ///< 3 a vertex; or empty
    std::vector<shared::TextureRecord> textures;
    std::vector<std::uint32_t> texels;
    std::vector<shared::LightRecord> lights;  ///< area, point and spot, directional, environment
    std::vector<shared::EmissiveTriangle> emissive;
    /// The light tree that paths choose lights by; none where there is one light or none.
    std::vector<shared::LightNode> light_nodes;
    /// By instance: mean colours of the emission texture over its triangles; empty where it has
    /// none.
    std::vector<std::vector<glm::vec3>> emission_means;

    /// By instance. Vertices and triangles of those that may move follow all others.
    std::vector<InstanceRange> ranges;
    std::uint32_t first_moving_vertex = 0;    ///< positions.size() where nothing may move
    std::uint32_t first_moving_triangle = 0;  ///< likewise

    /// By instance, then by light without area, then of the environment: the power of each when it
    /// first emitted. Light paths choose lights by it, so that dimming one changes no path.
    std::vector<double> first_powers;

    FlatMedia media;
    FlatSurfaces surfaces;

    std::uint32_t area_lights = 0;
    std::uint32_t punctual_lights = 0;  ///< point and spot
    std::uint32_t directional_lights = 0;
    glm::vec3 environment{0.0F};  ///< radiance; of an image what it is multiplied with
    FlatEnvironment environment_image;
    std::uint32_t features = 0;     ///< FEATURE_* that the scene needs
    float extent = 1.0F;            ///< largest |coordinate| of geometry and lights, or above that
    float radius = 1.0F;            ///< of a bounding sphere about the centre
    double resting_extent = 0.0;    ///< largest |coordinate| of geometry that cannot move
    double resting_radius = 0.0;    ///< and its largest distance from the centre
    double surface_area = 0.0;      ///< of the scene as it was flattened
    double mean_reflectance = 0.0;  ///< area-weighted luminance of the albedo, [0, 1]
    /// The same when the scene was flattened. It decides the numbers of light paths, so that a
    /// surface that changes its colour changes no path.
    double first_mean_reflectance = 0.0;
    std::vector<TextureStatistics> texture_statistics;  ///< by texture of the scene
    std::vector<double> texture_means;  ///< by material, luminance, [0, 1]; 1 without texture
    std::vector<double> resting_areas;  ///< by material, of geometry that cannot move
    double smallest_light_area = 0.0;
};

/// Flattens a validated scene. Throws Error (exit code 2) where instances make too many triangles.
[[nodiscard]] FlatScene flatten(const Scene& scene);

/// Brings a flattened scene up to date with `scene`, the same scene at another time: the places of
/// instances that may move, materials and lights. Counts of vertices and triangles stay, and so do
/// the kernel units, the surface area, textures, media and the image of the environment.
void update_flat(const Scene& scene, FlatScene& flat);

/// Fills the light table from the flattened geometry; part of `flatten` and
/// `update_flat`.
void build_light_table(const Scene& scene, FlatScene& flat);

/// How many lights next-event estimation chooses from, the first ones of the table: all but an
/// environment of the same radiance everywhere.
[[nodiscard]] std::uint32_t choice_lights(const FlatScene& flat);

/// Area in kernel units squared.
[[nodiscard]] double triangle_area(const FlatScene& flat, const shared::Triangle& triangle);

/// 0.2126 R + 0.7152 G + 0.0722 B.
[[nodiscard]] inline double luminance(const glm::vec3& c) {
    return 0.2126 * static_cast<double>(c.r) + 0.7152 * static_cast<double>(c.g) +
           0.0722 * static_cast<double>(c.b);
}

}  // namespace weft

#endif
