// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_DYNAMIC_SEQUENCES_H
#define WEFT_BENCH_DYNAMIC_DYNAMIC_SEQUENCES_H

#include <cstdint>
#include <string>
#include <vector>

#include "bench/dynamic/scene_probe.h"
#include "scene/scene.h"

namespace weft::bench {

/// What happens over the frames of a sequence.
enum class Event : std::uint8_t {
    box,         ///< a small box slides across the middle of the image
    area_light,  ///< all lights become dimmer and redder
    switching,   ///< the brightest area light goes out, and comes back in another colour
    camera,      ///< the camera flies forward and turns
    still,       ///< nothing
    door,        ///< a slab at the side of the scene turns about its hinge
    furniture,   ///< a table, a chair and a shelf slide and turn
    figure,      ///< a body bends and twists
};

[[nodiscard]] const char* to_string(Event event);
/// All of their names, in order.
[[nodiscard]] std::vector<std::string> event_names();
/// What happens in a scene of that name unless others are asked for: what its rooms are made for,
/// and what can happen anywhere.
[[nodiscard]] std::vector<Event> events_in(const std::string& scene);

/// A scene over frames: what it is at each follows from what it is at first.
class DynamicSequence {
  public:
    /// `scene` holds still but for what happens; `probe` is of it. Things that are to move are
    /// added to it, in places that `camera` sees. `frames`: how many there will be.
    DynamicSequence(Scene scene, const Camera& camera, SceneProbe& probe, Event event,
                    std::uint32_t frames);

    /// The scene at a frame: that at first with other transforms, vertices, lights and materials.
    [[nodiscard]] const Scene& at(std::uint32_t frame);
    [[nodiscard]] Camera camera_at(std::uint32_t frame) const;

  private:
    /// A thing that moves: the last instances of the scene, in order.
    struct Prop {
        glm::dmat4 place{1.0};    ///< to the world, at first
        glm::dvec3 slide{0.0};    ///< farthest from there, scene units
        glm::dvec3 axis{0.0};     ///< unit, through its origin
        double first_turn = 0.0;  ///< radians
        double turn = 0.0;        ///< most, radians
    };

    void add(const Mesh& mesh, const glm::vec3& colour, const Prop& prop);
    void add_box(const Camera& camera, double distance);
    void add_door(const Camera& camera, SceneProbe& probe);
    void add_furniture(const Camera& camera, SceneProbe& probe);
    void add_figure(const Camera& camera, SceneProbe& probe);
    void choose_area_light();
    void move_props(std::uint32_t frame);
    void dim_lights(std::uint32_t frame);
    void switch_area_light(std::uint32_t frame);

    Scene first_, now_;
    Camera camera_;
    Event event_;
    std::uint32_t frames_;
    std::vector<Prop> props_;
    double distance_ = 0.0;         ///< of the middle of the image from the camera, scene units
    std::size_t area_light_ = 0;    ///< material, or beyond these a light without area
    float area_light_dark_ = 0.0F;  ///< what is left of it when it is out
};

}  // namespace weft::bench

#endif
