// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/ray_packets.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft::selftest {
namespace {

glm::vec3 origin_of(const RayBatch& rays, std::size_t i) {
    return {rays.origins[i].x, rays.origins[i].y, rays.origins[i].z};
}

glm::vec3 direction_of(const RayBatch& rays, std::size_t i) {
    return {rays.directions[i].x, rays.directions[i].y, rays.directions[i].z};
}

/// A random point in the unit ball.
glm::dvec3 random_place(Uniform& uniform) {
    for (;;) {
        const float x = uniform(-1.0F, 1.0F);
        const float y = uniform(-1.0F, 1.0F);
        const glm::dvec3 p(x, y, uniform(-1.0F, 1.0F));
        if (glm::dot(p, p) <= 1.0) return p;
    }
}

}  // namespace

RayBatch in_packets(const RayBatch& rays) {
    constexpr std::size_t kinds = 12;
    constexpr std::size_t group = kinds * PACKET_BLOCK;
    RayBatch packets;
    for (std::size_t first = 0; first + group <= rays.size(); first += group)
        for (std::size_t block = first; block < first + kinds; ++block)
            for (const bool aimed : {false, true}) {
                const glm::vec3 origin = origin_of(rays, block);
                for (std::size_t k = 0; k < PACKET_BLOCK; ++k) {
                    const std::size_t i = block + k * kinds;
                    const glm::vec3 own = direction_of(rays, i);
                    const glm::vec3 to_target = origin_of(rays, i) + own - origin;
                    packets.add(origin, aimed && to_target != glm::vec3(0.0F) ? to_target : own);
                }
            }
    return packets;
}

RayBatch packets_inside(const Room& room, std::size_t blocks, std::uint32_t seed) {
    // Farther than any two points of a closed mesh are apart.
    const double beyond = 10.0 * room.scale;
    Uniform uniform(seed);
    RayBatch packets;
    for (std::size_t block = 0; block < blocks; ++block) {
        const glm::vec3 origin(room.centre + 0.9 * room.radius * random_place(uniform));
        for (std::size_t k = 0; k < PACKET_BLOCK; ++k) {
            const auto triangle =
                static_cast<std::uint32_t>(random_index(uniform, room.geometry.triangles.size()));
            const int corner = static_cast<int>(random_index(uniform, 3));
            const glm::vec3 a(room.geometry.corner(triangle, corner));
            const glm::vec3 b(room.geometry.corner(triangle, (corner + 1) % 3));
            const float along = uniform(0.0F, 1.0F);
            const std::array directions{a - origin, a + along * (b - a) - origin,
                                        glm::vec3(random_place(uniform))};
            glm::vec3 direction = directions.at(k % directions.size());
            if (direction == glm::vec3(0.0F)) direction.z = 1.0F;
            // Scaling by a power of two does not change the line.
            const double length = glm::length(glm::dvec3(direction));
            packets.add(origin, direction * static_cast<float>(
                                                std::exp2(std::ceil(std::log2(beyond / length)))));
        }
    }
    return packets;
}

PacketBatch shadow_packets(const RayBatch& packets) {
    PacketBatch shadows;
    for (std::size_t i = 0; i < packets.size(); ++i) {
        if (i % PACKET_BLOCK == 0) shadows.start_block(origin_of(packets, i));
        shadows.add(direction_of(packets, i));
    }
    return shadows;
}

std::vector<int> blocked_in_packets(const RayQueries& queries, const RayBatch& packets) {
    std::vector<int> blocked;
    for (const float answer : queries.packets(shadow_packets(packets)))
        blocked.push_back(answer > 0.0F ? 1 : 0);
    return blocked;
}

}  // namespace weft::selftest
