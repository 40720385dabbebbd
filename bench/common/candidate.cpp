// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/candidate.h"

#include <algorithm>
#include <limits>

#include "shared/shared_types.h"

namespace weft::bench {
namespace {

bool is_hit(AnswerKind kind, std::uint32_t answer) {
    return kind == AnswerKind::triangle ? answer != INVALID_INDEX : answer != 0;
}

Figures check(const Candidate& candidate, AnswerKind kind,
              const std::vector<std::uint32_t>& answers,
              const std::vector<std::uint32_t>& expected) {
    Figures figures;
    figures.name = candidate.name;
    figures.is_yardstick = candidate.is_yardstick;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        if (is_hit(kind, answers[i])) {
            ++figures.hits;
            figures.id_sum += answers[i];
        }
        if (answers[i] != expected[i]) ++figures.differing;
    }
    return figures;
}

/// A ray set that takes longer is ended after this many repetitions.
constexpr double patience_ms = 20e3;
constexpr std::uint32_t least_repetitions = 5;

double rate(std::uint64_t rays, double ms) {
    return ms > 0.0 ? static_cast<double>(rays) * 1e-3 / ms : 0.0;
}

}  // namespace

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<Figures> measure(const std::vector<Candidate>& candidates, AnswerKind kind,
                             std::uint64_t rays, std::uint32_t repetitions) {
    std::vector<Figures> all;
    std::vector<std::uint32_t> expected;
    for (const Candidate& candidate : candidates) {
        if (candidate.prepare) candidate.prepare();
        (void)candidate.run();
        const auto answers = candidate.answers();
        if (expected.empty()) expected = answers;
        all.push_back(check(candidate, kind, answers, expected));
    }
    const RunTimer watch;
    for (std::uint32_t repetition = 0; repetition < repetitions; ++repetition) {
        if (repetition >= least_repetitions && watch.elapsed().ms > patience_ms) break;
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            if (candidates[c].prepare) candidates[c].prepare();
            all[c].runs.push_back(candidates[c].run());
        }
    }
    for (Figures& figures : all) {
        std::vector<double> ms;
        std::vector<double> wall;
        for (const Timing& timing : figures.runs) {
            ms.push_back(timing.ms);
            wall.push_back(timing.wall_ms);
        }
        figures.mrays = rate(rays, median(ms));
        figures.wall_mrays = rate(rays, median(wall));
    }
    return all;
}

double speed_ratio(const Figures& a, const Figures& b, double Timing::*value) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(a.runs.size(), b.runs.size()); ++i)
        if (a.runs[i].*value > 0.0) ratios.push_back(b.runs[i].*value / a.runs[i].*value);
    return median(ratios);
}

YardstickRatio ratio_to_best(const Figures& a, const std::vector<Figures>& all,
                             double Timing::*value) {
    YardstickRatio best{std::numeric_limits<double>::max(), {}};
    for (const Figures& figures : all) {
        if (!figures.is_yardstick) continue;
        const double ratio = speed_ratio(a, figures, value);
        if (ratio < best.ratio) best = {ratio, figures.name};
    }
    return best;
}

}  // namespace weft::bench
