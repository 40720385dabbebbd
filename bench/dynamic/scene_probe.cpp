// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/scene_probe.h"

#include <cmath>
#include <utility>

#include "device/native/native_executor.h"
#include "image/image.h"

namespace weft::bench {
namespace {

/// Any turn whose -z is `direction`.
glm::dmat4 looking_along(const glm::dvec3& from, const glm::dvec3& direction) {
    const glm::dvec3 z = -glm::normalize(direction);
    const glm::dvec3 aside =
        std::abs(z.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 x = glm::normalize(glm::cross(aside, z));
    return {glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0),
            glm::dvec4(from, 1.0)};
}

}  // namespace

SceneProbe::SceneProbe(FlatScene flat, const Camera& camera)
    : flat_(std::move(flat)),
      camera_(camera),
      executor_(make_native_executor(NativeTraversal::own_bvh, 1)) {
    RenderSettings settings;
    settings.algorithm = Algorithm::ir;
    settings.width = settings.height = 1;
    settings.direct = settings.indirect = settings.media = false;
    renderer_ = std::make_unique<Renderer>(*executor_, flat_, camera_, settings);
}

std::optional<double> SceneProbe::distance(const glm::dvec3& from, const glm::dvec3& direction) {
    camera_.to_world = looking_along(from, direction);
    renderer_->set_camera(camera_);
    (void)renderer_->render_frame({});
    const Image image = renderer_->image();
    const double depth = static_cast<double>(image.find("depth")->values.at(0));
    if (!(depth > 0.0) || !std::isfinite(depth)) return std::nullopt;
    return depth;
}

}  // namespace weft::bench
