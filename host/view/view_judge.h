// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_JUDGE_H
#define WEFT_VIEW_VIEW_JUDGE_H

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "image/image.h"
#include "metrics/rgb_view.h"
#include "metrics/unbiased_mse.h"

namespace weft {

/// An image to be judged: its beauty, plane by plane.
struct JudgedImage {
    std::uint32_t pane = 0;
    std::uint64_t samples = 0;
    std::vector<float> values{};
};

/// What is judged of an image: its beauty, plane by plane; empty where it has none.
[[nodiscard]] std::vector<float> beauty_of(const Image& image);

/// Images of one size, and both halves of a reference.
struct JudgeTask {
    std::uint64_t version = 0;  ///< of the view, which the judgement is of
    std::uint32_t width = 0, height = 0;
    std::uint64_t reference_samples = 0;  ///< of each half
    std::array<std::vector<float>, 2> halves{};
    std::vector<JudgedImage> images{};
};

/// How far two images are apart.
struct ImageDistance {
    double hdrflip = 0.0;  ///< 0 to 1
    double vdp = 0.0;  ///< percent of the pixels in which an observer of a display with 100 cd/m^2
                       ///< sees a difference with a probability of at least 0.75 (HDR-VDP)
};

struct JudgedErrors {
    std::uint32_t pane = 0;
    std::uint64_t samples = 0;
    /// Unbiased, see UnbiasedErrors::relmse; empty while the noise of the reference is above
    /// most_noise_relmse.
    std::optional<ErrorEstimate> relmse{};
    ImageDistance distance{};   ///< to the mean of the halves
    std::vector<float> flip{};  ///< HDR-FLIP by pixel
};

struct Judgement {
    std::uint64_t version = 0;
    std::uint64_t reference_samples = 0;
    ImageDistance floor{};  ///< of one half to the other
    std::vector<JudgedErrors> images{};
};

/// Judges images. Throws std::invalid_argument where sizes differ. Ends early, without an image,
/// once `ended` is set.
[[nodiscard]] Judgement judge(const JudgeTask& task, const std::atomic<bool>& ended);

/// HDR-FLIP of an image to the mean of the halves, and of one half to the other.
struct ImageFlip {
    double error = 0.0;
    double floor = 0.0;
};

/// Measures only that, of an image of the size of a task. Throws std::invalid_argument likewise.
[[nodiscard]] ImageFlip flip_by_halves(const JudgeTask& task, const std::vector<float>& image);

/// Judges images in a thread of its own, so that views go on meanwhile.
class ViewJudge {
  public:
    ViewJudge();
    /// Waits for the metric that is being computed.
    ~ViewJudge();
    ViewJudge(const ViewJudge&) = delete;
    ViewJudge& operator=(const ViewJudge&) = delete;

    /// Whether it has nothing to do.
    [[nodiscard]] bool is_idle();
    /// Gives it a task; only while it is idle.
    void begin(JudgeTask task);
    /// The judgement that is ready, once.
    [[nodiscard]] std::optional<Judgement> take();

  private:
    void work();

    std::mutex mutex_;
    std::condition_variable has_task_;
    std::optional<JudgeTask> task_;  ///< until its judgement is ready
    std::optional<Judgement> ready_;
    std::atomic<bool> ended_ = false;
    std::thread thread_;
};

}  // namespace weft

#endif
