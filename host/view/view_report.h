// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_REPORT_H
#define WEFT_VIEW_VIEW_REPORT_H

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/frame_renderer.h"
#include "scene/moving_scene.h"
#include "view/view_edits.h"
#include "view/view_judge.h"
#include "view/view_recipe.h"

// What a view tells its pages, as JSON.
namespace weft {

/// Where the middle of a scene lies, in scene units.
[[nodiscard]] glm::dvec3 centre_of(const FlatScene& scene);
/// The radius of a scene about its middle, in scene units.
[[nodiscard]] double radius_of(const FlatScene& scene);

[[nodiscard]] nlohmann::json vector_report(const glm::dvec3& v);
[[nodiscard]] nlohmann::json settings_report(const ViewChoice& choice, bool paused);
/// A camera. What it looks at is as far off as the scene's middle, where nothing else is known.
[[nodiscard]] nlohmann::json camera_report(const Camera& camera, const CameraPlacement& placement,
                                           const FlatScene& scene);
/// What can be edited by its name, how it is now, the edits so far and the animation.
[[nodiscard]] nlohmann::json scene_report(const MovingScene& scene, const ViewTimeline& timeline,
                                          const ViewEdits& edits);
/// What each kind of stage of a frame took, milliseconds, in the order in which they ran.
[[nodiscard]] nlohmann::json stages_report(const FrameStats& frame);
/// What became of records that outlast their frame; null where there are none.
[[nodiscard]] nlohmann::json records_report(const FrameStats& frame);
/// Errors, and how many samples each half of the reference has by now.
[[nodiscard]] nlohmann::json trust_report(std::uint64_t reference_samples,
                                          const std::optional<Judgement>& judgement);

/// Where the surface lies that a pixel shows at a depth, all in scene units.
[[nodiscard]] glm::dvec3 point_at(const Camera& camera, FilmSize size, const ViewPick& pick,
                                  double depth);

}  // namespace weft

#endif
