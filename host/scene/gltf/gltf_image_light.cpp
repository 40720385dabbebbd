// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_image_light.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>

#include "base/limits.h"
#include "scene/texture/cube_map.h"

namespace weft {
namespace {

constexpr const char* name_of_extension = "EXT_lights_image_based";
constexpr double largest_intensity = 1e30;

/// A byte of colour by one of alpha: RGBD, of which an image without alpha is the part up to 1.
float decoded(std::uint8_t colour, std::uint8_t divisor) {
    return static_cast<float>(colour) / static_cast<float>(std::max<std::uint8_t>(divisor, 1));
}

/// The sharpest level: those after it are blurred, for viewers that need them.
CubeMap read_cube(const JsonValue& light, GltfTextures& textures) {
    const JsonValue levels = light.at("specularImages");
    if (levels.size() == 0) throw levels.error("is empty, expected an array of six images");
    const JsonValue faces = levels.element(0);
    if (faces.size() != 6)
        throw faces.error("has " + std::to_string(faces.size()) + " images, expected 6");
    CubeMap cube;
    for (std::size_t face = 0; face < 6; ++face) {
        const JsonValue reference = faces.element(face);
        const Texture image = textures.image(reference);
        if (face == 0) cube.size = image.width;
        if (image.width != cube.size || image.height != cube.size)
            throw reference.error("is " + std::to_string(image.width) + " x " +
                                  std::to_string(image.height) +
                                  " pixels, expected square images of the same size");
        if (std::size_t{8} * cube.size * cube.size > limits::max_environment_pixels)
            throw reference.error("is too large to light a scene with");
        std::vector<glm::vec3>& texels = cube.faces[face];
        texels.resize(std::size_t{cube.size} * cube.size);
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const std::uint8_t* const rgba = &image.rgba[4 * i];
            texels[i] = {decoded(rgba[0], rgba[3]), decoded(rgba[1], rgba[3]),
                         decoded(rgba[2], rgba[3])};
        }
    }
    return cube;
}

glm::dmat3 read_rotation(const JsonValue& light) {
    const std::array<double, 4> given = light.numbers_or<4>("rotation", {0.0, 0.0, 0.0, 1.0});
    const glm::dquat turn(given[3], given[0], given[1], given[2]);
    const double length = glm::length(turn);
    if (!(length > 0.0)) throw light.at("rotation").error("is zero, expected a quaternion");
    return glm::mat3_cast(turn / length);
}

}  // namespace

std::optional<Environment> read_gltf_image_light(const JsonValue& root, GltfTextures& textures) {
    const std::size_t scenes = root.size_of("scenes");
    if (scenes == 0) return std::nullopt;
    const std::optional<JsonValue> chosen = root.find("scene");
    const std::size_t scene = chosen ? chosen->as_index(scenes, "scenes") : 0;
    const auto named = root.at("scenes").element(scene).extension(name_of_extension);
    const auto listed = root.extension(name_of_extension);
    if (!named || !listed) return std::nullopt;
    const JsonValue lights = listed->at("lights");
    const std::size_t number = named->at("light").as_index(lights.size(), "lights");
    const JsonValue light = lights.element(number);
    const double intensity = light.number_or("intensity", 1.0);
    if (!(intensity >= 0.0 && intensity <= largest_intensity))
        throw light.at("intensity").error("lies outside of 0 to 1e30");
    Environment environment;
    environment.radiance = glm::vec3(static_cast<float>(intensity));
    environment.to_world = read_rotation(light);
    auto image = std::make_shared<EnvironmentImage>(equirectangular(read_cube(light, textures)));
    image->name = light.name_or("image light " + std::to_string(number));
    environment.image = std::move(image);
    return environment;
}

}  // namespace weft
