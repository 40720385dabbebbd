// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/view_media.h"

#include <cstring>
#include <span>
#include <utility>

namespace weft {
namespace {

void fill(Executor& executor, Buffer& plane, const shared::float4& value) {
    executor.with_mapped(plane, Access::write, [&](std::span<std::byte> bytes) {
        for (std::size_t at = 0; at + sizeof(value) <= bytes.size(); at += sizeof(value))
            std::memcpy(&bytes[at], &value, sizeof(value));
    });
}

}  // namespace

ViewMedia::ViewMedia(Executor& executor, const FlatScene& scene,
                     std::shared_ptr<MediaBuffers> media, const Camera& camera, std::size_t pixels,
                     std::uint32_t features)
    : media_(std::move(media)),
      transmittance_(
          allocate<kinds::Transmittances>(executor, pixels, "transmittance of view rays")),
      enclosing_media_(
          allocate<kinds::EnclosingMedia>(executor, pixels, "surroundings of view rays")) {
    set_camera(executor, scene, camera);
    if ((features & FEATURE_EMISSIVE_MEDIA) != 0)
        emission_ = allocate<kinds::MediaEmission>(executor, pixels, "light that media emit");
    if ((features & FEATURE_AIRLIGHT) != 0) {
        ends_ = allocate_gbuffer(executor, pixels, "ends of view rays");
        fill(executor, *ends_.gb_shading, {0.0F, 0.0F, 1.0F, 0.0F});
        fill(executor, *ends_.gb_emission, {0.0F, 0.0F, 0.0F, 0.0F});
    }
}

void ViewMedia::set_camera(Executor& executor, const FlatScene& scene, const Camera& camera) {
    set_media_camera(executor, scene, camera, *media_);
}

void ViewMedia::find(FrameContext& frame) const {
    // Shading normals and emission of the ends are filled once.
    frame.run(Stage::view_media, "",
              kernels::view_media{.surfaces = view(frame.buffers.gbuffer),
                                  .media_tables = view(*media_),
                                  .view_transmittance = transmittance_,
                                  .view_emission = emission_,
                                  .view_enclosing_media = enclosing_media_,
                                  .end_ids = ends_.gb_ids,
                                  .end_position = ends_.gb_position,
                                  .end_normal = ends_.gb_normal,
                                  .end_albedo = ends_.gb_albedo},
              {frame.pixels()});
}

}  // namespace weft
