// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_SHARED_SCENE_H
#define WEFT_DEVICE_SHARED_SCENE_H

#include <memory>

#include "device/forwarding_executor.h"

namespace weft {

/// Passes everything on to another executor, but builds the acceleration structure only once: all
/// scenes that are made while this executor lives share it.
class SharedScene : public ForwardingExecutor {
  public:
    using ForwardingExecutor::ForwardingExecutor;

    /// Every call has to be given the same geometry; the first one builds.
    [[nodiscard]] std::unique_ptr<TracedScene> make_scene(const TracedGeometry& geometry) override;
    void update_scene(TracedScene& scene, const TracedGeometry& geometry) override;
    bool run(const Launch& launch, const std::function<bool(double)>& keep_going) override;

  private:
    std::unique_ptr<TracedScene> scene_;
};

}  // namespace weft

#endif
