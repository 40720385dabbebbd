// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "app/commands.h"
#include "app/print.h"
#include "components/component.h"
#include "render/renderer.h"
#include "scene/load/load_scene.h"

namespace weft {
namespace {

/// Names of the effects that the scene needs.
std::vector<std::string> effects_of(const FlatScene& flat) {
    constexpr std::array<std::pair<std::uint32_t, const char*>, 10> names{{
        {FEATURE_AREA_LIGHTS, "area lights"},
        {FEATURE_PUNCTUAL_LIGHTS, "point lights"},
        {FEATURE_DIRECTIONAL_LIGHTS, "directional lights"},
        {FEATURE_ENVIRONMENT, "environment light"},
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

/// Describes where a medium's density comes from.
std::string density_of(const Scene& scene, const Medium& medium) {
    if (medium.grid < 0) return "homogeneous";
    const DensityGrid& grid = scene.grids[static_cast<std::size_t>(medium.grid)];
    return fmt::format("density grid of {} x {} x {} voxels up to {:g}", grid.size[0], grid.size[1],
                       grid.size[2], greatest_density(grid));
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
                       colour(medium.albedo), medium.anisotropy,
                       emits ? ", emission " + colour(medium.emission) : "");
}

nlohmann::json info_json(const Scene& scene) {
    const FlatScene flat = flatten(scene);
    const FramePlan plan = plan_for(flat, RenderSettings{});
    std::vector<std::string> active;
    for (const ComponentKind& kind : components())
        if (kind.is_enabled(plan)) active.emplace_back(kind.name);
    std::vector<std::string> kernels;
    for (const KernelId kernel : kernels_of(plan)) kernels.emplace_back(kernel_name(kernel));
    std::vector<std::string> media;
    for (const Medium& medium : scene.media) media.push_back(describe(scene, medium));
    std::vector<std::string> cameras;
    for (const Camera& camera : scene.cameras) cameras.push_back(camera.name);
    return {{"scene", scene.source},
            {"triangles", flat.triangles.size()},
            {"meshes", scene.meshes.size()},
            {"instances", scene.instances.size()},
            {"materials", scene.materials.size()},
            {"textures", scene.textures.size()},
            {"lights", flat.lights.size()},
            {"media", scene.media.size()},
            {"medium_list", media},
            {"cameras", cameras},
            {"effects", effects_of(flat)},
            {"components", active},
            {"kernels", kernels}};
}

/// Text for a terminal. Names come from files, so characters that would move the cursor become `?`.
std::string printable(std::string text) {
    for (char& c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7F) c = '?';
    }
    return text;
}

std::string info_text(const nlohmann::json& info) {
    std::string lines;
    for (const char* key :
         {"scene", "triangles", "meshes", "instances", "materials", "textures", "lights",
          "medium_list", "cameras", "effects", "components", "kernels"}) {
        std::string text;
        if (info[key].is_array())
            for (const auto& entry : info[key])
                text += (text.empty() ? "" : ", ") + entry.get<std::string>();
        else
            text = info[key].is_string() ? info[key].get<std::string>() : info[key].dump();
        const std::string_view label = key == std::string_view("medium_list") ? "media" : key;
        lines += fmt::format("{:<11} {}\n", label, text.empty() ? "none" : printable(text));
    }
    return lines;
}

}  // namespace

void info_command(const InfoOptions& options, Diagnostics& diagnostics) {
    const nlohmann::json info = info_json(load_scene(options.scene, diagnostics, options.light));
    print_warnings(diagnostics, options.verbose);
    print_result(options.json ? json_document(info) : info_text(info));
}

}  // namespace weft
