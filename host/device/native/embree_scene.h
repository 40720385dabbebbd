// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_EMBREE_SCENE_H
#define WEFT_DEVICE_NATIVE_EMBREE_SCENE_H

#include <memory>
#include <string>

#include "device/executor.h"
#include "device/native/embree.h"

namespace weft {

/// An Embree scene of one triangle mesh whose primitive ids are the triangle ids. Robust mode and
/// never COHERENT: a ray's result must not depend on its packet.
class EmbreeScene {
  public:
    /// Uses the geometry's memory; it must outlive this object. `threads` is 0 for all.
    EmbreeScene(const TracedGeometry& geometry, int threads);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    [[nodiscard]] RTCScene handle() const noexcept { return scene_; }

  private:
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

/// "3.13.5", as the library that is loaded says.
[[nodiscard]] std::string embree_version();

}  // namespace weft

#endif
