// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_VIEW_MEDIA_H
#define WEFT_PIPELINE_VIEW_MEDIA_H

#include "pipeline/frame_context.h"
#include "pipeline/media_buffers.h"

namespace weft {

/// Participating media of a scene on the device, and what they do to the view ray of each pixel.
class ViewMedia {
  public:
    /// With FEATURE_AIRLIGHT among the features also the ends of view rays.
    ViewMedia(Executor& executor, const FlatScene& scene, std::shared_ptr<MediaBuffers> media,
              const Camera& camera, std::size_t pixels, std::uint32_t features);

    void set_camera(Executor& executor, const FlatScene& scene, const Camera& camera);

    /// Launches view_media.cl on the frame's G-buffer.
    void find(FrameContext& frame) const;

    [[nodiscard]] const MediaBuffers& media() const { return *media_; }
    /// By pixel, float4: what media leave of light from the end of its view ray.
    [[nodiscard]] BufferRef<kinds::Transmittances> left() const { return left_; }
    /// By pixel, float4: what media emit towards the camera; null where none emits.
    [[nodiscard]] BufferRef<kinds::MediaEmission> glow() const { return glow_; }
    /// By pixel: boundaries around that end, a bit each.
    [[nodiscard]] BufferRef<kinds::EnclosingMedia> inside() const { return inside_; }
    /// A G-buffer whose surfaces are ends of view rays (kernels/media/view_media.cl); empty where
    /// no light scattered by media is asked for.
    [[nodiscard]] const GBuffer& ends() const { return ends_; }

  private:
    std::shared_ptr<MediaBuffers> media_;
    DeviceBuffer<kinds::Transmittances> left_;
    DeviceBuffer<kinds::MediaEmission> glow_;
    DeviceBuffer<kinds::EnclosingMedia> inside_;
    GBuffer ends_;
};

}  // namespace weft

#endif
