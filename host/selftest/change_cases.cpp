// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <random>
#include <stdexcept>

#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/moving_room.h"

// Scenes that change from frame to frame.
namespace weft::selftest {
namespace {

/// A renderer that follows a room; the room stays where it was made.
class Follower {
  public:
    Follower(Executor& executor, MovingRoom& room, const RenderSettings& settings)
        : room_(room), renderer_(executor, room.flat, room_camera(), settings) {
        render_next();
    }

    /// Renders the next picture, of the room as it is now.
    Image next() {
        update_flat(room_.scene, room_.flat);
        renderer_.update_scene();
        renderer_.move_camera(room_camera());
        render_next();
        return renderer_.image();
    }
    /// Records and virtual lights that differ in any bit if computed anew.
    [[nodiscard]] double differing() const {
        return static_cast<double>(renderer_.stats().back().cache.value().differing);
    }

  private:
    void render_next() {
        if (!renderer_.render_frame({})) throw std::runtime_error("a frame ended early");
    }

    MovingRoom& room_;
    Renderer renderer_;
};

RenderSettings kept_records(std::uint32_t width, std::uint32_t height) {
    RenderSettings settings = small_settings(Algorithm::tic, width, height);
    settings.sampling.vpls_per_set = 14;
    settings.sampling.cache_audit = true;
    settings.direct = false;
    return settings;
}

/// Follows random edits; what differs from records computed anew, over all of them.
Measured after_edits(Executor& executor, unsigned which, int edits) {
    MovingRoom room = moving_room(which);
    Follower follower(executor, room, kept_records(40, 30));
    std::mt19937 random(3 + which);
    Measured measured(0.0);
    for (int i = 0; i < edits; ++i) {
        const std::string what = room.edit(random);
        follower.next();
        measured.value += follower.differing();
        if (follower.differing() > 0.0 && measured.note.empty())
            measured.note = fmt::format("first after edit {}: {}", i, what);
    }
    return measured;
}

std::vector<Measured> measure_return(Executor& executor) {
    MovingRoom pictured = moving_room(0);
    Follower previews(executor, pictured, small_settings(Algorithm::igi, 40, 30));
    const Scene start = pictured.scene;
    const Image before = previews.next();
    pictured.move(0, {0.2, 0.05, -0.1});
    const Image away = previews.next();
    pictured.scene.instances = start.instances;
    const Image back = previews.next();
    // Something has to have moved, or the comparison would say nothing.
    const bool moved = differing_values(before, away) > 0;
    MovingRoom recorded = moving_room(0);
    Follower records(executor, recorded, kept_records(40, 30));
    double differing = 0.0;
    for (int i = 0; i < 4; ++i) {
        recorded.scene.instances = start.instances;
        if (i % 2 == 0) recorded.move(0, {0.1 * (i + 1), 0.05, -0.1});
        records.next();
        differing += records.differing();
    }
    return {static_cast<double>(differing_values(before, back)) + (moved ? 0.0 : 1.0), differing};
}

}  // namespace

std::vector<SelftestCase> change_cases() {
    const std::string anew = "sums are made anew and never corrected, so every bit is the same";
    SelftestCase edits{24,
                       "changes of all kinds",
                       RunsOn::devices,
                       {{"tic, records unlike new ones, 12 edits", 0.0, within(0.0), anew},
                        {"tic, the same in another room", 0.0, within(0.0), anew}},
                       [](Executor& executor) -> std::vector<Measured> {
                           return {after_edits(executor, 1, 12), after_edits(executor, 2, 12)};
                       }};
    // Of rays that graze an edge Embree's tree, made anew for what moves, may decide.
    edits.checks[1].own_traversal = true;
    return {edits,
            {25,
             "something moves away and back",
             RunsOn::devices,
             {{"igi, values unlike before", 0.0, within(0.0),
               "a picture does not depend on the frames before it"},
              {"tic, records unlike new ones", 0.0, within(0.0), anew}},
             measure_return}};
}

}  // namespace weft::selftest
