// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/ray_sets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

#include "base/error.h"
#include "kernels/core/receivers.h"

namespace weft::bench {
namespace {

constexpr float ray_infinity = 3.0e38F;

/// Uniform numbers in [0, 1), the same with every standard library.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    float uniform() { return static_cast<float>(engine_() >> 40) * 0x1p-24F; }
    std::size_t below(std::size_t count) { return engine_() % count; }

  private:
    std::mt19937_64 engine_;
};

glm::vec3 vec(const shared::float4& v) {
    return {v.x, v.y, v.z};
}

shared::float4 pack(const glm::vec3& v, float w = 0.0F) {
    return {v.x, v.y, v.z, w};
}

glm::vec3 cosine_direction(const glm::vec3& normal, Random& random) {
    const float angle = 2.0F * std::numbers::pi_v<float> * random.uniform();
    const float square = random.uniform();
    const glm::vec3 helper = std::abs(normal.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 tangent = glm::normalize(glm::cross(helper, normal));
    const glm::vec3 bitangent = glm::cross(normal, tangent);
    const float radius = std::sqrt(square);
    return tangent * (radius * std::cos(angle)) + bitangent * (radius * std::sin(angle)) +
           normal * std::sqrt(1.0F - square);
}

/// Reads the planes of receivers.
class Receivers {
  public:
    explicit Receivers(const RecordedFrame& frame)
        : planes_(frame.receivers),
          slots_(frame.slots),
          smooth_((frame.params.features & FEATURE_SMOOTH_NORMALS) != 0) {}

    [[nodiscard]] bool valid(std::size_t slot) const { return at(RECEIVER_VALID, slot) > 0.0F; }
    [[nodiscard]] glm::vec3 position(std::size_t slot) const { return three(RECEIVER_X, slot); }
    [[nodiscard]] glm::vec3 shading(std::size_t slot) const {
        return three(RECEIVER_SHADING_X, slot);
    }
    [[nodiscard]] glm::vec3 normal(std::size_t slot) const {
        return three(smooth_ ? RECEIVER_NORMAL_X : RECEIVER_SHADING_X, slot);
    }

  private:
    [[nodiscard]] float at(std::size_t plane, std::size_t slot) const {
        return planes_[plane * slots_ + slot];
    }
    [[nodiscard]] glm::vec3 three(std::size_t plane, std::size_t slot) const {
        return {at(plane, slot), at(plane + 1, slot), at(plane + 2, slot)};
    }

    const std::vector<float>& planes_;
    std::size_t slots_;
    bool smooth_;
};

SurfacePoint point_of(const FlatScene& scene, const QueryHit& hit, const glm::vec3& towards) {
    const shared::Triangle& triangle = scene.triangles[hit.triangle];
    const glm::vec3 a = vec(scene.positions[triangle.v0]);
    const glm::vec3 b = vec(scene.positions[triangle.v1]);
    const glm::vec3 c = vec(scene.positions[triangle.v2]);
    const glm::dvec3 edge1 = glm::dvec3(b) - glm::dvec3(a);
    const glm::dvec3 edge2 = glm::dvec3(c) - glm::dvec3(a);
    glm::vec3 normal(glm::normalize(glm::cross(edge1, edge2)));
    if (glm::dot(normal, towards) > 0.0F) normal = -normal;
    const glm::vec3 position = a * (1.0F - hit.u - hit.v) + b * hit.u + c * hit.v;
    return {pack(position + normal * (scene.extent * 0x1p-18F)), pack(normal)};
}

/// One ray from a random receiver each.
RaySet first_bounces(const RecordedFrame& frame, std::size_t count, Random& random) {
    const Receivers receivers(frame);
    std::vector<std::size_t> valid;
    for (std::size_t slot = 0; slot < frame.slots; ++slot)
        if (receivers.valid(slot)) valid.push_back(slot);
    if (valid.empty()) throw Error(ExitCode::bad_input, "the camera sees no surface");
    RaySet rays;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t slot = valid[random.below(valid.size())];
        rays.origins.push_back(pack(receivers.position(slot), ray_infinity));
        rays.directions.push_back(pack(cosine_direction(receivers.normal(slot), random)));
    }
    return rays;
}

/// The lanes of one block against one VPL; the conditions are those of vpl_gather.cl.
std::size_t add_block(const Receivers& receivers, std::size_t first_slot, const shared::Vpl& vpl,
                      PacketSet& packets, std::array<std::vector<float>, 4>& planes) {
    std::array<glm::vec4, PACKET_BLOCK> lanes{};
    std::size_t useful = 0;
    const bool surface = std::bit_cast<std::uint32_t>(vpl.normal.w) == VPL_SURFACE;
    for (std::size_t lane = 0; lane < PACKET_BLOCK; ++lane) {
        const std::size_t slot = first_slot + lane;
        const glm::vec3 d = receivers.position(slot) - vec(vpl.position);
        lanes[lane] = glm::vec4(d, 0.0F);
        if (!receivers.valid(slot)) continue;
        if (!(glm::dot(d, receivers.shading(slot)) < 0.0F)) continue;
        if (!(glm::dot(d, receivers.normal(slot)) < 0.0F)) continue;
        if (surface && !(glm::dot(d, vec(vpl.normal)) > 0.0F)) continue;
        lanes[lane].w = 1.0F;
        ++useful;
    }
    if (useful == 0) return 0;
    packets.block_origins.push_back(vpl.position);
    for (const glm::vec4& lane : lanes)
        for (int axis = 0; axis < 4; ++axis)
            planes[static_cast<std::size_t>(axis)].push_back(lane[axis]);
    return useful;
}

}  // namespace

RaySet primary_rays(const RecordedFrame& frame) {
    constexpr std::uint32_t tile = 8;
    const shared::CameraParams& p = frame.params.camera;
    RaySet rays;
    for (std::uint32_t top = 0; top < p.height; top += tile)
        for (std::uint32_t left = 0; left < p.width; left += tile)
            for (std::uint32_t i = 0; i < tile * tile; ++i) {
                const std::uint32_t x = left + i % tile;
                const std::uint32_t y = top + i / tile;
                if (x >= p.width || y >= p.height) continue;
                const float s =
                    2.0F * (static_cast<float>(x) + 0.5F) / static_cast<float>(p.width) - 1.0F;
                const float t =
                    1.0F - 2.0F * (static_cast<float>(y) + 0.5F) / static_cast<float>(p.height);
                rays.origins.push_back(pack(vec(p.origin), ray_infinity));
                rays.directions.push_back(pack(vec(p.forward) + vec(p.right) * s + vec(p.up) * t));
            }
    return rays;
}

std::vector<SurfacePoint> bounce_points(const FlatScene& scene, const RecordedFrame& frame,
                                        const ClosestTracer& trace, std::size_t count) {
    Random random(1);
    std::vector<SurfacePoint> points;
    for (int attempt = 0; attempt < 64 && points.size() < count; ++attempt) {
        const RaySet rays = first_bounces(frame, count, random);
        const std::vector<QueryHit> hits = trace(rays);
        for (std::size_t i = 0; i < hits.size() && points.size() < count; ++i)
            if (hits[i].triangle != INVALID_INDEX)
                points.push_back(point_of(scene, hits[i], vec(rays.directions[i])));
    }
    if (points.size() < count)
        throw Error(ExitCode::bad_input, "the scene is too open: most light leaves it at once");
    return points;
}

RaySet bounce_rays(const std::vector<SurfacePoint>& points) {
    Random random(2);
    RaySet rays;
    for (const SurfacePoint& point : points) {
        rays.origins.push_back(pack(vec(point.position), ray_infinity));
        rays.directions.push_back(pack(cosine_direction(vec(point.normal), random)));
    }
    return rays;
}

RaySet segments(const std::vector<SurfacePoint>& points) {
    Random random(3);
    RaySet rays;
    for (const SurfacePoint& point : points) {
        const glm::vec3 start = vec(point.position);
        glm::vec3 d(0.0F);
        while (d == glm::vec3(0.0F)) d = vec(points[random.below(points.size())].position) - start;
        rays.origins.push_back(pack(start, SHADOW_END));
        rays.directions.push_back(pack(d));
    }
    return rays;
}

PacketSet shadow_packets(const RecordedFrame& frame, std::size_t slots) {
    constexpr std::size_t run = 16;  // neighbouring blocks that are taken together
    const Receivers receivers(frame);
    const shared::SamplingParams& sampling = frame.params.sampling;
    const shared::SetList& list = frame.list;
    const std::size_t runs = frame.block_sets.size() / run;
    const std::size_t wanted =
        std::clamp<std::size_t>(slots / (run * PACKET_BLOCK * list.length), 1, runs);
    PacketSet packets;
    std::array<std::vector<float>, 4> planes;
    for (std::size_t i = 0; i < wanted; ++i)
        for (std::size_t block = i * runs / wanted * run, k = 0; k < run; ++k, ++block) {
            const std::uint32_t set =
                (frame.block_sets[block] + sampling.set_rotation) % sampling.gather_sets;
            const std::size_t first = list.first + std::size_t{set} * list.stride;
            for (std::size_t v = first; v < first + list.length; ++v) {
                const shared::Vpl& vpl = frame.vpls[v];
                if (!(vpl.flux.x > 0.0F || vpl.flux.y > 0.0F || vpl.flux.z > 0.0F)) continue;
                packets.rays += add_block(receivers, block * PACKET_BLOCK, vpl, packets, planes);
            }
        }
    if (packets.rays == 0) throw Error(ExitCode::bad_input, "no VPL reaches what the camera sees");
    for (const auto& plane : planes)
        packets.planes.insert(packets.planes.end(), plane.begin(), plane.end());
    return packets;
}

}  // namespace weft::bench
