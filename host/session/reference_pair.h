// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_REFERENCE_PAIR_H
#define WEFT_SESSION_REFERENCE_PAIR_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "image/image.h"
#include "render/reference_renderer.h"

namespace weft {

/// Two halves of a reference of one image, with random numbers of their own, which grow sample by
/// sample: an image is judged by them, and their difference says how well (unbiased_errors).
class ReferencePair {
  public:
    /// The executor and the scene must outlive it, and the scene must stay as it is. `settings` are
    /// those of make_exact_renderer, but for the seed, from which the halves' seeds follow.
    ReferencePair(Executor& executor, const FlatScene& scene,
                  const std::shared_ptr<SceneBuffers>& uploaded, const Camera& camera,
                  const PathSettings& settings);

    /// Adds samples to the half that has fewer: one, or as many as take about `ms` milliseconds.
    /// Returns false where none was added: the frame was cancelled, or `keep_going` ended it.
    bool render_frame(double ms, const KeepGoing& keep_going);
    /// Expected milliseconds of the next sample; 0 before the first.
    [[nodiscard]] double next_ms() const { return smaller().next_frame_ms(); }
    /// Samples of every pixel that each half has at least.
    [[nodiscard]] std::uint64_t samples() const { return smaller().samples(); }
    /// The mean of a half, 0 or 1, which has at least one sample. Its first layer is the beauty.
    [[nodiscard]] Image half(std::size_t index) { return halves_.at(index)->image(); }

  private:
    [[nodiscard]] ExactRenderer& smaller() const {
        return *halves_[halves_[1]->samples() < halves_[0]->samples() ? 1 : 0];
    }

    std::array<std::unique_ptr<ExactRenderer>, 2> halves_;
};

}  // namespace weft

#endif
