// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_SELFTEST_OPTIONS_H
#define WEFT_APP_SELFTEST_OPTIONS_H

#include "app/options.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds `weft selftest` to the command line.
void add_selftest(CLI::App& app);

/// Reads the options of the command. Throws Error (exit code 1).
[[nodiscard]] SelftestOptions read_selftest(const CLI::App& command);

}  // namespace weft

#endif
