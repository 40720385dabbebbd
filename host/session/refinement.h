// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_REFINEMENT_H
#define WEFT_SESSION_REFINEMENT_H

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "image/image.h"
#include "render/reference_renderer.h"
#include "render/renderer.h"

namespace weft {

/// The settings of the unbiased image that a preview with these settings is of, with any number of
/// samples.
[[nodiscard]] PathSettings exact_settings(const RenderSettings& preview);

/// Leads a finished preview on towards the truth: adds unbiased samples of the same image, by
/// Algorithm::reference, and corrects the preview by them (correct_preview).
class Refinement {
  public:
    /// Of previews with these settings.
    Refinement(Executor& executor, const FlatScene& scene, std::shared_ptr<SceneBuffers> uploaded,
               const Camera& camera, const RenderSettings& settings);

    /// Adds samples, at most `most` and such as take about `ms` milliseconds if one does not take
    /// longer. Returns false where none was added: the frame was cancelled, or `keep_going` ends
    /// it.
    bool render_frame(std::uint32_t most, double ms, const KeepGoing& keep_going);
    /// Expected milliseconds of a sample; 0 before the first.
    [[nodiscard]] double next_ms() const { return exact_->next_frame_ms(); }

    /// Unbiased samples of every pixel.
    [[nodiscard]] std::uint64_t samples() const { return exact_->samples(); }
    /// Whether there are as many samples as a correction takes.
    [[nodiscard]] bool can_correct() const { return samples() > 1; }
    /// Corrects the image of the preview, of so many samples. Only where can_correct().
    void correct(Image& preview, std::uint64_t preview_samples);

    [[nodiscard]] std::vector<FrameStats> take_stats() { return exact_->take_stats(); }

  private:
    /// The mean of the first samples.
    struct Part {
        std::uint64_t samples = 0;
        Image mean;
    };

    [[nodiscard]] std::uint64_t next_part() const;
    /// Keeps the mean where there are as many samples as the next part has.
    void keep_part();
    /// The part which, with all other samples as the second half, tells noise apart best.
    [[nodiscard]] const Part& first_half(std::uint64_t samples) const;

    std::unique_ptr<ExactRenderer> exact_;
    Part last_, before_;  ///< after 1, 2, 4, 8 ... samples, the last two of these
};

}  // namespace weft

#endif
