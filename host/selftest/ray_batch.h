// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_RAY_BATCH_H
#define WEFT_SELFTEST_RAY_BATCH_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "device/launch.h"
#include "scene/flat_scene.h"

namespace weft::selftest {

/// The t_max of infinite rays, as in the kernels.
constexpr float ray_infinity = 3.0e38F;

/// Triangles to trace, in kernel units.
struct RayGeometry {
    std::vector<shared::float4> positions;
    std::vector<shared::Triangle> triangles;

    [[nodiscard]] glm::dvec3 corner(std::uint32_t triangle, int k) const {
        const shared::Triangle& t = triangles[triangle];
        const shared::float4& p = positions[k == 0 ? t.v0 : (k == 1 ? t.v1 : t.v2)];
        return {p.x, p.y, p.z};
    }
    /// Largest |coordinate|, as FlatScene::extent.
    [[nodiscard]] float extent() const {
        float largest = 0.0F;
        for (const shared::float4& p : positions)
            largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        return largest > 0.0F ? largest : 1.0F;
    }
};

/// Rays as query_closest and query_any read them.
struct RayBatch {
    std::vector<shared::float4> origins;  // w: t_max
    std::vector<shared::float4> directions;

    void add(const glm::vec3& origin, const glm::vec3& direction, float t_max = ray_infinity) {
        origins.push_back({origin.x, origin.y, origin.z, t_max});
        directions.push_back({direction.x, direction.y, direction.z, 0.0F});
    }
    [[nodiscard]] std::size_t size() const { return origins.size(); }
    [[nodiscard]] glm::dvec3 origin(std::size_t i) const {
        return {origins[i].x, origins[i].y, origins[i].z};
    }
    [[nodiscard]] glm::dvec3 direction(std::size_t i) const {
        return {directions[i].x, directions[i].y, directions[i].z};
    }
};

/// A closest hit as query_closest writes it.
struct RayHit {
    std::uint32_t triangle;  // INVALID_INDEX for a miss
    float t, u, v;

    /// Whether all bits are equal.
    [[nodiscard]] bool operator==(const RayHit& other) const {
        return std::memcmp(this, &other, sizeof(RayHit)) == 0;
    }
};

/// Shadow rays as query_packet reads them: blocks of PACKET_BLOCK rays that start at one point.
struct PacketBatch {
    std::vector<shared::float4> origins;  // by block
    std::array<std::vector<float>, 4> planes;

    /// Starts a block, to which the next PACKET_BLOCK rays belong.
    void start_block(const glm::vec3& origin) {
        origins.push_back({origin.x, origin.y, origin.z, 0.0F});
    }
    void add(const glm::vec3& d, bool active = true) {
        for (std::size_t k = 0; k < 3; ++k) planes[k].push_back(d[static_cast<int>(k)]);
        planes[3].push_back(active ? 1.0F : 0.0F);
    }
    [[nodiscard]] std::size_t slots() const { return planes[0].size(); }
};

/// Traces rays in a scene on an executor, by the kernels that query rays.
class RayQueries {
  public:
    /// Executor and geometry must outlive this object. Boxes grow by `padding` times the extent, by
    /// default as in the renderer. Triangles from `first_moving` on may move.
    RayQueries(Executor& executor, const RayGeometry& geometry, float padding = 0x1p-22F,
               std::size_t first_moving = std::numeric_limits<std::size_t>::max())
        : executor_(executor),
          geometry_(geometry),
          padding_(padding),
          first_moving_(first_moving),
          scene_(executor.make_scene(traced())) {
        constexpr std::array kernels{KernelId::query_closest, KernelId::query_closest_packet,
                                     KernelId::query_any, KernelId::query_packet};
        executor_.build(kernels, 0);
    }

    /// To be called after the geometry's moving triangles have changed.
    void update() { executor_.update_scene(*scene_, traced()); }

    [[nodiscard]] std::vector<RayHit> closest(const RayBatch& rays) const {
        return run_rays<kernels::query_closest, kinds::RayHits, RayHit>(rays, rays.size());
    }
    /// The same in packets of consecutive rays, which start at one point; their number is a
    /// multiple of PACKET_BLOCK. Rays with t_max 0 are left out, the others are infinite.
    [[nodiscard]] std::vector<RayHit> closest_packets(const RayBatch& rays) const {
        return run_rays<kernels::query_closest_packet, kinds::RayHits, RayHit>(
            rays, rays.size() / executor_.lanes());
    }
    /// 1 for rays that are blocked before their t_max.
    [[nodiscard]] std::vector<int> any(const RayBatch& rays) const {
        return run_rays<kernels::query_any, kinds::RaysBlocked, int>(rays, rays.size());
    }
    /// 1 for rays that are blocked before SHADOW_END, by slot.
    [[nodiscard]] std::vector<float> packets(const PacketBatch& packets) const {
        std::vector<float> planes;
        for (const std::vector<float>& plane : packets.planes)
            planes.insert(planes.end(), plane.begin(), plane.end());
        const auto slots = static_cast<std::uint32_t>(packets.slots());
        const auto origins =
            upload<kinds::BlockOrigins>(executor_, packets.origins, "packet origins");
        const auto rays = upload<kinds::PacketRays>(executor_, planes, "packet rays");
        const auto blocked =
            upload<kinds::PacketBlocked>(executor_, std::vector<float>(slots), "answers");
        run_kernel(executor_, {},
                   kernels::query_packet{.scene = *scene_,
                                         .slots = slots,
                                         .block_origin = origins,
                                         .rays = rays,
                                         .blocked = blocked},
                   slots / executor_.lanes());
        (void)executor_.take_milliseconds();
        return read_buffer(executor_, blocked, slots);
    }

  private:
    [[nodiscard]] TracedGeometry traced() const {
        return {geometry_.positions, geometry_.triangles, geometry_.extent() * padding_,
                first_moving_};
    }
    /// Runs a kernel that answers single rays, with arguments scene, origins, directions, answers.
    template <class Kernel, class Answers, class Answer>
    [[nodiscard]] std::vector<Answer> run_rays(const RayBatch& rays, std::size_t items) const {
        const auto origins = upload<kinds::RayOrigins>(executor_, rays.origins, "ray origins");
        const auto directions =
            upload<kinds::RayDirections>(executor_, rays.directions, "ray directions");
        const std::vector<typename Answers::Element> none(rays.size());
        const auto answers = upload<Answers>(executor_, none, "answers");
        run_kernel(executor_, {}, Kernel{*scene_, origins, directions, answers},
                   static_cast<std::uint32_t>(items));
        (void)executor_.take_milliseconds();
        return read_buffer<Answer>(executor_, *answers, rays.size());
    }

    Executor& executor_;
    const RayGeometry& geometry_;
    float padding_;
    std::size_t first_moving_;
    std::unique_ptr<TracedScene> scene_;
};

/// The geometry of a flattened scene.
inline RayGeometry geometry_of(const FlatScene& flat) {
    return {flat.positions, flat.triangles};
}

}  // namespace weft::selftest

#endif
