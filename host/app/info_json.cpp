// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/info_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/info_surfaces.h"
#include "components/component.h"
#include "device/native/native_executor.h"
#include "plan/quality.h"
#include "render/camera_params.h"
#include "render/renderer.h"
#include "scene/scene_bounds.h"

namespace weft {
namespace {

using nlohmann::json;

constexpr double pi = std::numbers::pi;

/// Names of the effects that the scene needs.
std::vector<std::string> effects_of(const FlatScene& flat) {
    constexpr std::array<std::pair<std::uint32_t, const char*>, 11> names{{
        {FEATURE_AREA_LIGHTS, "area lights"},
        {FEATURE_PUNCTUAL_LIGHTS, "point lights"},
        {FEATURE_DIRECTIONAL_LIGHTS, "directional lights"},
        {FEATURE_ENVIRONMENT, "environment light"},
        {FEATURE_IMAGE_ENVIRONMENT, "image environment"},
        {FEATURE_TEXTURES, "textures"},
        {FEATURE_EMISSION_TEXTURES, "textured emission"},
        {FEATURE_VERTEX_COLOURS, "vertex colours"},
        {FEATURE_SMOOTH_NORMALS, "smooth normals"},
        {FEATURE_ONE_SIDED, "one-sided surfaces"},
        {FEATURE_LOBES, "surfaces that are not Lambertian"},
    }};
    std::vector<std::string> effects;
    for (const auto& [bit, name] : names)
        if ((flat.features & bit) != 0) effects.emplace_back(name);
    if (!flat.lights.empty() && flat.mean_reflectance > 0.0)
        effects.emplace_back("diffuse interreflection");
    if (flat.media.present()) effects.emplace_back("participating media");
    return effects;
}

json numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// Lowest and highest coordinates of everything that is placed, null where there is nothing.
json bounds_json(const Scene& scene) {
    SceneBounds bounds = bounds_of(scene);
    for (const MediumBoundary& boundary : scene.medium_boundaries)
        for (const glm::vec3& position : scene.meshes[boundary.mesh].positions)
            bounds.add(glm::dvec3(boundary.to_world * glm::dvec4(glm::dvec3(position), 1.0)));
    if (bounds.empty()) return nullptr;
    return {{"low", numbers(bounds.low)},
            {"high", numbers(bounds.high)},
            {"size", numbers(bounds.high - bounds.low)}};
}

std::string_view axis_name(FovAxis axis) {
    switch (axis) {
        case FovAxis::x:
            return "horizontal";
        case FovAxis::y:
            return "vertical";
        case FovAxis::diagonal:
            return "diagonal";
        case FovAxis::smaller:
            return "smaller side";
        case FovAxis::larger:
            return "larger side";
    }
    return "";
}

json camera_json(const Camera& camera, bool fallback) {
    json found{{"name", camera.name},
               {"kind", camera.orthographic() ? "orthographic" : "perspective"},
               {"animated", camera.motion.moves()},
               {"fallback", fallback}};
    if (camera.orthographic()) {
        found["extent"] = {2.0 * camera.half_extent.x, 2.0 * camera.half_extent.y};
    } else {
        found["field_of_view"] = glm::degrees(camera.fov);
        found["field_of_view_axis"] = axis_name(camera.fov_axis);
    }
    return found;
}

json camera_list(const Scene& scene, const Camera& chosen) {
    json list = json::array();
    for (const Camera& camera : scene.cameras) list.push_back(camera_json(camera, false));
    if (list.empty()) list.push_back(camera_json(chosen, true));
    return list;
}

json light_json(const std::string& name, std::string_view kind, const glm::dvec3& power,
                std::string_view unit, bool is_default) {
    return {{"name", name},
            {"kind", kind},
            {"power", numbers(power)},
            {"unit", unit},
            {"default", is_default}};
}

/// The integral of a spot light's falloff over all directions, in sr.
double spot_solid_angle(const PunctualLight& light) {
    const double inner = light.cos_inner;
    const double outer = light.cos_outer;
    // Between the cones glTF's falls off with the square of the share of the cosine.
    if (!light.linear_edge) return 2.0 * pi * (1.0 - inner + (inner - outer) / 3.0);
    const double angle = std::acos(inner);
    const double width = std::acos(outer) - angle;
    if (!(width > 0.0)) return 2.0 * pi * (1.0 - outer);
    return 2.0 * pi * (1.0 - (std::sin(angle + width) - std::sin(angle)) / width);
}

json punctual_json(const PunctualLight& light, bool is_default) {
    const glm::dvec3 intensity(light.intensity);
    if (light.type == LightType::directional)
        return light_json(light.name, "directional", intensity, "W/m^2", is_default);
    if (light.type == LightType::point)
        return light_json(light.name, "point", 4.0 * pi * intensity, "W", is_default);
    return light_json(light.name, "spot", spot_solid_angle(light) * intensity, "W", is_default);
}

/// Of an image the power is its mean radiance.
json environment_json(const Environment& environment, const FlatScene& flat, bool is_default) {
    const glm::dvec3 radiance(flat.environment);
    if (!environment.image)
        return light_json("environment", "environment", radiance, "W/(m^2 sr)", is_default);
    const EnvironmentImage& image = *environment.image;
    json entry = light_json(image.name, "environment", radiance * flat.environment_image.mean,
                            "W/(m^2 sr)", is_default);
    entry["image"] = {image.width, image.height};
    return entry;
}

/// The part of an area light that shines, in scene units.
struct Shining {
    double area = 0.0;
    std::size_t triangles = 0;
    glm::dvec3 light{0.0};  ///< radiance times area
};

Shining shining_of(const FlatScene& flat, std::size_t instance, const shared::LightRecord& light) {
    const glm::dvec3 radiance(light.power.x, light.power.y, light.power.z);
    const double square = flat.units.scale * flat.units.scale;
    Shining shining;
    for (std::uint32_t k = 0; k < light.count; ++k) {
        const shared::EmissiveTriangle& entry = flat.emissive[light.first + k];
        if (!(entry.probability > 0.0F)) continue;
        const double area = triangle_area(flat, flat.triangles[entry.triangle]) / square;
        const glm::dvec3 mean =
            light.textured != 0 ? glm::dvec3(flat.emission_means[instance][k]) : glm::dvec3(1.0);
        shining.area += area;
        shining.light += area * radiance * mean;
        ++shining.triangles;
    }
    return shining;
}

/// All lights that shine: surfaces, lights without area, then the environment.
json light_list(const Scene& scene, const FlatScene& flat) {
    json list = json::array();
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const std::uint32_t index = flat.instances[i].light;
        if (index == INVALID_INDEX) continue;
        const shared::LightRecord& light = flat.lights[index];
        const Shining shining = shining_of(flat, i, light);
        const double sides = light.both_sides != 0 ? 2.0 : 1.0;
        json entry =
            light_json(scene.instances[i].name, "area", pi * sides * shining.light, "W", false);
        entry["area"] = shining.area;
        entry["triangles"] = shining.triangles;
        entry["textured"] = light.textured != 0;
        list.push_back(std::move(entry));
    }
    for (const PunctualLight& light : scene.lights) {
        const bool is_default = scene.default_light && &light == &scene.lights.back();
        if (luminance(light.intensity) > 0.0) list.push_back(punctual_json(light, is_default));
    }
    if (flat.environment != glm::vec3(0.0F))
        list.push_back(environment_json(*scene.environment, flat, scene.default_sky));
    return list;
}

json animation_list(const Scene& scene) {
    json list = json::array();
    for (const AnimationClip& clip : scene.animation.clips) {
        list.push_back({{"name", clip.name},
                        {"duration", clip.duration},
                        {"frames", frame_count(clip.duration, default_frame_rate)},
                        {"channels", clip.channels},
                        {"channels_played", clip.channels_played}});
    }
    return list;
}

/// Describes where a medium's density comes from.
std::string density_of(const Scene& scene, const Medium& medium) {
    if (medium.grid < 0) return "homogeneous";
    const DensityGrid& grid = scene.grids[static_cast<std::size_t>(medium.grid)];
    return fmt::format("density grid of {} x {} x {} voxels{} up to {:g}", grid.size[0],
                       grid.size[1], grid.size[2], grid.channels == 3 ? " of three channels" : "",
                       greatest_density(grid));
}

/// Describes a medium's albedo: the mean of one that varies.
std::string albedo_of(const Scene& scene, const Medium& medium,
                      const std::function<std::string(const glm::vec3&)>& colour) {
    if (medium.albedo_grid < 0) return colour(medium.albedo);
    const DensityGrid& grid = scene.grids[static_cast<std::size_t>(medium.albedo_grid)];
    return fmt::format("{} on average, of {} x {} x {} voxels", colour(mean_density(grid)),
                       grid.size[0], grid.size[1], grid.size[2]);
}

/// Describes a medium in one line.
std::string describe(const Scene& scene, const Medium& medium) {
    const auto colour = [](const glm::vec3& c) {
        return c.r == c.g && c.g == c.b ? fmt::format("{:g}", c.r)
                                        : fmt::format("{:g} {:g} {:g}", c.r, c.g, c.b);
    };
    const bool emits = medium.emission != glm::vec3(0.0F);
    return fmt::format("{} ({}, extinction {}, albedo {}, g {:g}{})", medium.name,
                       density_of(scene, medium), colour(medium.sigma_t * medium.scale),
                       albedo_of(scene, medium, colour), medium.anisotropy,
                       emits ? ", emission " + colour(medium.emission) : "");
}

json landed_json(const FramePlan& plan) {
    return plan.landed ? json(*plan.landed) : json();
}

/// The plan of an image without options. Whether the scene is open takes light paths to find out.
FramePlan plan_by_default(const FlatScene& flat, const Camera& camera) {
    RenderSettings settings;
    settings.samples = samples_of(Quality::preview, flat.media.present());
    settings.sampling = sampling_of_image(Quality::preview, flat.media.present());
    FramePlan plan = plan_for(flat, settings);
    if (!plan.gathers_vpls() || plan.media) return plan;
    settings.sampling.bounce_rays_if_open = true;
    settings.width = settings.height = 8;
    const std::unique_ptr<Executor> executor = make_native_executor(NativeTraversal::embree, 0);
    plan = Renderer(*executor, flat, camera, settings).plan();
    return plan;
}

/// What the image lacks of what the file asks for.
json approximations(const Diagnostics& diagnostics) {
    json list = json::array();
    for (const Warning& warning : diagnostics.list()) {
        if (!warning.of_file) continue;
        json places = json::array();
        for (const Warning::Place& place : warning.places) places.push_back(place.text);
        list.push_back({{"message", warning.message},
                        {"title", warning_title(warning)},
                        {"number", warning.number},
                        {"unit", warning.number == 1 ? warning.unit.one : warning.unit.many},
                        {"places", std::move(places)}});
    }
    return list;
}

}  // namespace

json info_json(const Scene& scene, Diagnostics& diagnostics) {
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, "", diagnostics);
    const FramePlan plan = plan_by_default(flat, camera);
    json active = json::array();
    if (plan.has_direct()) active.push_back("direct");
    if (plan.has_indirect()) active.push_back("indirect");
    if (plan.reflection) active.push_back("reflection");
    if (plan.refraction) active.push_back("refraction");
    if (plan.glossy) active.push_back("glossy");
    if (plan.media_light) active.push_back("media");
    json kernels = json::array();
    for (const KernelId kernel : kernels_of(plan)) kernels.push_back(kernel_name(kernel));
    json media = json::array();
    for (const Medium& medium : scene.media) media.push_back(describe(scene, medium));
    json cameras = json::array();
    for (const Camera& each : scene.cameras) cameras.push_back(each.name);
    return {{"scene", scene.source},
            {"triangles", flat.triangles.size()},
            {"meshes", scene.meshes.size()},
            {"instances", scene.instances.size()},
            {"materials", scene.materials.size()},
            {"textures", scene.textures.size()},
            {"bounds", bounds_json(scene)},
            {"lights", flat.lights.size()},
            {"light_list", light_list(scene, flat)},
            {"media", scene.media.size()},
            {"medium_list", media},
            {"cameras", cameras},
            {"camera_list", camera_list(scene, camera)},
            {"animations", animation_list(scene)},
            {"surfaces", surfaces_json(scene)},
            {"approximations", approximations(diagnostics)},
            {"effects", effects_of(flat)},
            {"indirect", {{"method", indirect_method(plan)}, {"vpls_landed", landed_json(plan)}}},
            {"components", active},
            {"kernels", kernels}};
}

}  // namespace weft
