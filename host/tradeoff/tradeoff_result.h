// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_TRADEOFF_RESULT_H
#define WEFT_TRADEOFF_TRADEOFF_RESULT_H

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "metrics/unbiased_mse.h"
#include "plan/preset.h"

namespace weft {

/// The errors that settings are judged by, each 0 for a perfect image.
enum class ErrorMeasure : std::uint8_t {
    hdrflip,  ///< mean HDR-FLIP, 0 to 1
    vdp75,    ///< HDR-VDP, percent of pixels seen to differ with P >= 75 %, published protocol
    vdp95,    ///< the same with P >= 95 %
    vdp75_display,  ///< on a display of 100 cd/m^2 at value 1
    vdp95_display,
    relmse,
    bias,  ///< magnitude of the relative error of the image's mean
};
inline constexpr std::size_t error_measures = 7;

/// The median of repeated measurements, and the interval in which one more will lie.
struct Interval {
    double median = 0.0;
    /// Ends of the interval that holds a further measurement with a confidence of 95 %: of times by
    /// time_interval, of errors by prediction_interval.
    double low = 0.0;
    double high = 0.0;
};

/// How far a time may lie from the others of its setting, estimated from all settings together.
struct TimeSpread {
    /// One more time lies between the median of its setting divided and multiplied by this.
    double factor = 1.0;
    double degrees = 0.0;        ///< of freedom: few where whole rounds were slower than others
    std::size_t deviations = 0;  ///< number of times it is estimated from; 0: it is not known
};

/// One setting with the time of its images and their errors against the reference.
struct TradeoffPoint {
    std::string name;    ///< unique, such as "ais threshold 20"
    std::string family;  ///< series in plots: the algorithm, such as "ais" or "path"
    Preset preset;
    Interval ms;                                   ///< wall time of the frames of an image
    std::vector<Interval> errors;                  ///< by ErrorMeasure, error_measures of them
    std::vector<double> runs_ms;                   ///< raw times, one for each seed
    std::vector<std::vector<double>> runs_errors;  ///< raw errors by seed, each by ErrorMeasure
    /// Relative squared error without the reference's noise, from its halves: the mean of the
    /// images of all seeds with its interval, and that of each; none where there are no halves.
    std::optional<ErrorEstimate> unbiased_relmse{};
    std::vector<ErrorEstimate> runs_unbiased{};
    std::uint64_t rays = 0;  ///< of one image
    bool on_front = false;   ///< by time and the chosen measure; see pareto_front
    Image image;             ///< beauty layer, of the first seed; kept for points on the front
    std::vector<float> error_map;  ///< HDR-FLIP by pixel, row-major; kept for points on the front
};

/// An image that another renderer made, or Weft in the same time.
struct OtherRendererPoint {
    std::string name;       ///< renderer, variant and denoiser
    double budget_s = 0.0;  ///< time that it was given
    double seconds = 0.0;   ///< time that it took, without set-up
    double samples = 0.0;   ///< per pixel, 0 where unknown
    bool denoised = false;
    std::vector<double> errors;  ///< by ErrorMeasure
    std::optional<ErrorEstimate> unbiased_relmse{};
    Image image;  ///< at least as large as its thumbnail
};

/// Advice on a budget or an error: a sentence, and the point that it names.
struct TradeoffAdvice {
    /// One of both: milliseconds that an image may take, or the error that it may have.
    std::optional<double> budget_ms, error;
    std::optional<std::size_t> point;  ///< index into points; none where no point keeps to it
    std::string sentence;
    std::string preset_file;  ///< name beside the page; empty where there is no point
};

/// The reference and its noise.
struct TradeoffReference {
    std::uint64_t samples = 0;  ///< per pixel
    /// Error of one half of its samples against the other, by ErrorMeasure: twice that which the
    /// noise of the whole causes, and in relMSE four times. Errors as small as that of the whole's
    /// noise are meaningless.
    std::vector<double> noise_floor;
    /// What the noise of the whole adds to relMSE; intervals of unbiased_relmse are too narrow
    /// where it is above most_noise_relmse.
    std::optional<double> noise_relmse{};
    Image image;
};

/// A check of the intervals: points on the front, measured again after the front was decided.
struct FrontCheck {
    struct Point {
        std::size_t point = 0;       ///< index into points
        std::vector<double> ms;      ///< one for each new seed
        std::vector<double> errors;  ///< likewise, by the chosen measure
    };
    std::vector<Point> points;
    std::uint32_t images = 0;
    std::uint32_t times_within = 0;   ///< images whose time is in the interval of their point
    std::uint32_t errors_within = 0;  ///< images whose error is
};

/// All results of a run of `weft tradeoff`.
struct TradeoffResult {
    std::string scene;       ///< file name
    std::string scene_path;  ///< as the command line names it
    std::string folder;      ///< of presets and page, as the command line names it
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    double exposure_ev = 0.0;  ///< of all thumbnails
    std::uint32_t repetitions = 0;
    ErrorMeasure measure = ErrorMeasure::hdrflip;  ///< for the front and the advice
    nlohmann::json machine;     ///< processor, device, driver, versions: names and values
    std::string command;        ///< command line that repeats the run
    std::string image_options;  ///< options of `weft render` that presets lack: size, device
    TradeoffReference reference;
    std::vector<TradeoffPoint> points;  ///< by rising time
    TimeSpread time_spread;
    std::vector<OtherRendererPoint> others;
    std::vector<std::string> other_notes;
    std::vector<TradeoffAdvice> advice;
    std::vector<std::string> skipped;  ///< names of settings that were too slow to measure
    std::optional<FrontCheck> check;   ///< where --verify was given
};

/// The error of a point by that measure; its numbers are not finite where there is none.
[[nodiscard]] Interval error_of(const TradeoffPoint& point, ErrorMeasure measure);

/// The error by that measure in a list by ErrorMeasure; not finite where there is none.
[[nodiscard]] double error_of(std::span<const double> errors, ErrorMeasure measure);

/// Name in JSON and CSV, such as "hdrflip" or "vdp75_display".
[[nodiscard]] const char* to_string(ErrorMeasure measure);
/// Name for people, such as "HDR-VDP 75 % (display)".
[[nodiscard]] const char* label(ErrorMeasure measure);

}  // namespace weft

#endif
