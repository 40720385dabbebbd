// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/info_surfaces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "scene/surface_lobes.h"

namespace weft {

nlohmann::json surfaces_json(const Scene& scene) {
    nlohmann::json list = nlohmann::json::array();
    const std::vector<TextureStatistics> textures =
        measure_textures(scene.textures, std::vector<bool>(scene.textures.size(), true));
    for (const Material& material : scene.materials) {
        if (!material.description) continue;
        const std::vector<SurfaceLobe> lobes = lobes_of(*material.description, textures);
        nlohmann::json found = nlohmann::json::array();
        for (const SurfaceLobe& lobe : lobes) {
            nlohmann::json entry{{"name", lobe.name}};
            if (!lobe.is_diffuse) {
                entry["roughness"] = {name_of(width_of(lobe.least_alpha)),
                                      name_of(width_of(lobe.most_alpha))};
                entry["alpha"] = {lobe.least_alpha, lobe.most_alpha};
            }
            found.push_back(std::move(entry));
        }
        list.push_back({{"name", material.name},
                        {"lobes", std::move(found)},
                        {"effects", effects_of(*material.description, lobes)}});
    }
    return list;
}

std::string describe_surface(const nlohmann::json& surface) {
    std::vector<std::string> lobes;
    for (const nlohmann::json& lobe : surface["lobes"]) {
        std::string text = lobe["name"];
        if (lobe.contains("roughness")) {
            const std::string least = lobe["roughness"][0];
            const std::string most = lobe["roughness"][1];
            text += least == most ? fmt::format(" ({})", least)
                                  : fmt::format(" ({} to {})", least, most);
        }
        lobes.push_back(std::move(text));
    }
    const auto effects = surface["effects"].get<std::vector<std::string>>();
    return fmt::format(
        "{}: {}", fmt::join(lobes, ", "),
        effects.empty() ? "nothing else" : fmt::format("{}", fmt::join(effects, ", ")));
}

}  // namespace weft
