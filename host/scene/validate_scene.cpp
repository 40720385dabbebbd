// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/validate_scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/finite.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/validate_deformation.h"

namespace weft {
namespace {

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

bool in_unit_cube(const glm::vec3& v) {
    return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x <= 1 && v.y <= 1 && v.z <= 1;
}

bool not_negative(const glm::vec3& v) {
    return is_finite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0;
}

/// Throws at the first error; each check names the object in it.
class Validator {
  public:
    explicit Validator(const Scene& scene) : scene_(scene) {}

    void run() {
        for (const Texture& texture : scene_.textures) check(texture);
        for (const Material& material : scene_.materials) check(material);
        for (const Mesh& mesh : scene_.meshes) check(mesh);
        for (const Instance& instance : scene_.instances) check(instance);
        for (const PunctualLight& light : scene_.lights) check(light);
        for (const Camera& camera : scene_.cameras) check(camera, "");
        check(scene_.animation);
        validate_deformations(scene_);
        check_media();
        check_environment();
        if (scene_.environment && scene_.environment->image) check_environment_image();
        if (scene_.film) check(*scene_.film);
    }

    void run_pose(const std::string& when) const {
        for (const Material& material : scene_.materials) check(material);
        for (const Instance& instance : scene_.instances) {
            if (!instance.may_move) continue;
            const std::string object = "instance " + quote(instance.name) + when;
            check_transform(instance.to_world, object);
            const Mesh& mesh = scene_.meshes[instance.mesh];
            // The box is made by comparisons, which miss NaN.
            if (instance.deformation >= 0)
                require(all_finite(mesh.positions), object, "has a vertex that is not finite");
            if (!mesh.positions.empty()) check_extent(box_of(mesh), instance.to_world, object);
        }
        for (const PunctualLight& light : scene_.lights) check(light);
        check_environment();
    }

    void check(const Camera& camera, const std::string& when) const {
        const std::string object = "camera " + quote(camera.name) + when;
        check_transform(camera.to_world, object);
        const auto extent = [](double value) {
            return value >= 0.0 && value <= limits::max_coordinate;
        };
        require(extent(camera.half_extent.x) && extent(camera.half_extent.y) &&
                    extent(camera.near_plane),
                object, "has an extent or near plane that is negative or above 1e15");
        require(camera.fov > 0.0 && camera.fov < std::numbers::pi, object,
                "has a field of view outside (0, 180) degrees");
    }

  private:
    void require(bool holds, const std::string& object, const char* message) const {
        if (!holds) throw input_error(scene_.source, object + " " + message);
    }

    void check_environment() const {
        require(!scene_.environment || not_negative(scene_.environment->radiance), "environment",
                "has a radiance that is negative or not finite");
    }

    void check_environment_image() const {
        const EnvironmentImage& image = *scene_.environment->image;
        const std::string object = "environment " + quote(image.name);
        require(image.width > 0 && image.height > 0, object, "is empty");
        require(std::size_t{image.width} * image.height <= limits::max_environment_pixels, object,
                "is larger than the limit");
        require(image.radiance.size() == std::size_t{3} * image.width * image.height, object,
                "has the wrong number of values");
        require(std::all_of(image.radiance.begin(), image.radiance.end(),
                            [](float x) { return std::isfinite(x) && x >= 0.0F; }),
                object, "has a radiance that is negative or not finite");
        const glm::dmat3& turn = scene_.environment->to_world;
        const glm::dmat3 square = glm::transpose(turn) * turn;
        bool orthogonal = true;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                orthogonal = orthogonal && std::abs(square[i][j] - (i == j ? 1.0 : 0.0)) < 1e-6;
        require(orthogonal, object, "is distorted, expected a rotation");
    }

    void check(const Texture& texture) const {
        const std::string object = "texture " + quote(texture.name);
        require(texture.width > 0 && texture.height > 0, object, "is empty");
        require(
            texture.width <= limits::max_texture_edge && texture.height <= limits::max_texture_edge,
            object, "is larger than the limit");
        require(texture.rgba.size() == std::size_t{4} * texture.width * texture.height, object,
                "has the wrong number of bytes");
    }

    void check(const SurfaceDescription& surface, const std::string& object) const {
        const std::string problem = surface_problem(surface);
        require(problem.empty(), object, problem.c_str());
        for (const TextureMap* map : texture_maps(surface)) {
            require(static_cast<std::size_t>(map->texture) < scene_.textures.size(), object,
                    "refers to a texture that does not exist");
            require(map->uv_set < limits::max_uv_sets, object,
                    "refers to a set of texture coordinates that does not exist");
            for (int column = 0; column < 3; ++column)
                require(is_finite(glm::vec3(map->to_uv[column])), object,
                        "has a texture transform that is not finite");
        }
    }

    void check(const Material& material) const {
        const std::string object = "material " + quote(material.name);
        require(in_unit_cube(diffuse_albedo(material)), object, "has an albedo outside [0, 1]");
        if (const char* const problem = std::visit(
                [](const auto& surface) { return lobe_problem(surface); }, material.surface))
            throw input_error(scene_.source, object + " " + problem);
        if (material.description) check(*material.description, object);
        require(not_negative(material.emission.radiance), object,
                "has an emission that is negative or not finite");
        for (const int texture : {albedo_texture(material), material.emission.texture})
            require(texture >= -1 &&
                        (texture < 0 || static_cast<std::size_t>(texture) < scene_.textures.size()),
                    object, "refers to a texture that does not exist");
    }

    void check(const Mesh& mesh) {
        const std::string object = "mesh " + quote(mesh.name);
        const std::size_t count = mesh.positions.size();
        require(count <= limits::max_vertices, object, "has more vertices than the limit");
        require(mesh.normals.empty() || mesh.normals.size() == count, object,
                "has normals of the wrong number");
        for (const auto* uvs : {&mesh.uvs, &mesh.emission_uvs}) {
            require(uvs->empty() || uvs->size() == count, object,
                    "has texture coordinates of the wrong number");
            require(all_finite(*uvs), object, "has a texture coordinate that is not finite");
        }
        require(mesh.colours.empty() || mesh.colours.size() == count, object,
                "has vertex colours of the wrong number");
        require(mesh.tangents.empty() || mesh.tangents.size() == count, object,
                "has tangents of the wrong number");
        require(all_finite(mesh.tangents), object, "has a tangent that is not finite");
        require(mesh.alphas.empty() || mesh.alphas.size() == count, object,
                "has vertex alphas of the wrong number");
        require(std::all_of(mesh.alphas.begin(), mesh.alphas.end(),
                            [](float alpha) { return alpha >= 0.0F && alpha <= 1.0F; }),
                object, "has a vertex alpha outside [0, 1]");
        require(mesh.uv_sets.size() <= limits::max_uv_sets, object,
                "has more sets of texture coordinates than the limit");
        for (const std::vector<glm::vec2>& uvs : mesh.uv_sets) {
            require(uvs.size() == count, object, "has texture coordinates of the wrong number");
            require(all_finite(uvs), object, "has a texture coordinate that is not finite");
        }
        require(all_finite(mesh.positions), object, "has a vertex that is not finite");
        require(all_finite(mesh.normals), object, "has a normal that is not finite");
        require(std::all_of(mesh.colours.begin(), mesh.colours.end(), in_unit_cube), object,
                "has a vertex colour outside [0, 1]");
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t corner : triangle)
                require(corner < count, object, "has a triangle with a vertex that does not exist");
        boxes_.push_back(box_of(mesh));
    }

    static Box box_of(const Mesh& mesh) {
        Box box;
        for (const glm::vec3& position : mesh.positions) {
            box.low = glm::min(box.low, glm::dvec3(position));
            box.high = glm::max(box.high, glm::dvec3(position));
        }
        return box;
    }

    void check_transform(const glm::dmat4& to_world, const std::string& object) const {
        for (int column = 0; column < 4; ++column) {
            require(is_finite(to_world[column]), object, "has a transform that is not finite");
            require(to_world[column][3] == (column == 3 ? 1.0 : 0.0), object,
                    "has a transform that is not affine");
        }
        const double determinant = glm::determinant(glm::dmat3(to_world));
        require(std::isfinite(1.0 / determinant) && determinant != 0.0, object,
                "has a transform that cannot be inverted");
        require(within_bounds(glm::dvec3(to_world[3])), object, "lies too far from the origin");
    }

    static bool within_bounds(const glm::dvec3& point) {
        return std::abs(point.x) <= limits::max_coordinate &&
               std::abs(point.y) <= limits::max_coordinate &&
               std::abs(point.z) <= limits::max_coordinate;
    }

    /// A linear map takes its largest values at the corners of the mesh's box.
    void check_extent(const Box& box, const glm::dmat4& to_world, const std::string& object) const {
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point((corner & 1U) != 0 ? box.high.x : box.low.x,
                                   (corner & 2U) != 0 ? box.high.y : box.low.y,
                                   (corner & 4U) != 0 ? box.high.z : box.low.z);
            require(within_bounds(glm::dvec3(to_world * glm::dvec4(point, 1.0))), object,
                    "lies too far from the origin");
        }
    }

    void check_placed_mesh(std::uint32_t mesh, const glm::dmat4& to_world,
                           const std::string& object) const {
        require(mesh < scene_.meshes.size(), object, "refers to a mesh that does not exist");
        check_transform(to_world, object);
        if (!scene_.meshes[mesh].positions.empty()) check_extent(boxes_[mesh], to_world, object);
    }

    /// A mesh has the sets of texture coordinates that its material's textures lie by.
    void check_uv_sets(const Material& material, const Mesh& mesh,
                       const std::string& object) const {
        if (!material.description || mesh.triangles.empty()) return;
        for (const TextureMap* map : texture_maps(*material.description))
            require(map->uv_set < mesh.uv_sets.size(), object,
                    "lacks the texture coordinates that its material asks for");
    }

    void check(const Instance& instance) {
        const std::string object = "instance " + quote(instance.name);
        check_placed_mesh(instance.mesh, instance.to_world, object);
        require(instance.material < scene_.materials.size(), object,
                "refers to a material that does not exist");
        check_uv_sets(scene_.materials[instance.material], scene_.meshes[instance.mesh], object);
        const std::size_t triangles = scene_.meshes[instance.mesh].triangles.size();
        if (triangles > limits::max_triangles - triangles_)
            throw input_error(scene_.source, object + " brings the scene above the limit of " +
                                                 std::to_string(limits::max_triangles) +
                                                 " triangles");
        triangles_ += triangles;
    }

    void check(const PunctualLight& light) const {
        const std::string object = "light " + quote(light.name);
        require(within_bounds(light.position), object, "lies too far from the origin");
        require(std::abs(glm::length(light.direction) - 1.0) < 1e-6, object,
                "has a direction that is not of unit length");
        require(not_negative(light.intensity), object,
                "has an intensity that is negative or not finite");
        require(light.cos_inner >= light.cos_outer && light.cos_inner <= 1.0F &&
                    light.cos_outer >= -1.0F,
                object, "has impossible cone angles");
    }

    void check(const Animation& animation) const {
        const auto exists = [&](int track) {
            return track >= -1 &&
                   (track < 0 || static_cast<std::size_t>(track) < animation.tracks.size());
        };
        const auto fits = [&](int track, std::uint32_t width) {
            return track < 0 || animation.tracks[static_cast<std::size_t>(track)].width == width;
        };
        for (const KeyTrack& track : animation.tracks) {
            const std::size_t parts = track.interpolation == Interpolation::cubic ? 3 : 1;
            require(track.keys() > 0 && track.width > 0 &&
                        track.values.size() == track.keys() * parts * track.width,
                    "animation track", "has the wrong number of values");
        }
        for (std::size_t i = 0; i < animation.nodes.size(); ++i) {
            const MovingNode& node = animation.nodes[i];
            require(exists(node.translation) && exists(node.rotation) && exists(node.scale),
                    "moving node", "refers to a track that does not exist");
            require(fits(node.translation, 3) && fits(node.rotation, 4) && fits(node.scale, 3),
                    "moving node", "refers to a track of another kind");
            require(node.parent >= -1 && node.parent < static_cast<int>(i), "moving node",
                    "refers to a parent that does not come before it");
        }
        const auto check_motion = [&](const Attachment& motion, const std::string& object) {
            require(motion.node < static_cast<int>(animation.nodes.size()), object,
                    "moves with a node that does not exist");
        };
        for (const Camera& camera : scene_.cameras)
            check_motion(camera.motion, "camera " + quote(camera.name));
        for (const Instance& instance : scene_.instances)
            check_motion(instance.motion, "instance " + quote(instance.name));
        for (const PunctualLight& light : scene_.lights)
            check_motion(light.motion, "light " + quote(light.name));
    }

    void check_albedo_grid(const Medium& medium, const std::string& object) const {
        if (medium.albedo_grid < 0) return;
        require(static_cast<std::size_t>(medium.albedo_grid) < scene_.grids.size(), object,
                "refers to a grid of albedos that does not exist");
        const DensityGrid& grid = scene_.grids[static_cast<std::size_t>(medium.albedo_grid)];
        require(!grid.densities.empty(), object, "has a grid of albedos without voxels");
        require(greatest_density(grid) <= 1.0F, object, "has an albedo above 1 in its grid");
        check_transform(medium.albedo_to_world, object);
        check_extent({glm::dvec3(0.0), glm::dvec3(1.0)}, medium.albedo_to_world, object);
    }

    void check_grid(const Medium& medium, const std::string& object) const {
        check_albedo_grid(medium, object);
        if (medium.grid < 0) return;
        require(static_cast<std::size_t>(medium.grid) < scene_.grids.size(), object,
                "refers to a density grid that does not exist");
        check_transform(medium.grid_to_world, object);
        check_extent({glm::dvec3(0.0), glm::dvec3(1.0)}, medium.grid_to_world, object);
        if (scene_.grids[static_cast<std::size_t>(medium.grid)].channels == 1) return;
        require(medium.sigma_t.r == medium.sigma_t.g && medium.sigma_t.g == medium.sigma_t.b,
                object, "has a colour of extinction beside a density grid of three channels");
        require(medium.emission == glm::vec3(0.0F), object,
                "emits with a density grid of three channels, expected one channel");
    }

    void check_media() const {
        std::size_t voxels = 0;
        for (const DensityGrid& grid : scene_.grids) {
            validate_density_grid(grid, scene_.source + ": density grid");
            voxels += grid.densities.size();
        }
        require(voxels <= limits::max_scene_voxels, "density grids", "have too many voxels");
        const auto exists = [&](int medium) {
            return medium >= -1 &&
                   (medium < 0 || static_cast<std::size_t>(medium) < scene_.media.size());
        };
        for (const Medium& medium : scene_.media) {
            const std::string object = "medium " + quote(medium.name);
            require(not_negative(medium.sigma_t) && not_negative(medium.sigma_t * medium.scale) &&
                        medium.scale >= 0.0F,
                    object, "has an extinction that is negative or not finite");
            require(not_negative(medium.emission), object,
                    "has an emission that is negative or not finite");
            require(in_unit_cube(medium.albedo), object, "has an albedo outside [0, 1]");
            require(medium.anisotropy > -1.0F && medium.anisotropy < 1.0F, object,
                    "has an anisotropy outside (-1, 1)");
            check_grid(medium, object);
        }
        for (const MediumBoundary& boundary : scene_.medium_boundaries) {
            check_placed_mesh(boundary.mesh, boundary.to_world, "medium boundary");
            require(exists(boundary.interior) && exists(boundary.exterior), "medium boundary",
                    "refers to a medium that does not exist");
            require(boundary.surface >= -1 &&
                        boundary.surface < static_cast<int>(scene_.instances.size()),
                    "medium boundary", "refers to a surface that does not exist");
        }
        require(exists(scene_.outer_medium), "space",
                "is filled with a medium that does not exist");
        require(exists(scene_.camera_medium), "camera", "lies in a medium that does not exist");
    }

    void check(const FilmSize& film) const {
        require(film.width > 0 && film.height > 0, "film", "is empty");
        require(film.width <= limits::max_film_edge && film.height <= limits::max_film_edge &&
                    std::size_t{film.width} * film.height <= limits::max_film_pixels,
                "film", "is larger than the limit");
    }

    const Scene& scene_;
    std::vector<Box> boxes_;
    std::size_t triangles_ = 0;
};

}  // namespace

void validate_scene(const Scene& scene) {
    Validator(scene).run();
}

void validate_pose(const Scene& scene, const std::string& when) {
    Validator(scene).run_pose(" " + when);
}

void validate_camera(const Scene& scene, const Camera& camera, const std::string& when) {
    Validator(scene).check(camera, " " + when);
}

}  // namespace weft
