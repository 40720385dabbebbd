// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/path_algorithms.h"

#include <algorithm>
#include <array>
#include <string>

#include "base/error.h"

namespace weft::bench {
namespace {

template <Algorithm algorithm>
std::unique_ptr<FrameRenderer> make(Executor& executor, const FlatScene& scene,
                                    const Camera& camera, const PathSettings& settings) {
    PathSettings own = settings;
    own.algorithm = algorithm;
    return make_exact_renderer(executor, scene,
                               std::make_shared<SceneBuffers>(upload_scene(executor, scene)),
                               camera, own, {});
}

constexpr std::array algorithms{PathAlgorithm{"path", make<Algorithm::path>},
                                PathAlgorithm{"reference", make<Algorithm::reference>}};

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
