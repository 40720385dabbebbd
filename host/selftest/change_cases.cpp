// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/moving_room.h"

// Scenes that change from frame to frame.
namespace weft::selftest {
namespace {

/// A renderer that renders each state of a changing room, to which it refers.
class Follower {
  public:
    Follower(Executor& executor, MovingRoom& room, const RenderSettings& settings)
        : room_(room), renderer_(executor, room.flat, room_camera(), settings) {
        render_next();
    }

    /// Renders the next image, of the room as it is now.
    Image next() {
        update_flat(room_.scene, room_.flat);
        renderer_.update_scene();
        renderer_.move_camera(room_camera());
        render_next();
        return renderer_.image();
    }
    /// Records and virtual lights that differ in any bit if computed anew.
    [[nodiscard]] double differing() const { return static_cast<double>(cache().differing); }
    [[nodiscard]] const CacheStats& cache() const { return renderer_.stats().back().cache.value(); }

  private:
    void render_next() {
        if (!renderer_.render_frame({})) throw std::runtime_error("a frame ended early");
    }

    MovingRoom& room_;
    Renderer renderer_;
};

RenderSettings temporal_settings(std::uint32_t width, std::uint32_t height) {
    RenderSettings settings = small_settings(Algorithm::tic, width, height);
    settings.sampling.vpls_per_set = 14;
    settings.sampling.validate_cache = true;
    settings.direct = false;
    return settings;
}

struct Edit {
    const char* what;
    void (*make)(MovingRoom& room, const Scene& start);
};

void turn_about_y(glm::dmat4& to_world, double angle) {
    glm::dmat4 by(1.0);
    by[0] = {std::cos(angle), 0.0, -std::sin(angle), 0.0};
    by[2] = {std::sin(angle), 0.0, std::cos(angle), 0.0};
    to_world = to_world * by;
}

Instance& thing_of(MovingRoom& room) {
    return room.scene.instances[room.things.front()];
}

/// One edit of every kind, in an order in which each changes something.
constexpr std::array one_of_each{
    Edit{"move",
         [](MovingRoom& room, const Scene&) {
             room.move(0, {0.2, 0.1, -0.1});
         }},
    Edit{"rotate",
         [](MovingRoom& room, const Scene&) { turn_about_y(thing_of(room).to_world, 0.7); }},
    Edit{"scale",
         [](MovingRoom& room, const Scene&) {
             for (int column = 0; column < 3; ++column) thing_of(room).to_world[column] *= 1.3;
         }},
    Edit{"nudge",
         [](MovingRoom& room, const Scene&) {
             room.move(0, {0.01, 0.0, 0.0});
         }},
    Edit{"remove", [](MovingRoom& room, const Scene&) { thing_of(room).present = false; }},
    Edit{"add", [](MovingRoom& room, const Scene&) { thing_of(room).present = true; }},
    Edit{"albedo",
         [](MovingRoom& room, const Scene&) {
             for (Material& material : room.scene.materials)
                 set_diffuse_albedo(material, glm::vec3{0.2F, 0.7F, 0.4F});
         }},
    Edit{"lights off",
         [](MovingRoom& room, const Scene&) {
             for (Material& material : room.scene.materials)
                 material.emission.radiance = glm::vec3(0.0F);
             for (PunctualLight& light : room.scene.lights) light.intensity = glm::vec3(0.0F);
         }},
    Edit{"lights on and the thing back",
         [](MovingRoom& room, const Scene& start) { room.scene = start; }},
    Edit{"touch the floor",
         [](MovingRoom& room, const Scene&) { thing_of(room).to_world[3].y = -1.0; }},
    Edit{"move and dim",
         [](MovingRoom& room, const Scene&) {
             room.move(0, {-0.1, 0.3, 0.1});
             for (Material& material : room.scene.materials) material.emission.radiance *= 0.5F;
             for (PunctualLight& light : room.scene.lights) light.intensity *= 0.5F;
         }},
};

/// Number of records and VPLs that differ from those computed anew, over all edits; NaN where no
/// record was kept or updated, since then there was nothing to compare.
Measured after_edits(Executor& executor, unsigned which) {
    MovingRoom room = moving_room(which);
    const Scene start = room.scene;
    Follower follower(executor, room, temporal_settings(40, 30));
    Measured measured(0.0);
    std::size_t kept = 0;
    std::size_t updated = 0;
    for (const Edit& edit : one_of_each) {
        edit.make(room, start);
        follower.next();
        measured.value += follower.differing();
        if (follower.differing() > 0.0 && measured.note.empty())
            measured.note = fmt::format("first after: {}", edit.what);
        kept += follower.cache().kept;
        updated += follower.cache().updated;
    }
    if (kept == 0 || updated == 0) {
        measured.value = NAN;
        measured.note = "no records were kept or none were updated";
    }
    return measured;
}

std::vector<Measured> measure_return(Executor& executor) {
    MovingRoom drawn = moving_room(0);
    Follower previews(executor, drawn, small_settings(Algorithm::igi, 40, 30));
    const Scene start = drawn.scene;
    const Image before = previews.next();
    drawn.move(0, {0.2, 0.05, -0.1});
    const Image away = previews.next();
    drawn.scene.instances = start.instances;
    const Image back = previews.next();
    // Something must have moved, or the comparison would be meaningless.
    const bool moved = differing_values(before, away) > 0;
    MovingRoom recorded = moving_room(0);
    Follower records(executor, recorded, temporal_settings(40, 30));
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
                       {{"tic, records unlike new ones, 11 edits", 0.0, within(0.0), anew},
                        {"tic, the same in another room", 0.0, within(0.0), anew}},
                       [](Executor& executor) -> std::vector<Measured> {
                           return {after_edits(executor, 1), after_edits(executor, 2)};
                       }};
    // Embree's tree, built anew for what moves, may decide otherwise on rays that graze an edge.
    for (Check& check : edits.checks) check.own_traversal = true;
    return {edits,
            {25,
             "something moves away and back",
             RunsOn::devices,
             {{"igi, values unlike before", 0.0, within(0.0),
               "an image does not depend on the frames before it"},
              {"tic, records unlike new ones", 0.0, within(0.0), anew}},
             measure_return}};
}

}  // namespace weft::selftest
