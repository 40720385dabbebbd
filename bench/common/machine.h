// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_MACHINE_H
#define WEFT_BENCH_COMMON_MACHINE_H

#include <filesystem>
#include <nlohmann/json.hpp>

#include "device/executor.h"

namespace weft::bench {

/// Processor, memory and how busy the machine is now; `threads` as the run was asked for.
[[nodiscard]] nlohmann::json machine_json(int threads);

/// Versions of Weft, the compiler and the libraries that results depend on.
[[nodiscard]] nlohmann::json versions_json();

/// A device as reports name it.
[[nodiscard]] nlohmann::json device_json(const Executor& executor);

/// Writes a report, whole or not at all. Throws Error (exit code 5).
void write_json(const std::filesystem::path& path, const nlohmann::json& json);

}  // namespace weft::bench

#endif
