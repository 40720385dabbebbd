// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "tests/testing/bvh_meshes.h"
#include "tests/testing/ray_batch.h"
#include "tests/testing/ray_fans.h"
#include "tests/testing/ray_oracle.h"
#include "tests/testing/watertight.h"

// Shadow rays in packets: the answer of a ray is its own, however wide packets are and whichever
// rays share them, and it is that of a single ray but for rounding.
namespace weft::packet_test {
namespace {

using test::Fan;
using test::fans;
using test::PacketBatch;
using test::random_index;
using test::random_point;
using test::RayGeometry;
using test::soup;
using test::TestBackend;
using test::Uniform;

/// Fans one after the other in blocks of their own.
PacketBatch in_order(const std::vector<Fan>& all) {
    PacketBatch packets;
    for (const Fan& fan : all)
        for (std::size_t i = 0; i < fan.ends.size(); ++i) {
            if (i % PACKET_BLOCK == 0) packets.start_block(fan.origin);
            packets.add(fan.ends[i]);
        }
    return packets;
}

std::vector<float> trace(TestBackend backend, std::uint32_t lanes, const RayGeometry& geometry,
                         const PacketBatch& packets) {
    const auto executor = test::make_executor(backend, lanes);
    EXPECT_EQ(executor->lanes(), lanes);
    return test::RayQueries(*executor, geometry).packets(packets);
}

std::size_t differences(const std::vector<float>& a, const std::vector<float>& b) {
    EXPECT_EQ(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
}

std::size_t blocked_count(const std::vector<float>& answers) {
    return static_cast<std::size_t>(std::accumulate(answers.begin(), answers.end(), 0.0));
}

constexpr std::array<std::uint32_t, 4> widths{1, 4, 8, 16};

TEST(Packet, EveryWidthAndBackendGivesTheSameAnswers) {
    const RayGeometry geometry = soup();
    const PacketBatch packets = in_order(fans(300, 31));
    const std::vector<float> expected = trace(TestBackend::own_bvh, 1, geometry, packets);
    EXPECT_GT(blocked_count(expected), packets.slots() / 10);
    EXPECT_LT(blocked_count(expected), packets.slots() * 9 / 10);
    for (const TestBackend backend : test::backends())
        for (const std::uint32_t lanes : widths) {
            if (backend == TestBackend::embree) continue;
            EXPECT_EQ(differences(trace(backend, lanes, geometry, packets), expected), 0U)
                << test::backend_name(backend) << ", " << lanes << " lanes";
        }
}

/// Every ray of the fans once, at a random place of a random block of its fan, beside rays that
/// are not to be traced or that nobody asked for.
struct Shuffled {
    PacketBatch packets;
    std::vector<std::size_t> slot_of;  // by ray, fans one after the other
};

Shuffled shuffle(const std::vector<Fan>& all, std::uint32_t seed) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    Uniform uniform(seed);
    std::mt19937 engine(seed);
    Shuffled result;
    std::size_t base = 0;
    for (const Fan& fan : all) {
        const std::size_t slots = 3 * fan.ends.size();
        std::vector<std::size_t> ray_at(slots, SIZE_MAX);
        std::iota(ray_at.begin(), ray_at.begin() + static_cast<std::ptrdiff_t>(fan.ends.size()),
                  std::size_t{0});
        for (std::size_t i = slots - 1; i > 0; --i)
            std::swap(ray_at[i], ray_at[engine() % (i + 1)]);
        result.slot_of.resize(base + fan.ends.size());
        for (std::size_t i = 0; i < slots; ++i) {
            if (i % PACKET_BLOCK == 0) result.packets.start_block(fan.origin);
            if (ray_at[i] != SIZE_MAX) {
                result.slot_of[base + ray_at[i]] = result.packets.slots();
                result.packets.add(fan.ends[ray_at[i]]);
            } else if (i % 2 == 0) {
                result.packets.add(random_point(uniform, -3.0F, 3.0F));
            } else {
                constexpr std::array odd{0.0F, -1.0F, 1e30F, infinity, nan};
                result.packets.add(glm::vec3(odd.at(random_index(uniform, odd.size())),
                                             odd.at(random_index(uniform, odd.size())),
                                             odd.at(random_index(uniform, odd.size()))),
                                   false);
            }
        }
        base += fan.ends.size();
    }
    return result;
}

TEST(Packet, NoLaneDependsOnItsCompany) {
    const RayGeometry geometry = soup();
    const std::vector<Fan> all = fans(200, 32);
    const std::vector<float> expected = trace(TestBackend::own_bvh, 1, geometry, in_order(all));
    for (const TestBackend backend : test::backends())
        for (const std::uint32_t lanes : widths) {
            if (backend == TestBackend::embree) continue;
            for (const std::uint32_t seed : {1U, 2U}) {
                const Shuffled shuffled = shuffle(all, seed);
                const std::vector<float> answers =
                    trace(backend, lanes, geometry, shuffled.packets);
                std::size_t different = 0;
                for (std::size_t i = 0; i < expected.size(); ++i)
                    different += answers[shuffled.slot_of[i]] != expected[i] ? 1 : 0;
                EXPECT_EQ(different, 0U)
                    << test::backend_name(backend) << ", " << lanes << " lanes";
                std::size_t answered = 0;
                for (std::size_t i = 0; i < answers.size(); ++i)
                    answered += shuffled.packets.planes[3][i] == 0.0F && answers[i] != 0.0F ? 1 : 0;
                EXPECT_EQ(answered, 0U) << "lanes that are not to be traced";
            }
        }
}

/// Distance of a ray from the border of some triangle that it meets or nearly meets, as the
/// smallest barycentric coordinate, or how far the triangle is from being cut by the segment's end.
double nearness_to_an_edge(const RayGeometry& geometry, const glm::vec3& origin,
                           const glm::vec3& d) {
    double nearest = INFINITY;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const test::Verdict v = test::judge(origin, d, 1.0, geometry, i);
        if (!v.may_hit) continue;
        nearest = std::min(nearest, std::abs(v.inside));
        const double t = 0.5 * (v.low + v.high);
        nearest = std::min({nearest, std::abs(t), std::abs(t - static_cast<double>(SHADOW_END))});
    }
    return nearest;
}

/// Segments of the fans on which packets and another judge differ: at most one of 10^4, each
/// within 10^-4 of the border of a triangle of size 0.15. Packets take 2^-20 of the distance around
/// a triangle for inside, and 450 edges 0.15 long fill less than 10^-4 of a view with that width.
void expect_differences_at_edges(const RayGeometry& geometry, const std::vector<Fan>& all,
                                 const std::vector<float>& packets, const std::vector<int>& other,
                                 const std::string& where) {
    std::size_t ray = 0;
    std::size_t different = 0;
    for (const Fan& fan : all)
        for (const glm::vec3& d : fan.ends) {
            const int packet = packets[ray] > 0.0F ? 1 : 0;
            if (packet != other[ray]) {
                ++different;
                EXPECT_LT(nearness_to_an_edge(geometry, fan.origin, d), 1e-4) << where;
            }
            ++ray;
        }
    EXPECT_LE(different, ray / 10000) << where;
    std::cout << where << ": " << different << " of " << ray << " rays differ\n";
}

test::RayBatch as_rays(const std::vector<Fan>& all) {
    test::RayBatch rays;
    for (const Fan& fan : all)
        for (const glm::vec3& d : fan.ends) rays.add(fan.origin, d, SHADOW_END);
    return rays;
}

TEST(Packet, AgreesWithSingleRaysExceptAtEdges) {
    const RayGeometry geometry = soup();
    const std::vector<Fan> all = fans(4000, 33);
    const PacketBatch packets = in_order(all);
    const test::RayBatch rays = as_rays(all);
    for (const TestBackend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        expect_differences_at_edges(geometry, all, queries.packets(packets), queries.any(rays),
                                    std::string("single rays, ") + test::backend_name(backend));
    }
}

TEST(Packet, AgreesWithEmbreeExceptAtEdges) {
    const RayGeometry geometry = soup();
    const std::vector<Fan> all = fans(4000, 34);
    const PacketBatch packets = in_order(all);
    const test::RayQueries own(test::shared_executor(TestBackend::own_bvh), geometry);
    const std::vector<float> expected = own.packets(packets);
    for (const std::uint32_t lanes : widths) {
        std::vector<int> embree;
        for (const float answer : trace(TestBackend::embree, lanes, geometry, packets))
            embree.push_back(answer > 0.0F ? 1 : 0);
        expect_differences_at_edges(geometry, all, expected, embree,
                                    "Embree, " + std::to_string(lanes) + " lanes");
    }
}

TEST(Packet, AgreesWithDoublePrecisionWhereThatIsClear) {
    const RayGeometry geometry = soup();
    const std::vector<Fan> all = fans(300, 35);
    const PacketBatch packets = in_order(all);
    for (const TestBackend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        const std::vector<float> answers = queries.packets(packets);
        std::size_t ray = 0;
        std::size_t clear = 0;
        std::size_t wrong = 0;
        for (const Fan& fan : all)
            for (const glm::vec3& d : fan.ends) {
                const test::ClosestVerdict v =
                    test::judge_closest(geometry, fan.origin, d, static_cast<double>(SHADOW_END));
                const bool blocked = answers[ray++] > 0.0F;
                if (!v.must_hit_any && v.may_hit_any) continue;
                ++clear;
                wrong += blocked == v.must_hit_any ? 0 : 1;
            }
        EXPECT_EQ(wrong, 0U) << test::backend_name(backend);
        EXPECT_GT(clear, ray * 99 / 100);
    }
}

/// From a point of a room through points of its edges, or through its vertices, to beyond.
Fan fan_through(const test::Room& room, bool vertices, Uniform& uniform) {
    Fan fan;
    fan.origin = glm::vec3(room.centre + 0.5 * room.radius * glm::dvec3(uniform(-1.0F, 1.0F)));
    for (std::size_t i = 0; i < std::size_t{64} * PACKET_BLOCK; ++i) {
        const auto t =
            static_cast<std::uint32_t>(random_index(uniform, room.geometry.triangles.size()));
        const int k = static_cast<int>(i % 3);
        const glm::vec3 a(room.geometry.corner(t, k));
        const glm::vec3 b(room.geometry.corner(t, (k + 1) % 3));
        const glm::vec3 target = vertices ? a : a + uniform(0.05F, 0.95F) * (b - a);
        fan.ends.push_back(2.0F * (target - fan.origin));
    }
    return fan;
}

TEST(Packet, NothingGetsThroughSharedEdgesAndVertices) {
    Uniform uniform(37);
    for (const TestBackend backend : test::backends()) {
        if (backend == TestBackend::embree) continue;
        for (const test::ClosedMesh& mesh : test::closed_meshes()) {
            for (const test::Placement& placement : test::placements()) {
                const test::Room room = test::place(mesh.mesh, placement);
                const test::RayQueries queries(test::shared_executor(backend), room.geometry);
                for (int repeat = 0; repeat < 10; ++repeat)
                    for (const bool vertices : {false, true}) {
                        const std::vector<Fan> fan{fan_through(room, vertices, uniform)};
                        const std::vector<float> answers = queries.packets(in_order(fan));
                        // A dent may hold a segment's end; single rays, which are watertight
                        // (watertight_test), know.
                        const std::vector<int> single = queries.any(as_rays(fan));
                        std::size_t open = 0;
                        for (std::size_t i = 0; i < answers.size(); ++i)
                            open += answers[i] == 0.0F && single[i] == 1 ? 1 : 0;
                        EXPECT_EQ(open, 0U)
                            << test::backend_name(backend) << ", " << mesh.name << ", "
                            << placement.name << (vertices ? ", vertices" : ", edges");
                        EXPECT_GT(blocked_count(answers), answers.size() * 9 / 10);
                    }
            }
        }
    }
}

TEST(Packet, ARayExactlyThroughAnEdgeOrVertexIsBlocked) {
    // From above the middle of a grid of 1/8; all products are exact.
    const test::BvhMesh mesh = test::flat_grid(8);
    const RayGeometry geometry{mesh.positions, mesh.triangles};
    Fan fan{glm::vec3(0.5F, 0.5F, 1.0F), {}};
    for (int y = 1; y < 16; ++y)
        for (int x = 1; x < 17; ++x)
            fan.ends.emplace_back(static_cast<float>(x % 16) / 8.0F - 1.0F,
                                  static_cast<float>(y) / 8.0F - 1.0F, -1.0F);
    for (const TestBackend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), geometry);
        const std::vector<float> answers = queries.packets(in_order({fan}));
        std::size_t open = 0;
        for (std::size_t i = 0; i < answers.size(); ++i)
            open += i % 16 != 15 && answers[i] != 1.0F ? 1 : 0;  // the last column is the border
        EXPECT_EQ(open, 0U) << test::backend_name(backend);
    }
}

TEST(Packet, ASegmentThatEndsInASurfaceIsNotBlockedByIt) {
    // SHADOW_END leaves out the end, which rounding puts before or behind the surface; a surface a
    // hundredth before the end blocks. Rays from inside meet the icosphere only once.
    const test::Room room = test::place(test::closed_meshes()[1].mesh, test::placements().front());
    Fan fan{glm::vec3(room.centre), {}};
    Uniform uniform(36);
    for (std::size_t i = 0; i < std::size_t{256} * PACKET_BLOCK; ++i) {
        const auto t = static_cast<std::uint32_t>(i % room.geometry.triangles.size());
        const double u = static_cast<double>(uniform(0.2F, 0.4F));
        const double v = static_cast<double>(uniform(0.2F, 0.4F));
        const glm::dvec3 a = room.geometry.corner(t, 0);
        const glm::vec3 end(a + u * (room.geometry.corner(t, 1) - a) +
                            v * (room.geometry.corner(t, 2) - a));
        fan.ends.push_back((end - fan.origin) * (i % 2 == 0 ? 1.0F : 1.01F));
    }
    for (const TestBackend backend : test::backends()) {
        const test::RayQueries queries(test::shared_executor(backend), room.geometry);
        const std::vector<float> answers = queries.packets(in_order({fan}));
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < answers.size(); ++i)
            wrong += answers[i] == (i % 2 == 0 ? 0.0F : 1.0F) ? 0 : 1;
        EXPECT_EQ(wrong, 0U) << test::backend_name(backend);
    }
}

}  // namespace
}  // namespace weft::packet_test
