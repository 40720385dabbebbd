// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_NATIVE_EMBREE_SCENE_H
#define WEFT_DEVICE_NATIVE_EMBREE_SCENE_H

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bvh/embree_device.h"
#include "device/executor.h"

namespace weft {

/// Scene flags for tracing images: Embree's robust mode, and queries may have a filter of their own
/// (embree_candidates).
#if WEFT_EMBREE_MAJOR >= 4
inline const int embree_render_flags =
    RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
inline const int embree_render_flags =
    RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

/// Triangles as an Embree scene: one mesh of the highest build quality and, where some may move, a
/// second mesh of those, which can be updated alone. Queries for images are never COHERENT: a ray's
/// result must not depend on its packet.
class EmbreeScene {
  public:
    /// Uses the geometry's memory; it must outlive this object. `threads` is 0 for all.
    /// Throws Error (exit code 3 or 4).
    EmbreeScene(const TracedGeometry& geometry, int threads, int flags = embree_render_flags);
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Brings the moving triangles up to date with the geometry, which is that of the constructor
    /// at another time. Throws as the constructor.
    void update(const TracedGeometry& geometry);

    [[nodiscard]] RTCScene handle() const noexcept { return scene_.get(); }
    /// The triangle that a hit of the scene is on.
    [[nodiscard]] unsigned int triangle_of(unsigned int mesh,
                                           unsigned int primitive) const noexcept {
        return mesh == moving_mesh ? first_moving_ + primitive : primitive;
    }

  private:
    static constexpr unsigned int resting_mesh = 0;
    static constexpr unsigned int moving_mesh = 1;

    void attach(const TracedGeometry& geometry, std::size_t first, std::size_t end,
                unsigned int mesh);
    /// Chooses the moving triangles that are given to Embree. Returns whether there are any.
    bool choose_moving(const TracedGeometry& geometry);

    struct ReleaseScene {
        using pointer = RTCScene;
        void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
    };

    EmbreeDevice device_;
    std::unique_ptr<RTCScene, ReleaseScene> scene_;
    unsigned int first_moving_ = 0;
    bool moves_ = false;
    std::vector<std::array<unsigned int, 3>> moving_;  ///< vertex indices of moving triangles
};

/// Version of the library that is loaded, such as "3.13.5".
[[nodiscard]] std::string embree_version();

}  // namespace weft

#endif
