// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_EMBREE_SCENE_H
#define WEFT_DEVICE_NATIVE_EMBREE_SCENE_H

#include <memory>
#include <string>

#include "device/executor.h"
#include "device/native/embree.h"

namespace weft {

/// What pictures are traced with: Embree's robust mode, and queries may bring a filter of their own
/// (embree_candidates).
#if WEFT_EMBREE_MAJOR >= 4
inline const int embree_render_flags =
    RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
inline const int embree_render_flags =
    RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

/// An Embree scene of one triangle mesh whose primitive ids are the triangle ids, of the highest
/// build quality. Queries for pictures are never COHERENT: a ray's result must not depend on its
/// packet.
class EmbreeScene {
  public:
    /// Uses the geometry's memory; it must outlive this object. `threads` is 0 for all.
    /// Throws Error (exit code 3 or 4).
    EmbreeScene(const TracedGeometry& geometry, int threads, int flags = embree_render_flags);
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
