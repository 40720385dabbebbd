// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_VIEW_OPTIONS_H
#define WEFT_APP_VIEW_OPTIONS_H

#include "app/options.h"

namespace weft {

/// Adds `weft view`.
void add_view(CLI::App& app);

/// Reads its options. Throws Error (exit code 1).
[[nodiscard]] ViewOptions read_view(const CLI::App& command);

}  // namespace weft

#endif
