// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/media_buffers.h"

#include <span>

#include "bvh/wide_bvh.h"
#include "scene/field_of_view.h"

namespace weft {

MediaBuffers upload_media(Executor& executor, const FlatMedia& media) {
    MediaBuffers buffers;
    if (!media.present()) return buffers;
    BvhSettings settings;
    settings.padding = media.space.rounding;
    const WideBvh bvh = build_bvh(media.positions, media.triangles, settings);
    buffers.boundary_nodes =
        upload<kinds::BoundaryNodes>(executor, bvh.nodes, "tree of media boundaries");
    buffers.boundary_leaves =
        upload<kinds::BoundaryLeaves>(executor, bvh.leaves, "media boundaries");
    buffers.boundary_normals =
        upload<kinds::BoundaryNormals>(executor, media.normals, "normals of media boundaries");
    buffers.media = upload<kinds::Mediums>(executor, media.records, "media");
    buffers.media_record = upload<kinds::MediaSpace>(executor, {&media.space, 1}, "space of media");
    if (media.grids.records.empty()) return buffers;
    buffers.grids = upload<kinds::DensityGrids>(executor, media.grids.records, "density grids");
    buffers.densities = upload<kinds::Densities>(executor, media.grids.densities, "densities");
    buffers.density_bounds =
        upload<kinds::DensityBounds>(executor, media.grids.bounds, "bounds of densities");
    return buffers;
}

void set_media_camera(Executor& executor, const FlatScene& scene, const Camera& camera,
                      MediaBuffers& buffers) {
    if (!buffers.media_record) return;
    shared::MediaRecord space = scene.media.space;
    space.around_camera = boundaries_around(scene.media, scene.units.point(ray_start(camera)));
    write_buffer(executor, buffers.media_record, {&space, 1});
}

}  // namespace weft
