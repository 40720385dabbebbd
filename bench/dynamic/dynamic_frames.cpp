// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/dynamic_frames.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"

namespace weft::bench {

void show_indirect(Image& image) {
    const Layer* const indirect = image.find("indirect");
    if (indirect == nullptr)
        throw Error(ExitCode::bad_input, "an image lacks the layer 'indirect', expected light");
    const std::vector<float> values = indirect->values;
    for (Layer& layer : image.layers)
        if (layer.name.empty()) layer.values = values;
}

double follow_scene(Renderer& renderer, const Camera& camera) {
    const weft::Stopwatch watch;
    renderer.update_scene();
    renderer.move_camera(camera);
    return watch.total();
}

DynamicRenderer::DynamicRenderer(Executor& executor, const DynamicMethod& method,
                                 std::uint32_t edge)
    : method_(method), edge_(edge), executor_(executor), shared_(executor) {}

void DynamicRenderer::renew(const FlatScene& flat, const Camera& camera) {
    if (renderer_) renderer_->update_scene();
    renderer_ =
        std::make_unique<Renderer>(shared_, flat, camera, dynamic_settings(method_, edge_, frame_));
    // Its buffers are new, and to touch them first takes time that no frame of a sequence has.
    (void)renderer_->render_frame({});
    renderer_->set_camera(camera);
}

DynamicFrame DynamicRenderer::render(const FlatScene& flat, const Camera& camera) {
    DynamicFrame made;
    if (method_.fresh)
        renew(flat, camera);
    else if (!renderer_)
        renderer_ = std::make_unique<Renderer>(executor_, flat, camera,
                                               dynamic_settings(method_, edge_, 0));
    else
        made.update_ms = follow_scene(*renderer_, camera);
    const weft::Stopwatch watch;
    (void)renderer_->render_frame({});
    made.ms = watch.total();
    const FrameStats& stats = renderer_->stats().back();
    made.rays = stats.rays - std::uint64_t{edge_} * edge_;
    made.stages = stats.stages;
    made.cache = stats.cache;
    made.light = renderer_->image();
    show_indirect(made.light);
    std::erase_if(made.light.layers, [](const Layer& layer) { return !layer.name.empty(); });
    ++frame_;
    return made;
}

ReferenceRenderer::ReferenceRenderer(Executor& executor, std::uint32_t edge, std::uint32_t count)
    : executor_(executor), edge_(edge), count_(count) {}

ReferenceFrame ReferenceRenderer::render(const FlatScene& flat, const Camera& camera) {
    if (!renderer_)
        renderer_ = std::make_unique<Renderer>(executor_, flat, camera,
                                               dynamic_settings({"ir", Algorithm::ir}, edge_, 0));
    else
        follow_scene(*renderer_, camera);
    ReferenceFrame made;
    for (std::uint32_t i = 0; i < count_; ++i) {
        (void)renderer_->render_frame({});
        if (i > 0) continue;
        made.same_vpls = renderer_->image();
        show_indirect(made.same_vpls);
    }
    made.converged = count_ > 1 ? renderer_->image() : made.same_vpls;
    show_indirect(made.converged);
    return made;
}

}  // namespace weft::bench
