// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_TEXTURE_CUBE_MAP_H
#define WEFT_SCENE_TEXTURE_CUBE_MAP_H

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/environment_image.h"

namespace weft {

/// The radiance from all around on the faces of a cube, in the order +x, -x, +y, -y, +z, -z and
/// with the axes of each face as OpenGL has them.
struct CubeMap {
    std::uint32_t size = 0;                         ///< edge of a face, texels; not 0
    std::array<std::vector<glm::vec3>, 6> faces{};  ///< row-major, top row first
};

/// The radiance that comes from a direction, which is not zero: bilinear, over edges as well.
[[nodiscard]] glm::vec3 radiance_from(const CubeMap& cube, const glm::dvec3& direction);

/// The same in equirectangular projection, four times as wide and twice as high as a face: about as
/// fine as the middle of a face. Its name is left empty.
[[nodiscard]] EnvironmentImage equirectangular(const CubeMap& cube);

}  // namespace weft

#endif
