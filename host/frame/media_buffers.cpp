// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/media_buffers.h"

#include <span>

#include "bvh/wide_bvh.h"

namespace weft {
std::vector<Buffer*> MediaBuffers::followed_by(const std::vector<Buffer*>& others) const {
    std::vector<Buffer*> list;
    for (const auto& buffer : all) list.push_back(buffer.get());
    for (const auto& buffer : grids) list.push_back(buffer.get());
    // Arguments that no kernel looks at without grids.
    constexpr std::size_t grid_arguments = 3;
    if (!all.empty() && grids.empty()) list.insert(list.end(), grid_arguments, all.back().get());
    list.insert(list.end(), others.begin(), others.end());
    return list;
}

MediaBuffers upload_media(Executor& executor, const FlatMedia& media) {
    MediaBuffers buffers;
    if (!media.present()) return buffers;
    BvhSettings settings;
    settings.padding = media.space.rounding;
    const WideBvh bvh = build_bvh(media.positions, media.triangles, settings);
    const auto add = [&]<class T>(std::span<const T> values, const char* what) {
        buffers.all.push_back(upload<T>(executor, values, what));
    };
    add(std::span<const shared::BvhNode>(bvh.nodes), "tree of media boundaries");
    add(std::span<const float>(bvh.leaves), "media boundaries");
    add(std::span<const shared::float4>(media.normals), "normals of media boundaries");
    add(std::span<const shared::MediumRecord>(media.records), "media");
    add(std::span<const shared::MediaRecord>(&media.space, 1), "space of media");
    if (media.grids.records.empty()) return buffers;
    const auto add_grid = [&]<class T>(const std::vector<T>& values, const char* what) {
        buffers.grids.push_back(upload<T>(executor, std::span<const T>(values), what));
    };
    add_grid(media.grids.records, "density grids");
    add_grid(media.grids.densities, "densities");
    add_grid(media.grids.bounds, "bounds of densities");
    return buffers;
}

void set_media_camera(Executor& executor, const FlatScene& scene, const Camera& camera,
                      MediaBuffers& buffers) {
    if (buffers.all.empty()) return;
    shared::MediaRecord space = scene.media.space;
    space.around_camera =
        boundaries_around(scene.media, scene.units.point(glm::dvec3(camera.to_world[3])));
    write_buffer(executor, *buffers.all.back(), std::span<const shared::MediaRecord>(&space, 1));
}

}  // namespace weft
