// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_OUTPUT_DRIVER_H
#define WEFT_SESSION_OUTPUT_DRIVER_H

#include <cstdint>
#include <optional>
#include <vector>

#include "film/film_sums.h"
#include "image/image.h"
#include "pipeline/light_work.h"
#include "plan/algorithm.h"
#include "plan/denoiser.h"

namespace weft {

/// An image that a session has rendered.
struct SessionImage {
    Image image;                   ///< all layers
    std::optional<FilmSums> sums;  ///< of path tracing
    Algorithm algorithm{};
    std::uint64_t samples = 0;  ///< of every pixel
    std::uint32_t seed = 0;
    bool complete = true;                ///< false where the user has ended it early
    Denoiser denoiser = Denoiser::none;  ///< that its beauty has gone through
    double denoise_ms = 0.0;             ///< and how long that took
    double correct_ms = 0.0;  ///< how long the correction of a preview took, see correct_preview
    /// See FrameRenderer::light.
    std::vector<LightShare> light;
};

/// Receives the images that a session has rendered, such as to write files or in a test.
class OutputDriver {
  public:
    virtual ~OutputDriver() = default;

    /// Takes the image that a call of RenderSession::render has finished.
    virtual void write(SessionImage image) = 0;

    /// Milliseconds that `write`, and `save` at the end, will take for an image like this one; 0
    /// where that cannot be told. Does neither.
    [[nodiscard]] virtual double write_ms(const SessionImage& image) {
        (void)image;
        return 0.0;
    }

    /// Milliseconds after which `save` is called again while path tracing goes on; empty: never,
    /// not even at its end.
    [[nodiscard]] virtual std::optional<double> save_interval_ms() const { return {}; }
    /// Takes the sums of path tracing, which a later run can continue, and their image. Where it
    /// throws Error, rendering goes on; the last call's Error is thrown after the image is written.
    virtual void save(const FilmSums& sums, const Image& image) {
        (void)sums;
        (void)image;
    }
};

}  // namespace weft

#endif
