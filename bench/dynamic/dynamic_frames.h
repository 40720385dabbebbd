// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_DYNAMIC_FRAMES_H
#define WEFT_BENCH_DYNAMIC_DYNAMIC_FRAMES_H

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bench/dynamic/dynamic_methods.h"
#include "device/shared_scene.h"
#include "image/image.h"
#include "render/renderer.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft::bench {

/// What a method took for one frame of a sequence, and what came of it.
struct DynamicFrame {
    double ms = 0.0;         ///< wall time of the frame
    double update_ms = 0.0;  ///< before it, of bringing the scene on the device up to date
    std::uint64_t rays = 0;  ///< without primary rays
    std::vector<StageStats> stages;
    std::optional<CacheStats> cache;
    Image light;  ///< the indirect light alone, as the beauty layer
};

/// Renders a sequence by one method, frame by frame.
class DynamicRenderer {
  public:
    /// The executor must outlive it.
    DynamicRenderer(Executor& executor, const DynamicMethod& method, std::uint32_t edge);

    /// The next frame of `flat`, the same object in all frames and at this one already.
    [[nodiscard]] DynamicFrame render(const FlatScene& flat, const Camera& camera);

    [[nodiscard]] const DynamicMethod& method() const { return method_; }

  private:
    void renew(const FlatScene& flat, const Camera& camera);

    DynamicMethod method_;
    std::uint32_t edge_;
    Executor& executor_;
    SharedScene shared_;  ///< of methods that have a new renderer for every frame
    std::unique_ptr<Renderer> renderer_;
    std::uint32_t frame_ = 0;
};

/// Images of a frame by `ir`, whose pixels gather all VPLs: their beauty layers hold the indirect
/// light alone, beside the other layers.
struct ReferenceFrame {
    Image same_vpls;  ///< with those that all methods with fixed random numbers have
    Image converged;  ///< with those and others
};

/// Renders references of a sequence, frame by frame.
class ReferenceRenderer {
  public:
    /// `count`: how many frames, each with VPLs of its own, are averaged for a converged one.
    ReferenceRenderer(Executor& executor, std::uint32_t edge, std::uint32_t count);

    [[nodiscard]] ReferenceFrame render(const FlatScene& flat, const Camera& camera);

  private:
    Executor& executor_;
    std::uint32_t edge_, count_;
    std::unique_ptr<Renderer> renderer_;
};

/// An image in whose place the indirect light is the beauty layer.
void show_indirect(Image& image);

/// Brings a renderer to what its scene is now, and the next image to this camera; returns the
/// wall time, ms.
double follow_scene(Renderer& renderer, const Camera& camera);

}  // namespace weft::bench

#endif
