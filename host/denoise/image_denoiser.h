// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_IMAGE_DENOISER_H
#define WEFT_DENOISE_IMAGE_DENOISER_H

#include <cstdint>
#include <memory>
#include <string>

#include "denoise/denoise_view.h"
#include "denoise/open_image_denoise.h"
#include "image/image.h"
#include "plan/denoiser.h"

namespace weft {

/// Removes noise from images in one way.
class ImageDenoiser {
  public:
    /// Throws Error (exit code 3) where what it takes is not there; see OpenImageDenoise.
    explicit ImageDenoiser(Denoiser denoiser);

    /// Replaces the beauty of an image and keeps the rendered one as the layer noisy_layer_name;
    /// metadata "denoiser" says what was done. All other layers stay as they are. `samples`: of
    /// every pixel. Returns false, and leaves the image as it is, where that takes a variance and a
    /// single sample has none.
    bool denoise(Image& image, std::uint64_t samples, const DenoiseView& view) const;

    [[nodiscard]] Denoiser denoiser() const { return denoiser_; }

  private:
    Denoiser denoiser_;
    std::unique_ptr<const OpenImageDenoise> library_;
};

}  // namespace weft

#endif
