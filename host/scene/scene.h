// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SCENE_H
#define WEFT_SCENE_SCENE_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/animation.h"
#include "scene/deformation.h"
#include "scene/density_grid.h"
#include "scene/environment_image.h"
#include "scene/material.h"

namespace weft {

enum class Wrap : std::uint32_t { repeat, clamp, mirror };

/// An image for a surface. `rgba` is row-major, top row first, 4 bytes a pixel; texture
/// coordinate v = 0 lies on the top edge of the first row.
struct Texture {
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;
    bool srgb = true;  ///< colour bytes are sRGB encoded; false: linear
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool nearest = false;    ///< nearest texel instead of bilinear interpolation
    bool has_alpha = false;  ///< some surface uses the fourth byte, which is linear
};

/// Triangles in object space. Attribute arrays are empty or as long as `positions`.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< shading normals; empty: geometric normals
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec2> emission_uvs;  ///< for the texture of emission; empty: `uvs`
    std::vector<glm::vec3> colours;       ///< linear, multiplied with the albedo
    std::vector<float> alphas;            ///< in [0, 1], multiplied with Opacity::alpha
    /// Sets of texture coordinates as the file has them, for the textures of a description.
    std::vector<std::vector<glm::vec2>> uv_sets;
    /// Tangents, for normal maps and lobes with a direction: xyz along which u grows, w the sign of
    /// the bitangent w (N x T).
    std::vector<glm::vec4> tangents;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// A mesh placed in the world with a material. The transform stays in double.
struct Instance {
    std::string name;
    std::uint32_t mesh = 0;
    std::uint32_t material = 0;
    glm::dmat4 to_world{1.0};
    bool flip_normals = false;  ///< the file reverses the orientation, or joints mirror it
    bool may_move = false;      ///< over the frames to be made; see pose_scene and SceneEdits
    bool present = true;        ///< false: its triangles exist, but shrink to a point
    Attachment motion{};        ///< the node that carries it over time, if any does
    int deformation = -1;       ///< index into Scene::deformations, which makes its mesh, or -1
};

enum class LightType : std::uint32_t { point, spot, directional };

/// A light without area.
struct PunctualLight {
    std::string name;
    LightType type = LightType::point;
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit, the way the light travels
    glm::vec3 intensity{1.0F};  ///< W/sr; for `directional` irradiance W/m^2 on a facing surface
    float cos_inner = 1.0F;     ///< spot: full intensity inside this cone
    float cos_outer = 0.0F;     ///< spot: dark outside this cone
    bool linear_edge = false;   ///< spot: falls off linearly with the angle between the cones, as
                                ///< in Mitsuba; false: as in glTF
    Attachment motion{};  ///< the node that carries it, if any; the light travels along its -z
};

/// Light from infinitely far away: the same from every direction, or that of an image.
struct Environment {
    glm::vec3 radiance{0.0F};                         ///< of an image: what it is multiplied with
    std::shared_ptr<const EnvironmentImage> image{};  ///< or null
    glm::dmat3 to_world{1.0};  ///< of an image: turns its frame, and may mirror it; orthogonal
};

enum class FovAxis : std::uint32_t { x, y, diagonal, smaller, larger };

/// A pinhole camera, or an orthographic one, all of whose rays are parallel. Camera space looks
/// along -z with +y up (the glTF convention).
struct Camera {
    std::string name;
    glm::dmat4 to_world{1.0};  ///< at rest; rigid up to scale; scale is ignored
    double fov = 0.8;          ///< radians, full angle along `fov_axis`
    FovAxis fov_axis = FovAxis::y;
    /// Of an orthographic camera half the width and height, in scene units, that its image shows at
    /// least, one of them above 0; of a pinhole camera both are 0.
    glm::dvec2 half_extent{0.0};
    double near_plane = 0.0;  ///< orthographic: what lies nearer is not seen, scene units
    bool mirror_x = false;    ///< the file's camera space is left-handed
    Attachment motion{};      ///< the node that carries it over time, if it moves

    [[nodiscard]] bool orthographic() const { return half_extent != glm::dvec2(0.0); }
};

/// A participating medium. Its extinction is `sigma_t` times `scale`, 1 / scene unit, times the
/// density of its grid where it has one; outside of the grid it is 0. So is `emission`, but without
/// `scale`. A grid of three channels gives each its own density; then `sigma_t` is grey and
/// `emission` 0.
struct Medium {
    std::string name;
    std::string type;  ///< "homogeneous" or "heterogeneous"
    glm::vec3 sigma_t{1.0F};
    glm::vec3 albedo{0.75F};
    glm::vec3 emission{0.0F};  ///< radiance per scene unit of a ray
    float scale = 1.0F;
    float anisotropy = 0.0F;        ///< Henyey-Greenstein g
    int grid = -1;                  ///< index into Scene::grids, or -1: the same everywhere
    glm::dmat4 grid_to_world{1.0};  ///< from the grid's unit cube; its own placement is part of it
    /// Index into Scene::grids of albedos in place of `albedo`, or -1: the same everywhere. The
    /// outermost voxels go on outside of the grid.
    int albedo_grid = -1;
    glm::dmat4 albedo_to_world{1.0};  ///< as `grid_to_world`
};

/// A closed boundary of a medium, invisible by itself. The interior is behind its normals.
struct MediumBoundary {
    std::uint32_t mesh = 0;
    glm::dmat4 to_world{1.0};
    int interior = -1;  ///< index into Scene::media, or -1
    int exterior = -1;
    /// Index into Scene::instances of a surface of the same mesh and place, which light goes
    /// through, or -1.
    int surface = -1;
};

/// The size of the image in the file.
struct FilmSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Everything a scene file holds, validated: indices are in range, numbers finite, transforms
/// invertible. Plain data without anything that concerns BVHs or devices.
struct Scene {
    std::string source;  ///< path it was read from
    std::vector<Texture> textures;
    std::vector<Material> materials;
    MaterialDetail detail = MaterialDetail::full;  ///< what was kept of them
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<PunctualLight> lights;
    std::optional<Environment> environment;
    std::vector<Camera> cameras;
    Animation animation;
    std::vector<Skin> skins;                ///< those that move vertices over time
    std::vector<Deformation> deformations;  ///< of meshes, which are at rest here
    std::vector<DensityGrid> grids;
    std::vector<Medium> media;
    std::vector<MediumBoundary> medium_boundaries;
    bool emptied_surfaces = false;  ///< media inside of surfaces have been left out
    int camera_medium = -1;  ///< medium around the cameras by the file: index into `media`, or -1;
                             ///< see flatten_media for when it is used
    int outer_medium = -1;   ///< outside of all boundaries: index into `media`, or -1
    std::optional<FilmSize> film;
    bool light_named = false;    ///< the file names an area light, perhaps one without power
    bool default_light = false;  ///< the last light is not the file's: default_light.h
    bool default_sky = false;    ///< nor is the environment
};

}  // namespace weft

#endif
