// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_REFERENCE_SUMS_H
#define WEFT_TRADEOFF_REFERENCE_SUMS_H

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "device/executor.h"
#include "film/film_sums.h"
#include "image/image.h"
#include "pipeline/frame_context.h"
#include "render/exact_renderer.h"
#include "render/path_renderer.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft {

/// Seeds of the two halves of a reference, which images that are compared with it must not have.
/// They differ, so that the halves are independent however the samples of one seed hang together.
inline constexpr std::array<std::uint32_t, 2> reference_seeds{77, 0x8000004D};

/// Layers of a reference with the beauty of each half of its samples, beside those of all samples.
inline constexpr const char* first_half_layer = "first_half";
inline constexpr const char* second_half_layer = "second_half";

/// Metadata of a reference and of its sums: the seconds that rendering the samples has taken.
inline constexpr const char* reference_seconds_key = "seconds";

/// When adding samples is to end before there are as many as wished.
struct GrowthLimits {
    /// Called between frames with the share of all samples that is there; to end at once where it
    /// returns false.
    /// Empty: go on always.
    std::function<bool(double)> keep_going{};
    /// Seconds after which no more samples are begun, once both halves have as many.
    double seconds = std::numeric_limits<double>::infinity();
};

/// The exact sums of the two halves of a reference as they grow: of samples 0, 1, ... of each seed.
/// They are kept in two files, so that a later run adds further samples to them: the same samples
/// give the same bits, however they are spread over runs.
class ReferenceSums {
  public:
    /// Finds out what is rendered, and how; renders nothing yet. The seed and the samples of
    /// `settings` are not used. All arguments but the last must outlive this.
    ReferenceSums(Executor& executor, const FlatScene& scene, const Camera& camera,
                  const PathSettings& settings);

    /// Identifies the image: a digest of scene, camera, size, filter and algorithm.
    [[nodiscard]] const std::string& identity() const noexcept { return identities_[0]; }
    /// What renders: path as well where `reference` was asked for and path is the better one.
    [[nodiscard]] Algorithm algorithm() const noexcept { return settings_.algorithm; }

    /// Keeps the sums in STEM.1.sums and STEM.2.sums from now on, and begins with those that are
    /// there; with none where they are missing, damaged or of another image.
    void keep_in(const std::filesystem::path& stem);

    /// Samples that both halves have of every pixel.
    [[nodiscard]] std::uint32_t samples() const;
    /// Seconds that rendering them has taken, in all runs.
    [[nodiscard]] double seconds() const noexcept { return seconds_[0] + seconds_[1]; }

    /// Adds samples to both halves until each has `count`, or as many as the other where one has
    /// more already. The files are written every minute, or less often where that takes long, and
    /// at the end. Returns whether `count` was reached, false where the time was over before.
    /// Throws Error (exit code 5; 130 where keep_going ended it, after the files were written).
    bool grow(std::uint32_t count, const GrowthLimits& limits);

    /// The means of all samples, with a layer for each half; without alpha, which would come back
    /// from a file as a part of beauty. To be called when both halves have samples, as many.
    [[nodiscard]] Image image();

  private:
    class Growth;

    void load(std::size_t half);
    void save(std::size_t half, const FilmSums& sums) const;
    [[nodiscard]] std::uint32_t samples_of(std::size_t half) const;
    [[nodiscard]] std::unique_ptr<ExactRenderer> make_renderer(std::size_t half, SampleRange range,
                                                               FilmSums sums);

    Executor& executor_;
    const FlatScene& scene_;
    const Camera& camera_;
    PathSettings settings_;
    std::shared_ptr<SceneBuffers> uploaded_;
    std::array<std::string, 2> identities_;
    std::array<FilmSums, 2> sums_;
    std::array<double, 2> seconds_{};
    std::array<std::filesystem::path, 2> files_;  ///< empty: not kept
};

}  // namespace weft

#endif
