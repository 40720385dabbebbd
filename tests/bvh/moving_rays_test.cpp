// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/testing/moving_mesh.h"
#include "tests/testing/ray_batch.h"
#include "tests/testing/ray_fans.h"

// In a scene that is brought up to date rays meet what they meet in one that is made anew.
namespace weft::moving_rays_test {
namespace {

using test::Fan;
using test::MovingMesh;
using test::PacketBatch;
using test::Pose;
using test::poses;
using test::RayBatch;
using test::RayGeometry;
using test::RayHit;
using test::TestBackend;

/// What rays meet, by all queries there are.
struct Answers {
    std::vector<RayHit> closest, closest_packets;
    std::vector<int> any;
    std::vector<float> packets;
};

struct Rays {
    RayBatch endless, ending;
    PacketBatch packets;

    explicit Rays(const std::vector<Fan>& fans) {
        for (const Fan& fan : fans)
            for (std::size_t i = 0; i < fan.ends.size(); ++i) {
                if (i % PACKET_BLOCK == 0) packets.start_block(fan.origin);
                packets.add(fan.ends[i]);
                endless.add(fan.origin, fan.ends[i]);
                ending.add(fan.origin, fan.ends[i], SHADOW_END);
            }
    }
    [[nodiscard]] Answers ask(const test::RayQueries& queries) const {
        return {queries.closest(endless), queries.closest_packets(endless), queries.any(ending),
                queries.packets(packets)};
    }
};

template <class T, class Same>
std::size_t differences(const std::vector<T>& a, const std::vector<T>& b, const Same& same) {
    EXPECT_EQ(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        count += same(a[i], b[i]) ? 0 : 1;
    return count;
}

/// Bit for bit, but for Embree, whose arithmetic finds some hits that are none (see
/// ray_query_test), and packets of shadow rays, which pass within rounding of a triangle's border
/// or not as its box has it (see packet_test).
void expect_same(TestBackend backend, const Answers& a, const Answers& b) {
    const bool embree = backend == TestBackend::embree;
    const auto same_hit = [&](const RayHit& x, const RayHit& y) {
        return embree ? x.triangle == y.triangle : x == y;
    };
    const auto equal = [](auto x, auto y) { return x == y; };
    const std::size_t allowed = embree ? a.closest.size() / 1000 : 0;
    EXPECT_LE(differences(a.closest, b.closest, same_hit), allowed);
    EXPECT_LE(differences(a.closest_packets, b.closest_packets, same_hit), allowed);
    EXPECT_LE(differences(a.any, b.any, equal), allowed);
    EXPECT_LE(differences(a.packets, b.packets, equal),
              std::max(allowed, a.packets.size() / 10000));
}

std::size_t hits_from(const Answers& answers, std::size_t first, std::size_t end) {
    return static_cast<std::size_t>(
        std::count_if(answers.closest.begin(), answers.closest.end(), [&](const RayHit& hit) {
            return hit.triangle != INVALID_INDEX && hit.triangle >= first && hit.triangle < end;
        }));
}

/// Through all poses on all backends. `steady`: the scene's extent stays, so that resting parts
/// do.
void expect_hits_of_new_trees(MovingMesh mesh, bool steady) {
    const Rays rays(test::fans(200, 61));
    RayGeometry geometry{mesh.mesh.positions, mesh.mesh.triangles};
    const std::size_t count = mesh.mesh.triangles.size();
    if (steady) geometry.positions.push_back({4.0F, 4.0F, 4.0F, 0.0F});
    const auto pose = [&](const Pose& to) {
        mesh.pose(to);
        std::copy(mesh.mesh.positions.begin(), mesh.mesh.positions.end(),
                  geometry.positions.begin());
    };
    for (const TestBackend backend : test::backends()) {
        SCOPED_TRACE(test::backend_name(backend));
        pose(poses.front());
        Executor& executor = test::shared_executor(backend);
        test::RayQueries moving(executor, geometry, 0x1p-22F, mesh.first_moving);
        const Answers first = rays.ask(moving);
        for (const Pose& to : poses) {
            pose(to);
            moving.update();
            const Answers found = rays.ask(moving);
            const test::RayQueries anew(executor, geometry);
            expect_same(backend, found, rays.ask(anew));
            const std::size_t on_moving = hits_from(found, mesh.first_moving, count);
            const bool many = count > mesh.first_moving + 100 && to.present * to.scale >= 1.0F;
            if (to.present == 0.0F) {
                EXPECT_EQ(on_moving, 0U);
            }
            if (many) {
                EXPECT_GT(on_moving, found.closest.size() / 100);
            }
        }
        expect_same(backend, rays.ask(moving), first);
    }
}

TEST(MovingRays, RaysMeetWhatTheyMeetInATreeBuiltAtOnce) {
    expect_hits_of_new_trees(test::moving_soup(150, 150, 62), true);
    expect_hits_of_new_trees(test::needles_and_moving_soup(500, 150, 63), true);
}

TEST(MovingRays, RaysMeetTheSameWherePartsAreEmptyOrOneTriangle) {
    expect_hits_of_new_trees(test::moving_soup(0, 150, 64), true);
    expect_hits_of_new_trees(test::moving_soup(150, 0, 65), true);
    expect_hits_of_new_trees(test::moving_soup(150, 1, 66), true);
    expect_hits_of_new_trees(test::moving_soup(1, 150, 67), true);
    expect_hits_of_new_trees(test::moving_soup(1, 1, 68), true);
}

TEST(MovingRays, RaysMeetTheSameWhereTheSceneGrowsAndShrinks) {
    expect_hits_of_new_trees(test::moving_soup(150, 150, 69), false);
}

TEST(MovingRays, TheSmallestIdWinsWhereMovingTrianglesLieOnRestingOnes) {
    // At home the moving triangles are those at rest once more, which then are all that is met.
    MovingMesh mesh = test::moving_soup(150, 0, 70);
    const test::BvhMesh once = mesh.mesh;
    for (const shared::Triangle& t : once.triangles) {
        const auto corner = [&](std::uint32_t v) {
            return std::array<float, 3>{once.positions[v].x, once.positions[v].y,
                                        once.positions[v].z};
        };
        mesh.mesh.add(corner(t.v0), corner(t.v1), corner(t.v2));
    }
    mesh.home = mesh.mesh.positions;
    const Rays rays(test::fans(100, 71));
    RayGeometry geometry{mesh.mesh.positions, mesh.mesh.triangles};
    for (const TestBackend backend : test::backends()) {
        test::RayQueries queries(test::shared_executor(backend), geometry, 0x1p-22F,
                                 mesh.first_moving);
        for (const Pose& to : {poses[0], poses[1], poses[0]}) {
            mesh.pose(to);
            std::copy(mesh.mesh.positions.begin(), mesh.mesh.positions.end(),
                      geometry.positions.begin());
            queries.update();
            const Answers found = rays.ask(queries);
            const std::size_t on_moving =
                hits_from(found, mesh.first_moving, mesh.mesh.triangles.size());
            if (to.move != poses[0].move) {
                EXPECT_GT(on_moving, 0U) << test::backend_name(backend);
            } else {
                EXPECT_LE(on_moving,
                          backend == TestBackend::embree ? rays.endless.size() / 1000 : 0)
                    << test::backend_name(backend);
            }
        }
    }
}

TEST(MovingRays, OtherGeometryIsRefused) {
    const MovingMesh mesh = test::moving_soup(10, 10, 72);
    const RayGeometry geometry{mesh.mesh.positions, mesh.mesh.triangles};
    const RayGeometry other = geometry;
    for (const TestBackend backend : test::backends()) {
        Executor& executor = test::shared_executor(backend);
        const auto scene = executor.make_scene({geometry.positions, geometry.triangles, 0.0F, 10});
        const auto code_of = [&](const RayGeometry& given, std::size_t first_moving) {
            try {
                executor.update_scene(*scene,
                                      {given.positions, given.triangles, 0.0F, first_moving});
            } catch (const Error& error) {
                return error.code();
            }
            return ExitCode::success;
        };
        EXPECT_EQ(code_of(geometry, 10), ExitCode::success);
        EXPECT_EQ(code_of(other, 10), ExitCode::device);
        EXPECT_EQ(code_of(geometry, 11), ExitCode::device);
    }
}

}  // namespace
}  // namespace weft::moving_rays_test
