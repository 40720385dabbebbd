// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_PATH_FIGURES_H
#define WEFT_BENCH_PATH_PATH_FIGURES_H

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/common/candidate.h"
#include "bench/path/agreement.h"
#include "bench/path/image_noise.h"
#include "bench/path/path_candidates.h"
#include "bench/path/ratio.h"

namespace weft::bench {

/// A candidate of Weft next to Mitsuba; above 1 is better than Mitsuba.
struct AgainstMitsuba {
    Ratio variance;              ///< Mitsuba's variance of an image over the candidate's
    Ratio time;                  ///< Mitsuba's seconds of an image over the candidate's
    Ratio processor;             ///< the same of processor time
    Ratio efficiency;            ///< `variance` times `time`
    Ratio processor_efficiency;  ///< `variance` times `processor`
    Agreement means;
};

/// What was measured of one candidate in one scene.
struct PathFigures {
    CandidateName candidate_name;
    std::vector<Timing> runs;  ///< one of each independent image
    double msamples = 0.0;     ///< million samples per second, from the median time
    double mrays = 0.0;        ///< million rays; 0 where they are not known
    double mean = 0.0;         ///< of all values of all images
    Ratio variance;            ///< relative, of one image
    std::string problem;       ///< why there are no runs; else empty
    std::optional<AgainstMitsuba> against;

    [[nodiscard]] bool is_mitsuba() const { return candidate_name.algorithm == mitsuba_algorithm; }
    [[nodiscard]] bool ran() const noexcept { return !runs.empty(); }
};

/// The image that all render.
struct PathImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t samples = 0;  ///< per pixel
};

/// Lets all candidates render once untimed, which compiles kernels, then `repetitions` images of
/// other seeds in turn, and compares them with Mitsuba's. Whoever drops out stays in the list with
/// its problem.
[[nodiscard]] std::vector<PathFigures> measure_paths(
    const std::vector<std::unique_ptr<PathCandidate>>& candidates, const PathImage& image,
    std::uint32_t repetitions);

}  // namespace weft::bench

#endif
