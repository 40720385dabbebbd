// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Prisms, lenses and mirrors, and where they send a ray by geometrical optics.
#ifndef WEFT_SELFTEST_OPTICS_SCENES_H
#define WEFT_SELFTEST_OPTICS_SCENES_H

#include "selftest/surface_scenes.h"

namespace weft::selftest {

/// What a camera that looks along a single ray sees.
struct SeenByRay {
    Scene scene;
    Camera camera;
    double radiance;  ///< of light that comes by the way that is meant
};

/// A prism of glass with an apex of 60 degrees that a ray enters at an angle of 50, and in its way
/// by Snell's law a small target of radiance 1, or `aside` of it by so many half widths.
[[nodiscard]] SeenByRay target_behind_a_prism(double aside = 0.0);

/// A ray off the axis of a ball of glass, and at the ball's focus, n / (2 (n - 1)) radii from its
/// centre, a target as small as the square of the ray's distance from the axis. `farther`
/// multiplies the target's distance from the centre.
[[nodiscard]] SeenByRay target_at_a_focus(double index, double farther = 1.0);

/// A prism of glass of index 1.5 with a right angle: all light is reflected at its longest side to
/// a wall of radiance 1. Behind that side is a wall of radiance 1000.
[[nodiscard]] SeenByRay wall_by_total_reflection();

/// A lamp of radiance 2 in a block of glass, seen straight on: by the boundary's transmittance over
/// the square of the index, since the lamp takes up what is reflected to it.
[[nodiscard]] SeenByRay lamp_in_glass(double index);

/// Slabs of absorbing glass with a slab of water between them, before a wall of radiance 1. The
/// water reaches `overlap` into each of them, or leaves a gap where that is negative. In overlaps
/// there is glass: it has the lesser volume.
struct WaterInGlass {
    Scene scene;
    glm::dvec3 radiance;
};
[[nodiscard]] WaterInGlass water_in_glass(double overlap);

/// Most mirrors that a path meets in the box of mirrors.
inline constexpr std::uint32_t most_mirrors = 4;

/// A box of mirrors with things in it that shine, and the same without mirrors, but with the images
/// of these things where most_mirrors mirrors put them, dimmed by each.
[[nodiscard]] Scene box_of_mirrors();
[[nodiscard]] Scene unfolded_box_of_mirrors();
[[nodiscard]] Camera camera_among_mirrors();

}  // namespace weft::selftest

#endif
