// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_motion.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

namespace weft {
namespace {

// Margin about what has moved, as a share of the scene's extent: more than triangle tests and
// offsets of ray origins may err.
constexpr float box_margin = 0x1p-15F;

// Rays that pass a triangle within 2^-19 of their length count as blocked. No box may leave out a
// hit that another tree would find.
constexpr float tree_padding = 0x1p-16F;

template <class T>
bool same_bytes(std::span<const T> a, std::span<const T> b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return same_bytes(std::span<const T>(a), std::span<const T>(b));
}

bool is_at_origin(const shared::float4& p) {
    return p.x == 0.0F && p.y == 0.0F && p.z == 0.0F;
}

}  // namespace

SceneMotion::SceneMotion(Executor& executor) {
    upload(executor);
}

SceneMotion::Snapshot SceneMotion::snapshot_of(const FlatScene& scene) {
    Snapshot now;
    const auto tail = [](const auto& values, std::size_t first) {
        return std::decay_t<decltype(values)>(
            values.begin() + static_cast<std::ptrdiff_t>(std::min(first, values.size())),
            values.end());
    };
    now.positions = tail(scene.positions, scene.first_moving_vertex);
    now.normals = tail(scene.normals, std::size_t{3} * scene.first_moving_vertex);
    now.triangles = tail(scene.triangles, scene.first_moving_triangle);
    now.materials = scene.materials;
    now.lights = scene.lights;
    now.emissive = scene.emissive;
    now.extent = scene.extent;
    return now;
}

void SceneMotion::observe(Executor& executor, const FlatScene& scene) {
    forget();
    Snapshot now = snapshot_of(scene);
    all_ = now.extent != before_.extent || now.positions.size() != before_.positions.size() ||
           now.triangles.size() != before_.triangles.size();
    if (!all_) find_moved(scene, now);
    any_ = all_ || std::find(moved_.begin(), moved_.end(), true) != moved_.end() ||
           !same_bytes(now.materials, before_.materials) ||
           !same_bytes(now.lights, before_.lights) || !same_bytes(now.emissive, before_.emissive);
    before_ = std::move(now);
    if (any_) upload(executor);
}

void SceneMotion::forget() {
    any_ = false;
    all_ = false;
    moved_.clear();
    positions_.clear();
    triangles_.clear();
    corners_.clear();
}

void SceneMotion::invalidate_everything(Executor& executor) {
    forget();
    any_ = true;
    constexpr float far = std::numeric_limits<float>::max();
    corners_ = {{-far, -far, -far, 0.0F}, {far, far, far, 0.0F}};
    upload(executor);
}

void SceneMotion::find_moved(const FlatScene& scene, const Snapshot& now) {
    moved_.assign(scene.instances.size(), false);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceRange& range = scene.ranges[i];
        if (range.first_vertex < scene.first_moving_vertex || range.vertices == 0) continue;
        const std::size_t vertex = range.first_vertex - scene.first_moving_vertex;
        const std::size_t triangle = range.first_triangle - scene.first_moving_triangle;
        const auto same = [](const auto& a, const auto& b, std::size_t first, std::size_t count) {
            return same_bytes(std::span(a).subspan(first, count),
                              std::span(b).subspan(first, count));
        };
        const bool has_normals = !now.normals.empty();
        if (same(now.positions, before_.positions, vertex, range.vertices) &&
            same(now.triangles, before_.triangles, triangle, range.triangles) &&
            (!has_normals ||
             same(now.normals, before_.normals, 3 * vertex, std::size_t{3} * range.vertices)))
            continue;
        moved_[i] = true;
        add_moved(scene, before_, i);
        add_moved(scene, now, i);
    }
}

void SceneMotion::add_moved(const FlatScene& scene, const Snapshot& at, std::uint32_t instance) {
    const InstanceRange& range = scene.ranges[instance];
    const std::size_t vertex = range.first_vertex - scene.first_moving_vertex;
    const auto vertices = std::span(at.positions).subspan(vertex, range.vertices);
    // Absent instances have all their vertices there.
    if (std::all_of(vertices.begin(), vertices.end(), is_at_origin)) return;
    const float margin = box_margin * at.extent;
    shared::float4 low = vertices.front();
    shared::float4 high = vertices.front();
    for (const shared::float4& p : vertices) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z), 0.0F};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z), 0.0F};
    }
    corners_.push_back({low.x - margin, low.y - margin, low.z - margin, 0.0F});
    corners_.push_back({high.x + margin, high.y + margin, high.z + margin, 0.0F});
    const auto base = static_cast<std::uint32_t>(positions_.size()) - range.first_vertex;
    positions_.insert(positions_.end(), vertices.begin(), vertices.end());
    const std::size_t triangle = range.first_triangle - scene.first_moving_triangle;
    for (std::size_t t = 0; t < range.triangles; ++t) {
        const shared::Triangle& from = at.triangles[triangle + t];
        triangles_.push_back({base + from.v0, base + from.v1, base + from.v2, from.instance});
    }
}

void SceneMotion::upload(Executor& executor) {
    traced_.reset();
    traced_ = executor.make_scene({.positions = positions_,
                                   .triangles = triangles_,
                                   .box_padding = std::max(before_.extent, 0.0F) * tree_padding,
                                   .passing = true});
    boxes_ = weft::upload<kinds::MovedBounds>(executor, corners_, "boxes of what has moved");
    box_count_ = static_cast<std::uint32_t>(corners_.size() / 2);
}

}  // namespace weft
