// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_MERGE_OPTIONS_H
#define WEFT_APP_MERGE_OPTIONS_H

#include "app/options.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds `weft merge` to the command line.
void add_merge(CLI::App& app);

/// Reads the options of the command. Throws Error (exit code 1).
[[nodiscard]] MergeOptions read_merge(const CLI::App& command);

}  // namespace weft

#endif
