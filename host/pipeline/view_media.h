// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_VIEW_MEDIA_H
#define WEFT_PIPELINE_VIEW_MEDIA_H

#include "pipeline/frame_context.h"
#include "pipeline/media_buffers.h"

namespace weft {

/// Participating media of a scene on the device, and their transmittance and emission along the
/// view ray of each pixel.
class ViewMedia {
  public:
    /// Allocates the ends of view rays only where `features` has FEATURE_AIRLIGHT.
    ViewMedia(Executor& executor, const FlatScene& scene, std::shared_ptr<MediaBuffers> media,
              const Camera& camera, std::size_t pixels, std::uint32_t features);

    void set_camera(Executor& executor, const FlatScene& scene, const Camera& camera);

    /// Launches view_media.cl on the frame's G-buffer.
    void find(FrameContext& frame) const;

    [[nodiscard]] const MediaBuffers& media() const { return *media_; }
    /// By pixel, float4: transmittance of media along its view ray.
    [[nodiscard]] BufferRef<kinds::Transmittances> transmittance() const { return transmittance_; }
    /// By pixel, float4: radiance that media emit towards the camera; null where none emits.
    [[nodiscard]] BufferRef<kinds::MediaEmission> media_emission() const { return emission_; }
    /// By pixel: boundaries around the end of its view ray, a bit each.
    [[nodiscard]] BufferRef<kinds::EnclosingMedia> enclosing_media() const {
        return enclosing_media_;
    }
    /// A G-buffer whose surfaces are ends of view rays (kernels/media/view_media.cl); empty where
    /// light scattered by media is not gathered.
    [[nodiscard]] const GBuffer& ends() const { return ends_; }

  private:
    std::shared_ptr<MediaBuffers> media_;
    DeviceBuffer<kinds::Transmittances> transmittance_;
    DeviceBuffer<kinds::MediaEmission> emission_;
    DeviceBuffer<kinds::EnclosingMedia> enclosing_media_;
    GBuffer ends_;
};

}  // namespace weft

#endif
