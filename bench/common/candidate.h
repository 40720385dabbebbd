// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_CANDIDATE_H
#define WEFT_BENCH_COMMON_CANDIDATE_H

#include <chrono>
#include <cstdint>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace weft::bench {

/// Duration of one run.
struct Timing {
    double ms = 0.0;       ///< on the device, launch by launch; elsewhere wall time
    double wall_ms = 0.0;  ///< as the caller sees it
    double cpu_ms = 0.0;   ///< processor time of all threads of the process
};

/// Measures from its making on.
class RunTimer {
  public:
    /// Wall and processor time so far; `ms` is the wall time.
    [[nodiscard]] Timing elapsed() const {
        const double wall = std::chrono::duration<double, std::milli>(
                                std::chrono::steady_clock::now() - wall_start_)
                                .count();
        const double cpu = 1e3 * static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
        return {wall, wall, cpu};
    }

  private:
    std::chrono::steady_clock::time_point wall_start_ = std::chrono::steady_clock::now();
    std::clock_t cpu_start_ = std::clock();
};

/// One way of answering the queries of a ray set.
struct Candidate {
    std::string name;
    bool is_yardstick = false;      ///< one of the calls that ratios refer to
    std::function<void()> prepare;  ///< restores the input; not timed; may be empty
    std::function<Timing()> run;    ///< the timed part
    /// By ray: id of the closest triangle or INVALID_INDEX; of occlusion queries 1 or 0.
    std::function<std::vector<std::uint32_t>()> answers;
};

/// What was measured of one candidate.
struct Figures {
    std::string name;
    bool is_yardstick = false;
    std::vector<Timing> runs;
    double mrays = 0.0;           ///< million rays per second, from the median of Timing::ms
    double wall_mrays = 0.0;      ///< the same from the median of Timing::wall_ms
    std::uint64_t hits = 0;       ///< rays that hit or are blocked
    std::uint64_t id_sum = 0;     ///< over hits; occlusion queries: equal to `hits`
    std::uint64_t differing = 0;  ///< rays answered differently from the first candidate
};

/// Whether a ray's answer is a hit: an id for closest hits, 1 for occlusion.
enum class AnswerKind : std::uint8_t { triangle, blocked };

/// Runs all candidates once untimed, compares their answers, then `repetitions` times all of them
/// in turn, so that whatever else the machine does meets all alike; after five it ends where it
/// has taken long. `rays` counts rays per run.
[[nodiscard]] std::vector<Figures> measure(const std::vector<Candidate>& candidates,
                                           AnswerKind kind, std::uint64_t rays,
                                           std::uint32_t repetitions);

/// How many times as fast `a` is as `b`: median over the repetitions of the ratios within each.
/// `value` is the time to compare; a busy machine disturbs processor time the least.
[[nodiscard]] double speed_ratio(const Figures& a, const Figures& b, double Timing::*value);

/// The smallest speed_ratio of `a` to any yardstick among `all`, and which one that is.
struct YardstickRatio {
    double ratio = 0.0;
    std::string yardstick;
};
[[nodiscard]] YardstickRatio ratio_to_best(const Figures& a, const std::vector<Figures>& all,
                                           double Timing::*value = &Timing::ms);

/// Median, of an even number of values the mean of the middle two. 0 for an empty list.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace weft::bench

#endif
