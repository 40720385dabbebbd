// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_ENVIRONMENT_IRRADIANCE_H
#define WEFT_SCENE_ENVIRONMENT_IRRADIANCE_H

#include <vector>

#include "scene/flat_environment.h"

namespace weft {

/// The irradiance of surfaces that see all of the image on their side: three channels at each of
/// IRRADIANCE_NODES x IRRADIANCE_NODES normals of the image's frame, row by row, which are spread
/// over the octahedron (kernels/light/environment_irradiance.h). Texels are taken together to beams
/// of about three degrees, each with the mean direction of its light. That and the map's
/// interpolation err by less than 2 % of the largest irradiance, most where a sun is level with the
/// surface.
[[nodiscard]] std::vector<float> environment_irradiance(const FlatEnvironment& environment);

}  // namespace weft

#endif
