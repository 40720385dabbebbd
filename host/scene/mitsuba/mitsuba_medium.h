// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_MEDIUM_H
#define WEFT_SCENE_MITSUBA_MITSUBA_MEDIUM_H

#include <glm/glm.hpp>
#include <map>

#include "scene/mitsuba/mitsuba_object.h"
#include "scene/scene.h"
#include "scene/volume/density_grid_set.h"

namespace weft::mitsuba {

/// Turns `<medium>` elements into Scene::media; each is read once.
class MediumReader {
  public:
    MediumReader(Context& context, Scene& scene)
        : context_(context), scene_(scene), grids_(scene.grids, context.warnings.diagnostics()) {}

    /// The index of a medium in Scene::media, -1 for null. Throws Error (exit code 2) for a wrong
    /// element, or a grid file that is missing or broken.
    [[nodiscard]] int index(const Element* medium);

  private:
    [[nodiscard]] Medium read(const Element& element);
    void read_coefficients(Object& object, Medium& medium);
    void read_phase(Object& object, Medium& medium);
    [[nodiscard]] glm::vec3 read_volume(Object& object, const char* name, const glm::vec3& missing);
    void read_density(const Element& volume, Medium& medium);
    void read_albedo(Object& object, Medium& medium);
    /// Reads a gridvolume: its index in Scene::grids and where its unit cube is.
    [[nodiscard]] int read_grid(Object& object, const Element& volume, glm::dmat4& to_world);

    Context& context_;
    Scene& scene_;
    DensityGridSet grids_;
    std::map<const Element*, int> indices_;
};

}  // namespace weft::mitsuba

#endif
