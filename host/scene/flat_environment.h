// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_FLAT_ENVIRONMENT_H
#define WEFT_SCENE_FLAT_ENVIRONMENT_H

#include <glm/glm.hpp>
#include <vector>

#include "scene/environment_image.h"
#include "shared/shared_types.h"

namespace weft {

/// An image of the environment as kernels read it (kernels/light/environment_image.h), and what
/// there is to know of its light. Nothing of it depends on the factor that the image is multiplied
/// with.
struct FlatEnvironment {
    std::vector<shared::EnvironmentRecord> records;  ///< one; none without an image
    std::vector<float> texels;
    /// Inclusive sums of the probabilities of rows of cells, then of the cells of each row. All are
    /// multiples of 2^-24, so that floats hold them and their differences exactly. A cell in which
    /// anything shines has a probability above 0.
    std::vector<float> sums;
    glm::dvec3 mean{0.0};    ///< radiance over all directions
    float brightest = 0.0F;  ///< largest radiance of any channel
    /// Where light comes from on the whole: twice the mean of unit directions, weighted by their
    /// luminance. Its dot product with a normal, plus 1, is the irradiance of a surface over pi
    /// times the mean luminance, as far as light that varies slowly goes.
    glm::dvec3 trend{0.0};

    [[nodiscard]] bool present() const { return !records.empty(); }
};

/// Flattens an image, which has texels; `to_world` turns its frame to that of the world, and may
/// mirror it.
[[nodiscard]] FlatEnvironment flatten_environment(const EnvironmentImage& image,
                                                  const glm::dmat3& to_world);

}  // namespace weft

#endif
