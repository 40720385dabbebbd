// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/soft_shadows.h"

#include <algorithm>
#include <glm/glm.hpp>

#include "components/component.h"

namespace weft {
namespace {

glm::dvec3 position(const FlatScene& scene, std::uint32_t vertex) {
    const shared::float4& p = scene.positions[vertex];
    return {p.x, p.y, p.z};
}

shared::float4 corner(const glm::dvec3& p, double w) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
            static_cast<float>(w)};
}

/// Bounds of a light and, where its triangles keep to one plane, that plane.
struct LightBox {
    glm::dvec3 low{1e300};
    glm::dvec3 high{-1e300};
    glm::dvec3 normal{0.0};  ///< of its first triangle that has one
    double nearest = 1e300;  ///< least and greatest offset along it
    double farthest = -1e300;

    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
        nearest = std::min(nearest, glm::dot(normal, p));
        farthest = std::max(farthest, glm::dot(normal, p));
    }
};

LightBox box_of(const FlatScene& scene, const shared::LightRecord& light) {
    LightBox box;
    const auto corners = [&](std::uint32_t i) {
        const shared::Triangle& t = scene.triangles[scene.emissive[light.first + i].triangle];
        return std::array{position(scene, t.v0), position(scene, t.v1), position(scene, t.v2)};
    };
    for (std::uint32_t i = 0; i < light.count && box.normal == glm::dvec3(0.0); ++i) {
        const auto [a, b, c] = corners(i);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        if (glm::length(normal) > 0.0) box.normal = glm::normalize(normal);
    }
    for (std::uint32_t i = 0; i < light.count; ++i)
        for (const glm::dvec3& p : corners(i)) box.add(p);
    return box;
}

}  // namespace

std::vector<shared::float4> light_boxes(const FlatScene& scene) {
    // Well inside of what a shaft counts as belonging to the plane.
    constexpr double flatness = 0x1p-22;
    std::vector<shared::float4> boxes;
    for (std::uint32_t i = 0; i < scene.area_lights; ++i) {
        const LightBox box = box_of(scene, scene.lights[i]);
        const bool flat =
            scene.lights[i].both_sides == 0 &&
            box.farthest - box.nearest <= flatness * static_cast<double>(scene.extent);
        boxes.push_back(corner(box.low, 0.0));
        boxes.push_back(corner(box.high, 0.0));
        boxes.push_back(flat ? corner(box.normal, box.nearest) : corner(glm::dvec3(0.0), 0.0));
    }
    return boxes;
}

SoftShadows::SoftShadows(Executor& executor, const FlatScene& scene, const TileGrid& grid,
                         const LevelSettings& settings, std::uint32_t features)
    : sampling_(executor, grid, settings, features), groups_(shadow_groups(scene.area_lights)) {
    light_boxes_ = upload<shared::float4>(executor, light_boxes(scene), "light boxes");
    const auto words = [&](std::size_t count, const char* what) {
        return executor.allocate(count * sizeof(std::uint32_t), what);
    };
    packet_shadows_ =
        words(std::size_t{slots()} / executor.lanes() * SHADOW_GROUPS, "shadows of packets");
    block_shadows_ = words(slots() / PACKET_BLOCK, "shadow states");
    tile_shadows_ = executor.allocate(grid.tiles() * sizeof(shared::TileShadows), "tile shadows");
}

void SoftShadows::sample(FrameContext& frame) {
    states_.clear();
    block_words_.clear();
    frame.params.shadow_groups = frame.plan.samples_per_light > 0 ? groups_ : 1;
    sampling_.sample(
        frame, "direct", *frame.buffers.tiles, *frame.buffers.direct,
        {[&](std::uint32_t first, std::uint32_t count) { gather(frame, first, count); },
         [&] { return least_levels(frame); }});
}

void SoftShadows::gather(FrameContext& frame, std::uint32_t first, std::uint32_t count) {
    const FrameBuffers& buffers = frame.buffers;
    const std::uint32_t groups = frame.params.shadow_groups;
    if (states_.empty()) {
        block_words_.assign((first + count) / PACKET_BLOCK, traced_state(groups).trace);
    } else {
        const std::vector<std::uint32_t> words =
            block_shadows(buffers.tiles->grid(), sampling_.last_round(), states_, groups);
        block_words_.insert(block_words_.end(), words.begin(), words.end());
    }
    write_buffer<std::uint32_t>(frame.executor, *block_shadows_, block_words_);
    const std::uint32_t lanes = frame.executor.lanes();
    frame.params.list_first = 0;
    frame.params.list_stride = frame.plan.samples_per_set;
    frame.params.list_length = frame.plan.samples_per_set;
    frame.run(KernelId::soft_shadows, "area lights", "direct", true,
              {&sampling_.receivers(), &sampling_.block_set(), block_shadows_.get(),
               buffers.light_samples.get(), buffers.direct.get(), packet_shadows_.get(),
               buffers.counters.get()},
              count / lanes, gather_items_per_launch(frame.executor, frame.params.list_length),
              first / lanes);
}

std::vector<Level> SoftShadows::least_levels(FrameContext& frame) {
    const TileGrid& grid = frame.buffers.tiles->grid();
    const std::uint32_t groups = frame.params.shadow_groups;
    frame.run(KernelId::tile_shadows, "shafts", "direct", true,
              with_gbuffer(frame.buffers,
                           {&frame.buffers.tiles->buffer(), &sampling_.pixel_slot(),
                            packet_shadows_.get(), light_boxes_.get(), tile_shadows_.get()}),
              grid.tiles());
    const auto shadows =
        read_buffer<shared::TileShadows>(frame.executor, *tile_shadows_, grid.tiles());
    states_ = shadow_states(shadows, groups);
    return shadow_levels(states_);
}

void SoftShadows::reconstruct(FrameContext& frame) {
    sampling_.reconstruct(frame, "direct", *frame.buffers.tiles, *frame.buffers.direct,
                          *frame.buffers.filtered_direct);
}

}  // namespace weft
