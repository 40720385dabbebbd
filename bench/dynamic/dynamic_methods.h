// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_DYNAMIC_DYNAMIC_METHODS_H
#define WEFT_BENCH_DYNAMIC_DYNAMIC_METHODS_H

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plan/frame_plan.h"
#include "render/renderer.h"

namespace weft::bench {

/// A way of making the frames of a sequence.
struct DynamicMethod {
    std::string name;  ///< for tables, files and JSON
    Algorithm algorithm = Algorithm::igi;
    SamplingSettings sampling{};
    bool fresh = false;  ///< other random numbers in every frame
    bool full = false;   ///< frames have direct light as well, and so have their times

    /// Whether records outlast their frame.
    [[nodiscard]] bool temporal() const {
        return algorithm == Algorithm::tic || (sampling.cached && sampling.temporal);
    }
};

/// The algorithm that the command line of the program calls so; empty where there is none.
[[nodiscard]] std::optional<Algorithm> algorithm_named(std::string_view name);

/// What is compared over sequences. `say` is told what this program has not got.
[[nodiscard]] std::vector<DynamicMethod> dynamic_methods(
    const std::function<void(const std::string&)>& say);

/// Of frames of `edge` x `edge` pixels.
[[nodiscard]] RenderSettings dynamic_settings(const DynamicMethod& method, std::uint32_t edge,
                                              std::uint32_t seed);

}  // namespace weft::bench

#endif
