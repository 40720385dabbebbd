// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_KERNELS_KERNEL_REPORT_H
#define WEFT_BENCH_KERNELS_KERNEL_REPORT_H

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/kernels/kernel_frames.h"

namespace weft::bench {

/// What the columns of the tables mean.
[[nodiscard]] std::string kernel_legend();

/// Medians over the repetitions, and ratios of times to those of the first backend: medians of the
/// ratios within each repetition.
[[nodiscard]] nlohmann::json kernel_json(const MeteredScene& scene);

/// The tables of one scene, of what kernel_json makes.
[[nodiscard]] std::string kernel_tables(const nlohmann::json& scene);

/// What each program of a backend took to be built or loaded; nothing where kernels are compiled
/// into Weft.
[[nodiscard]] nlohmann::json builds_json(const Executor& executor);

/// By backend but the first: means of the ratios of whole frames, over the scenes without and with
/// media, and of each kernel over all.
[[nodiscard]] nlohmann::json kernel_summary(const nlohmann::json& scenes);

}  // namespace weft::bench

#endif
