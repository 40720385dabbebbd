// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_ALGORITHM_OPTIONS_H
#define WEFT_APP_ALGORITHM_OPTIONS_H

#include <string_view>

#include "plan/algorithm.h"
#include "plan/quality.h"

namespace CLI {
class App;
}

namespace weft {

struct RenderOptions;

/// Adds the options that choose what `weft render` computes.
void add_algorithm(CLI::App& render);

/// Reads these options and those of single algorithms, after all other options except those of
/// frames. Throws Error (exit code 1).
void read_algorithm(const CLI::App& command, RenderOptions& options);

}  // namespace weft

#endif
