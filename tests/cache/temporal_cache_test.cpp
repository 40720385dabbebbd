// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/testing/moving_room.h"
#include "tests/testing/render_fixture.h"

namespace weft::temporal_cache_test {
namespace {

using test::MovingRoom;
using test::TestBackend;

/// At most 126 VPLs, and some hundred records.
RenderSettings settings_of(std::uint32_t width, std::uint32_t height) {
    RenderSettings settings = test::small_settings(Algorithm::tic, width, height);
    settings.sampling.vpls_per_set = 14;
    settings.direct = false;
    return settings;
}

/// Rays of all stages of this name in the last frame.
std::uint64_t rays_of(const Renderer& renderer, Stage stage) {
    std::uint64_t rays = 0;
    for (const StageStats& stats : renderer.stats().back().stages)
        if (stats.stage == stage) rays += stats.rays;
    return rays;
}

/// A renderer that follows a room.
struct Follower {
    MovingRoom room;
    Renderer renderer;

    Follower(TestBackend backend, const MovingRoom& start, const RenderSettings& settings)
        : room(start),
          renderer(test::shared_executor(backend), room.flat, test::room_camera(), settings) {
        renderer.render_frame({});
    }

    /// Renders the next image, of the room as it is now.
    const FrameStats& next() {
        update_flat(room.scene, room.flat);
        renderer.update_scene();
        renderer.move_camera(test::room_camera());
        EXPECT_TRUE(renderer.render_frame({}));
        return renderer.stats().back();
    }
};

/// Follows random edits, and compares with records and VPLs computed anew after each.
void follow_random_edits(TestBackend backend, const MovingRoom& start, RenderSettings settings,
                         int edits, unsigned seed) {
    settings.sampling.validate_cache = true;
    Follower follower(backend, start, settings);
    std::mt19937 random(seed);
    std::size_t updated = 0;
    std::size_t kept = 0;
    std::uint64_t traced = 0;
    std::uint64_t affected = 0;
    for (int edit = 0; edit < edits; ++edit) {
        std::string what = follower.room.edit(random);
        // Receivers, blockers and lights may also change at once.
        if (edit % 3 == 0) what += " and " + follower.room.edit(random);
        const FrameStats& stats = follower.next();
        ASSERT_TRUE(stats.cache.has_value());
        ASSERT_LE(stats.cache->kept, 1000U);
        ASSERT_EQ(stats.cache->differing, 0U)
            << "edit " << edit << " of seed " << seed << ": " << what;
        updated += stats.cache->updated;
        kept += stats.cache->kept;
        if (!settings.sampling.cache_masks) continue;
        traced += stats.cache->traced;
        affected += stats.cache->affected;
    }
    // What is traced again is what is affected, but for rays that pass an edge within rounding, and
    // for records on the ball that face a VPL by their smooth normal alone, which the count by hand
    // knows nothing of: some 2.3 percent.
    EXPECT_NEAR(static_cast<double>(traced), static_cast<double>(affected),
                0.03 * static_cast<double>(affected));
    EXPECT_GT(updated, 0U);
    // A quarter of the edits changes no light path: what it leaves alone is not computed again.
    if (edits > 100) {
        EXPECT_GT(kept, updated);
    }
}

TEST(TemporalCache, RecordsAreThoseComputedAnewAfterAnyEdits) {
    // The TIC invariant: 1000 random edits in three scenes, half of them without masks.
    for (const unsigned scene : {0U, 1U, 2U})
        for (const bool masks : {true, false}) {
            SCOPED_TRACE("scene " + std::to_string(scene) + (masks ? "" : " without masks"));
            RenderSettings settings = settings_of(40, 30);
            settings.sampling.cache_masks = masks;
            settings.sampling.cache_records = 900;
            follow_random_edits(TestBackend::own_bvh, test::moving_room(scene), settings, 167,
                                7 + scene);
        }
}

TEST(TemporalCache, AndSoTheyAreOnOtherBackends) {
    for (const TestBackend backend : test::backends())
        if (backend != TestBackend::own_bvh)
            follow_random_edits(backend, test::moving_room(1), settings_of(40, 30), 20, 3);
}

TEST(TemporalCache, MovingAwayAndBackLeavesEverythingAsItWas) {
    RenderSettings settings = settings_of(48, 36);
    settings.sampling.validate_cache = true;
    Follower follower(TestBackend::own_bvh, test::moving_room(0), settings);
    const MovingRoom start = follower.room;
    for (int i = 0; i < 8; ++i) {
        follower.room.scene.instances = start.scene.instances;
        if (i % 2 == 0) follower.room.move(0, {0.1 * (i + 1), 0.05, -0.1});
        EXPECT_EQ(follower.next().cache->differing, 0U);
    }
    // The image is as near to that of a new renderer as two choices of records are.
    const test::Rendering anew =
        test::render(TestBackend::own_bvh, start.scene, test::room_camera(), settings_of(48, 36));
    EXPECT_LT(test::relative_mse(anew.layer("indirect"),
                                 follower.renderer.image().find("indirect")->values),
              2e-3);
}

TEST(TemporalCache, WithoutChangesNothingIsTracedForRecords) {
    Follower follower(TestBackend::own_bvh, test::moving_room(2), settings_of(48, 36));
    const std::uint32_t made = follower.renderer.stats().back().cache->made;
    EXPECT_GT(made, 50U);
    for (int i = 0; i < 3; ++i) {
        const FrameStats& stats = follower.next();
        EXPECT_EQ(stats.cache->kept, made);
        EXPECT_EQ(stats.cache->updated, 0U);
        EXPECT_EQ(stats.cache->made, 0U);
        for (const Stage stage :
             {Stage::vpl_walk, Stage::vpl_invalidation, Stage::record_invalidation,
              Stage::record_updates, Stage::irradiance_records})
            EXPECT_EQ(rays_of(follower.renderer, stage), 0U) << stage_name(stage);
    }
    EXPECT_EQ(follower.renderer.stats()[0].rays > follower.renderer.stats()[1].rays, true);
}

TEST(TemporalCache, LightsAndColoursAreSummedUpWithoutRays) {
    Follower dimmed(TestBackend::own_bvh, test::moving_room(0), settings_of(48, 36));
    dimmed.next();  // all records at once, as in the frames that follow
    const std::vector<float> before = dimmed.renderer.image().find("indirect")->values;
    for (Material& material : dimmed.room.scene.materials) material.emission.radiance *= 0.5F;
    for (PunctualLight& light : dimmed.room.scene.lights) light.intensity *= 0.5F;
    const FrameStats& stats = dimmed.next();
    EXPECT_EQ(rays_of(dimmed.renderer, Stage::vpl_walk), 0U);
    EXPECT_EQ(rays_of(dimmed.renderer, Stage::record_updates), 0U);
    EXPECT_EQ(stats.cache->updated, stats.cache->kept);
    const std::vector<float> after = dimmed.renderer.image().find("indirect")->values;
    double worst = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i)
        worst = std::max(
            worst, std::abs(static_cast<double>(before[i]) * 0.5 - static_cast<double>(after[i])));
    // Half of every number is exact.
    EXPECT_EQ(worst, 0.0);
    // And a colour changes flux only.
    set_diffuse_albedo(dimmed.room.scene.materials[0], glm::vec3{0.2F, 0.4F, 0.6F});
    dimmed.next();
    EXPECT_EQ(rays_of(dimmed.renderer, Stage::vpl_walk), 0U);
    EXPECT_EQ(rays_of(dimmed.renderer, Stage::record_updates), 0U);
}

TEST(TemporalCache, ALightThatGoesOutAndOnAgainIsFollowed) {
    RenderSettings settings = settings_of(40, 30);
    settings.sampling.validate_cache = true;
    Follower follower(TestBackend::own_bvh, test::moving_room(1), settings);
    const Scene lit = follower.room.scene;
    for (int i = 0; i < 4; ++i) {
        follower.room.scene = lit;
        if (i % 2 == 0) {
            for (Material& material : follower.room.scene.materials)
                material.emission.radiance = glm::vec3(0.0F);
            for (PunctualLight& light : follower.room.scene.lights)
                light.intensity = glm::vec3(0.0F);
        }
        EXPECT_EQ(follower.next().cache->differing, 0U);
        const double mean = test::mean_of(follower.renderer.image().find("indirect")->values);
        EXPECT_EQ(mean > 0.0, i % 2 == 1);
    }
}

TEST(TemporalCache, SurfacesThatGoBlackAndReflectAgainAreFollowed) {
    RenderSettings settings = settings_of(40, 30);
    settings.sampling.validate_cache = true;
    MovingRoom room = test::moving_room(1);
    const std::vector<Material> reflecting = room.scene.materials;
    for (Material& material : room.scene.materials) set_diffuse_albedo(material, glm::vec3(0.0F));
    const std::vector<Material> black = room.scene.materials;
    room.flat = flatten(room.scene);
    Follower follower(TestBackend::own_bvh, std::move(room), settings);
    for (int i = 0; i < 4; ++i) {
        follower.room.scene.materials = i % 2 == 0 ? reflecting : black;
        const FrameStats& stats = follower.next();
        if (i % 2 == 0) {
            EXPECT_EQ(stats.cache->differing, 0U);
        }
        const Image image = follower.renderer.image();
        EXPECT_EQ(test::mean_of(image.find("indirect")->values) > 0.0, i % 2 == 0);
    }
}

TEST(TemporalCache, RecordsOnWhatMovesAreDropped) {
    Follower follower(TestBackend::own_bvh, test::moving_room(0), settings_of(48, 36));
    EXPECT_EQ(follower.next().cache->dropped, 0U);
    set_diffuse_albedo(follower.room.scene.materials[0], glm::vec3{0.2F, 0.4F, 0.6F});
    EXPECT_EQ(follower.next().cache->dropped, 0U);
    for (int i = 0; i < 4; ++i) {
        follower.room.move(0, {0.03, 0.0, 0.02});
        const CacheStats stats = *follower.next().cache;
        EXPECT_GT(stats.dropped, 0U);
        EXPECT_GT(stats.made, 0U);
    }
    // All of them: where it has gone, none is left to be dropped.
    follower.room.scene.instances[follower.room.things[0]].present = false;
    EXPECT_GT(follower.next().cache->dropped, 0U);
    EXPECT_EQ(follower.next().cache->dropped, 0U);
}

TEST(TemporalCache, RecordsDoNotPileUpWhereThingsMove) {
    RenderSettings settings = settings_of(64, 48);
    settings.sampling.validate_cache = true;
    Follower follower(TestBackend::own_bvh, test::moving_room(0), settings);
    const std::uint32_t first = follower.next().cache->kept;
    std::uint32_t evicted = 0;
    for (int i = 0; i < 40; ++i) {
        follower.room.move(0, {i % 20 < 10 ? 0.03 : -0.03, 0.0, 0.0});
        const FrameStats& stats = follower.next();
        evicted += stats.cache->evicted;
        EXPECT_EQ(stats.cache->differing, 0U);
        EXPECT_LT(stats.cache->kept, 2 * first);
    }
    EXPECT_GT(evicted, 0U);
}

TEST(TemporalCache, NoMoreRecordsAreKeptThanAllowed) {
    RenderSettings settings = settings_of(64, 48);
    settings.sampling.cache_records = 100;
    settings.sampling.validate_cache = true;
    Follower follower(TestBackend::own_bvh, test::moving_room(0), settings);
    EXPECT_GT(follower.renderer.stats().back().cache->evicted, 0U);
    for (int i = 0; i < 6; ++i) {
        follower.room.move(0, {0.02, 0.0, 0.01});
        const FrameStats& stats = follower.next();
        EXPECT_LE(stats.cache->kept, 100U);
        EXPECT_EQ(stats.cache->differing, 0U);
        // What was evicted is made again: no pixel stays dark for it.
        const Image image = follower.renderer.image();
        const std::vector<float>& light = image.find("indirect")->values;
        const std::vector<float>& albedo = image.find("albedo")->values;
        for (std::size_t p = 0; p < light.size(); ++p)
            if (albedo[p] > 0.0F) {
                ASSERT_GT(light[p], 0.0F);
            }
    }
}

TEST(TemporalCache, AnEarlyEndLeavesNothingHalfDone) {
    RenderSettings settings = settings_of(40, 30);
    settings.sampling.validate_cache = true;
    for (int steps = 0; steps < 40; ++steps) {
        Follower follower(TestBackend::own_bvh, test::moving_room(0), settings);
        follower.room.move(0, {0.1, 0.0, 0.0});
        update_flat(follower.room.scene, follower.room.flat);
        follower.renderer.update_scene();
        follower.renderer.move_camera(test::room_camera());
        int left = steps;
        follower.renderer.render_frame([&](Stage, double) { return left-- > 0; });
        follower.room.move(0, {-0.05, 0.1, 0.0});
        EXPECT_EQ(follower.next().cache->differing, 0U) << "steps " << steps;
    }
}

}  // namespace
}  // namespace weft::temporal_cache_test
