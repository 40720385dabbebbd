// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_COMPARE_OPTIONS_H
#define WEFT_APP_COMPARE_OPTIONS_H

#include "app/options.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds the command `compare` with its options.
void add_compare(CLI::App& app);

/// Reads the options of the command. Throws Error (exit code 1).
[[nodiscard]] CompareOptions read_compare(const CLI::App& command);

}  // namespace weft

#endif
