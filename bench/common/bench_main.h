// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_BENCH_MAIN_H
#define WEFT_BENCH_COMMON_BENCH_MAIN_H

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace weft::bench {

/// The exit code of a benchmark: what `body` returns; where it throws, one line on standard error
/// that begins with `bench NAME`, and the Error's own code, 4 out of memory, 3 for all else.
[[nodiscard]] int bench_main(const char* name, const std::function<int()>& body);

/// Reads the command line into what `app` was given. Returns an exit code where that was all: 0
/// after --help, 1 after a line that says what is wrong.
[[nodiscard]] std::optional<int> parse_arguments(CLI::App& app, int argc, char** argv);

/// Lets no parallel loop use more threads while it lives; `threads` 0: all. To be made before
/// anything else, for BVH builders and Embree would start a worker per core.
[[nodiscard]] std::unique_ptr<tbb::global_control> limit_threads(int threads);

/// Prints at once, wherever standard output goes.
void print(const std::string& text);

}  // namespace weft::bench

#endif
