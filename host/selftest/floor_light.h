// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_FLOOR_LIGHT_H
#define WEFT_SELFTEST_FLOOR_LIGHT_H

#include <glm/glm.hpp>

#include "selftest/floor_scenes.h"
#include "selftest/measurements.h"
#include "selftest/path_rendering.h"
#include "selftest/tolerance.h"

// Irradiance by direct light at a point of a floor scene, in the first channel.
namespace weft::selftest {

/// A tiny picture of a point of a floor scene, seen from beside it.
[[nodiscard]] Camera camera_on(const glm::dvec3& point);

/// As pictures of one pixel, one a seed, by samples of lights.
[[nodiscard]] Estimate sampled_irradiance(Executor& executor, const FlatScene& flat,
                                          const glm::dvec3& point);

/// As a single picture of one pixel: for lights that are not sampled.
[[nodiscard]] double exact_irradiance(Executor& executor, const FlatScene& flat,
                                      const glm::dvec3& point);

/// By path tracing; pixels are independent.
[[nodiscard]] Estimate traced_irradiance(Executor& executor, const FlatScene& flat,
                                         const glm::dvec3& point);

/// What sampled_irradiance and traced_irradiance may be off, where `bias` is what the model itself
/// is off by, relative.
[[nodiscard]] Tolerance sampled_tolerance(double bias = 0.0);
[[nodiscard]] Tolerance traced_tolerance(double bias = 0.0);

}  // namespace weft::selftest

#endif
