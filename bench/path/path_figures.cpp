// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_figures.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

namespace weft::bench {
namespace {

std::vector<double> times(const PathFigures& figures, double Timing::*value) {
    std::vector<double> found;
    for (const Timing& timing : figures.runs) found.push_back(timing.*value);
    return found;
}

/// Takes a candidate's repetitions together; one that dropped out keeps none.
void conclude(PathFigures& figures, Images& images, std::uint64_t rays, const PathImage& image) {
    if (!figures.problem.empty()) {
        figures.runs.clear();
        images.clear();
        return;
    }
    const double middle = median(times(figures, &Timing::ms));
    if (middle > 0.0) {
        const double pixels = static_cast<double>(image.width) * image.height;
        figures.msamples = pixels * image.samples * 1e-3 / middle;
        figures.mrays = static_cast<double>(rays) * 1e-3 / middle;
    }
    for (const std::vector<float>& one : images)
        figures.mean += std::accumulate(one.begin(), one.end(), 0.0) /
                        static_cast<double>(one.size() * images.size());
}

/// The mean images of algorithms, over their backends, whose noise is the same.
std::vector<std::vector<double>> algorithm_means(const std::vector<PathFigures>& figures,
                                                 const std::vector<Images>& images) {
    std::map<std::string, std::vector<std::size_t>> members;
    for (std::size_t c = 0; c < figures.size(); ++c)
        if (figures[c].ran()) members[figures[c].candidate_name.algorithm].push_back(c);
    std::vector<std::vector<double>> means;
    for (const auto& [name, backends] : members) {
        std::vector<double> mean(images[backends.front()].front().size());
        for (const std::size_t c : backends) {
            const Moments one = moments(images[c]);
            for (std::size_t i = 0; i < mean.size(); ++i)
                mean[i] += one.mean[i] / static_cast<double>(backends.size());
        }
        means.push_back(std::move(mean));
    }
    return means;
}

void compare(std::vector<PathFigures>& figures, const std::vector<Images>& images,
             const PathImage& image) {
    const auto means = algorithm_means(figures, images);
    if (means.empty()) return;
    const std::vector<double> scale = noise_scale(means);
    std::size_t mitsuba = figures.size();
    for (std::size_t c = 0; c < figures.size(); ++c) {
        if (!figures[c].ran()) continue;
        figures[c].variance = relative_variance(images[c], scale);
        if (figures[c].is_mitsuba()) mitsuba = c;
    }
    if (mitsuba == figures.size()) return;
    const PathFigures& theirs = figures[mitsuba];
    for (std::size_t c = 0; c < figures.size(); ++c) {
        PathFigures& ours = figures[c];
        if (!ours.ran() || ours.is_mitsuba() || !(ours.variance.value > 0.0)) continue;
        AgainstMitsuba against;
        against.variance = theirs.variance / ours.variance;
        against.time = paired_ratio(times(theirs, &Timing::ms), times(ours, &Timing::ms));
        against.processor =
            paired_ratio(times(theirs, &Timing::cpu_ms), times(ours, &Timing::cpu_ms));
        against.efficiency = against.variance * against.time;
        against.processor_efficiency = against.variance * against.processor;
        against.means = compare_means(images[mitsuba], images[c], image.width, image.height);
        ours.against = against;
    }
}

}  // namespace

std::vector<PathFigures> measure_paths(
    const std::vector<std::unique_ptr<PathCandidate>>& candidates, const PathImage& image,
    std::uint32_t repetitions) {
    std::vector<PathFigures> figures(candidates.size());
    std::vector<Images> images(candidates.size());
    std::vector<std::uint64_t> rays(candidates.size());
    for (std::size_t c = 0; c < candidates.size(); ++c)
        figures[c].candidate_name = candidates[c]->candidate_name();
    for (std::uint32_t repetition = 0; repetition <= repetitions; ++repetition)
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            candidates[c]->prepare(repetition);
            auto run = candidates[c]->run();
            figures[c].problem = candidates[c]->problem();
            if (!run || repetition == 0) continue;
            figures[c].runs.push_back(run->timing);
            images[c].push_back(std::move(run->values));
            rays[c] = run->rays;
        }
    for (std::size_t c = 0; c < candidates.size(); ++c)
        conclude(figures[c], images[c], rays[c], image);
    compare(figures, images, image);
    return figures;
}

}  // namespace weft::bench
