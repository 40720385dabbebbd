// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/commands.h"
#include "app/print.h"
#include "components/component.h"
#include "frame/renderer.h"
#include "scene/load_scene.h"

namespace weft {
namespace {

/// What the scene calls for, in words.
std::vector<std::string> effects_of(const Scene& scene, const FlatScene& flat) {
    constexpr std::array<std::pair<std::uint32_t, const char*>, 8> names{{
        {FEATURE_AREA_LIGHTS, "area lights"},
        {FEATURE_PUNCTUAL_LIGHTS, "point lights"},
        {FEATURE_DIRECTIONAL_LIGHTS, "directional lights"},
        {FEATURE_ENVIRONMENT, "environment light"},
        {FEATURE_TEXTURES, "textures"},
        {FEATURE_VERTEX_COLOURS, "vertex colours"},
        {FEATURE_SMOOTH_NORMALS, "smooth normals"},
        {FEATURE_ONE_SIDED, "one-sided surfaces"},
    }};
    std::vector<std::string> effects;
    for (const auto& [bit, name] : names)
        if ((flat.features & bit) != 0) effects.emplace_back(name);
    if (!flat.lights.empty() && flat.mean_reflectance > 0.0)
        effects.emplace_back("diffuse interreflection");
    if (!scene.media.empty()) effects.emplace_back("participating media (not simulated)");
    return effects;
}

nlohmann::json info_json(const Scene& scene) {
    const FlatScene flat = flatten(scene);
    const FramePlan plan = plan_for(flat, RenderSettings{});
    std::vector<std::string> active;
    for (const Component& component : components())
        if (component.called_for(plan)) active.emplace_back(component.name);
    std::vector<std::string> kernels;
    for (const KernelId kernel : kernels_of(plan)) kernels.emplace_back(kernel_name(kernel));
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
            {"cameras", cameras},
            {"effects", effects_of(scene, flat)},
            {"components", active},
            {"kernels", kernels}};
}

/// Names come from files: what would move a terminal's cursor becomes `?`.
std::string printable(std::string text) {
    for (char& c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7F) c = '?';
    }
    return text;
}

std::string info_text(const nlohmann::json& info) {
    std::string lines;
    for (const char* key : {"scene", "triangles", "meshes", "instances", "materials", "textures",
                            "lights", "media", "cameras", "effects", "components", "kernels"}) {
        std::string text;
        if (info[key].is_array())
            for (const auto& entry : info[key])
                text += (text.empty() ? "" : ", ") + entry.get<std::string>();
        else
            text = info[key].is_string() ? info[key].get<std::string>() : info[key].dump();
        lines += fmt::format("{:<11} {}\n", key, text.empty() ? "none" : printable(text));
    }
    return lines;
}

}  // namespace

void info_command(const InfoOptions& options, Diagnostics& diagnostics) {
    const nlohmann::json info = info_json(load_scene(options.scene, diagnostics));
    print_result(options.json ? json_document(info) : info_text(info));
}

}  // namespace weft
