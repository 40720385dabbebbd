// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_REFERENCES_REFERENCES_RUN_H
#define WEFT_BENCH_REFERENCES_REFERENCES_RUN_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "bench/common/bench_scenes.h"
#include "bench/references/references_report.h"
#include "device/executor.h"
#include "tradeoff/reference_images.h"

namespace weft::bench {

/// Which references are made, and when each is good enough.
struct ReferencesRun {
    std::vector<BenchScene> scenes;
    std::vector<std::string> filters{"box"};
    std::uint32_t size = 512;
    std::uint32_t spp = 64;  ///< of the first step
    Algorithm algorithm = Algorithm::reference;
    FloorGoal goal;  ///< its seconds are not used
    /// Of each reference in this run.
    double limit_minutes = std::numeric_limits<double>::infinity();
    std::filesystem::path folder;
    std::function<void(const std::string&)> say;                   ///< is told of every step
    std::function<bool()> keep_going;                              ///< false ends the run
    std::function<void(const std::vector<ReferenceRow>&)> report;  ///< is called after every turn
};

/// The scenes that come with Weft: those of the tables first, then the others of the folder.
[[nodiscard]] std::vector<BenchScene> all_shipped_scenes(const std::filesystem::path& folder);

/// Makes the references in turns, until all have reached the goal or their limits. A scene that
/// cannot be rendered is named and left out of further turns; `status` is its exit code, of several
/// that of the first. Throws Error (exit code 130) where keep_going ended it, after `report` was
/// called.
[[nodiscard]] std::vector<ReferenceRow> make_references(const ReferencesRun& run,
                                                        Executor& executor, int& status);

}  // namespace weft::bench

#endif
