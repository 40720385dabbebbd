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

/// A camera beside a point of a floor scene that sees little more than that point.
[[nodiscard]] Camera camera_on(const glm::dvec3& point);

/// Estimates the irradiance with samples of lights, by images of one pixel, one for each seed.
[[nodiscard]] Estimate sampled_irradiance(Executor& executor, const FlatScene& flat,
                                          const glm::dvec3& point);

/// The irradiance of lights that are not sampled, by a single image of one pixel.
[[nodiscard]] double exact_irradiance(Executor& executor, const FlatScene& flat,
                                      const glm::dvec3& point);

/// Estimates the irradiance by path tracing; pixels are independent.
[[nodiscard]] Estimate traced_irradiance(Executor& executor, const FlatScene& flat,
                                         const glm::dvec3& point);

/// Tolerance of sampled_irradiance and traced_irradiance, where `bias` is the relative error of the
/// scene's model of the light.
[[nodiscard]] Tolerance sampled_tolerance(double bias = 0.0);
[[nodiscard]] Tolerance traced_tolerance(double bias = 0.0);

}  // namespace weft::selftest

#endif
