// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/reference_renderer.h"

#include <utility>

#include "plan/quality.h"

namespace weft {
namespace {

RenderSettings render_settings(const PathSettings& settings) {
    RenderSettings result;
    result.algorithm = Algorithm::reference;
    result.sampling = sampling_of_reference();
    result.width = settings.width;
    result.height = settings.height;
    result.seed = settings.seed;
    // However many there are: what a sample is depends on nothing but its number.
    result.samples = 1;
    result.through_centres = settings.through_centres;
    result.hides_environment = settings.hides_environment;
    result.direct = settings.direct;
    result.indirect = settings.indirect;
    return result;
}

}  // namespace

ReferenceRenderer::ReferenceRenderer(Executor& executor, const FlatScene& scene,
                                     std::shared_ptr<SceneBuffers> uploaded, const Camera& camera,
                                     const PathSettings& settings)
    : scene_(scene),
      settings_(settings),
      renderer_(executor, scene, std::move(uploaded), camera, render_settings(settings)),
      film_(executor, settings.width, settings.height, settings.samples) {
    film_.fit(scene_);
}

const std::string& ReferenceRenderer::identity() {
    if (!identity_.empty()) return identity_;
    const shared::PathParams constant{.samples = 0,
                                      .through_centres = settings_.through_centres ? 1U : 0U,
                                      .film_scale = film_.scale()};
    identity_ = image_identity("vpl2", scene_, renderer_.constant_params(), constant);
    return identity_;
}

bool ReferenceRenderer::render_frame(const KeepGoing& keep_going) {
    if (samples_left() == 0) return false;
    bool wanted = true;
    // keep_going is called although the sample does not end, because it reports progress.
    const KeepGoing listen = [&](Stage stage, double done) {
        if (keep_going) wanted = keep_going(stage, done) && wanted;
        return true;
    };
    if (!renderer_.add_sample(film_, listen)) return false;
    sample_ms_ = renderer_.stats().back().ms;
    // Launches of small images are too short to ask in between.
    (void)listen(Stage::composition, 1.0);
    return wanted && samples_left() > 0;
}

void ReferenceRenderer::set_camera(const Camera& camera) {
    renderer_.set_camera(camera);
    identity_.clear();
    film_.clear();
}

void ReferenceRenderer::update_scene() {
    renderer_.update_scene();
    identity_.clear();
    film_.fit(scene_);
}

void ReferenceRenderer::follow_scene() {
    renderer_.follow_scene();
    identity_.clear();
    film_.fit(scene_);
}

FilmView ReferenceRenderer::film() {
    return {.params = renderer_.constant_params(),
            .high = {},
            .low = {},
            .sums = film_.buffer(),
            .samples = film_.samples(),
            .unit = film_.unit()};
}

std::unique_ptr<ExactRenderer> make_exact_renderer(Executor& executor, const FlatScene& scene,
                                                   std::shared_ptr<SceneBuffers> uploaded,
                                                   const Camera& camera,
                                                   const PathSettings& settings, FilmSums sums) {
    if (settings.algorithm == Algorithm::reference && !scene.media.present() &&
        !scene.surfaces.present()) {
        auto renderer =
            std::make_unique<ReferenceRenderer>(executor, scene, uploaded, camera, settings);
        if (renderer->landed_share() >= least_landed) {
            renderer->begin(std::move(sums));
            return renderer;
        }
    }
    return std::make_unique<PathRenderer>(executor, scene, std::move(uploaded), camera, settings,
                                          std::move(sums));
}

}  // namespace weft
