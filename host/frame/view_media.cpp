// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/view_media.h"

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
      left_(executor.allocate(pixels * sizeof(shared::float4), "transmittance of view rays")),
      inside_(executor.allocate(pixels * sizeof(std::uint32_t), "surroundings of view rays")) {
    set_camera(executor, scene, camera);
    if ((features & FEATURE_EMISSIVE_MEDIA) != 0)
        glow_ = executor.allocate(pixels * sizeof(shared::float4), "light that media emit");
    if ((features & FEATURE_AIRLIGHT) != 0) {
        ends_ = allocate_gbuffer(executor, pixels, "ends of view rays");
        fill(executor, *ends_[gbuffer_shading], {0.0F, 0.0F, 1.0F, 0.0F});
        fill(executor, *ends_[gbuffer_emission], {0.0F, 0.0F, 0.0F, 0.0F});
    }
}

void ViewMedia::set_camera(Executor& executor, const FlatScene& scene, const Camera& camera) {
    set_media_camera(executor, scene, camera, *media_);
}

void ViewMedia::find(FrameContext& frame) const {
    std::vector<Buffer*> others =
        media_->followed_by({left_.get(), frame.buffers.or_nothing(glow_), inside_.get()});
    for (std::size_t i = 0; i < gbuffer_buffers; ++i) {
        if (i == gbuffer_shading || i == gbuffer_emission) continue;  // filled once
        others.push_back(ends_.empty() ? frame.buffers.nothing.get() : ends_[i].get());
    }
    frame.run(KernelId::view_media, Stage::view_media, "", false,
              with_gbuffer(frame.buffers.gbuffer, others),
              frame.params.width * frame.params.height);
}

std::vector<Buffer*> with_media(const FrameBuffers& frame, const std::vector<Buffer*>& others) {
    if (frame.view_media) return frame.view_media->media().followed_by(others);
    constexpr std::size_t media_arguments = 8;
    std::vector<Buffer*> all(media_arguments, frame.nothing.get());
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

Buffer* view_inside(const FrameBuffers& frame) {
    return frame.view_media ? &frame.view_media->inside() : frame.nothing.get();
}

}  // namespace weft
