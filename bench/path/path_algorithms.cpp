// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_algorithms.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/error.h"

namespace weft::bench {
namespace {

std::unique_ptr<FrameRenderer> make_path(Executor& executor, const FlatScene& scene,
                                         const Camera& camera, const PathSettings& settings) {
    return std::make_unique<PathRenderer>(executor, scene, camera, settings, FilmSums{});
}

constexpr std::array algorithms{PathAlgorithm{"path", make_path}};

}  // namespace

std::span<const PathAlgorithm> path_algorithms() {
    return algorithms;
}

const PathAlgorithm& path_algorithm(std::string_view name) {
    const auto* const found =
        std::find_if(algorithms.begin(), algorithms.end(),
                     [&](const PathAlgorithm& algorithm) { return algorithm.name == name; });
    if (found != algorithms.end()) return *found;
    std::string expected;
    for (const PathAlgorithm& algorithm : algorithms)
        expected += (expected.empty() ? "" : ", ") + std::string(algorithm.name);
    throw Error(ExitCode::usage, "no algorithm of the path family is called '" + std::string(name) +
                                     "', expected one of: " + expected);
}

}  // namespace weft::bench
