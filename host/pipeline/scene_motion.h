// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_SCENE_MOTION_H
#define WEFT_PIPELINE_SCENE_MOTION_H

#include <cstdint>
#include <memory>
#include <vector>

#include "device/device_buffer.h"
#include "scene/flat_scene.h"
#include "shared/triangle_soup.h"

namespace weft {

/// Finds what has changed in a scene since the frame before by comparing the two, so that nothing
/// needs to know how objects move.
class SceneMotion {
  public:
    explicit SceneMotion(Executor& executor);

    /// Compares the scene with what it was at the call before. At the first call all of it is new.
    void observe(Executor& executor, const FlatScene& scene);
    /// Reports everything as changed, geometry included.
    void invalidate_everything(Executor& executor);
    /// Reports nothing as changed.
    void forget();

    /// Whether anything that light depends on has changed.
    [[nodiscard]] bool any() const { return any_; }
    /// Whether nothing from before can be used: rays start elsewhere on all surfaces.
    [[nodiscard]] bool all() const { return all_; }
    /// By instance: whether any vertex of it has moved, or its triangles have turned.
    [[nodiscard]] const std::vector<bool>& moved_instances() const { return moved_; }

    /// Triangles of the instances that have moved, both where they were and where they are.
    [[nodiscard]] const TracedScene& traced() const { return *traced_; }
    [[nodiscard]] TriangleSoup triangles() const { return {positions_, triangles_}; }
    /// Boxes about each of these instances at both places (kernels/bvh/moved.h).
    [[nodiscard]] BufferRef<kinds::MovedBounds> boxes() const { return boxes_; }
    [[nodiscard]] std::uint32_t box_count() const { return box_count_; }

  private:
    /// The parts of a scene that are compared.
    struct Snapshot {
        std::vector<shared::float4> positions;  ///< of instances that may move
        std::vector<float> normals;
        std::vector<shared::Triangle> triangles;
        std::vector<shared::MaterialRecord> materials;
        std::vector<shared::LightRecord> lights;
        std::vector<shared::EmissiveTriangle> emissive;
        float extent = -1.0F;
    };
    static Snapshot snapshot_of(const FlatScene& scene);
    void find_moved(const FlatScene& scene, const Snapshot& now);
    void add_moved(const FlatScene& scene, const Snapshot& at, std::uint32_t instance);
    void upload(Executor& executor);

    Snapshot before_;
    bool any_ = false;
    bool all_ = false;
    std::vector<bool> moved_;
    std::vector<shared::float4> positions_;
    std::vector<shared::Triangle> triangles_;
    std::vector<shared::float4> corners_;
    std::unique_ptr<TracedScene> traced_;
    DeviceBuffer<kinds::MovedBounds> boxes_;
    std::uint32_t box_count_ = 0;
};

}  // namespace weft

#endif
