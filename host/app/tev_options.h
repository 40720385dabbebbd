// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_TEV_OPTIONS_H
#define WEFT_APP_TEV_OPTIONS_H

#include <optional>

#include "tev/tev_connection.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds --tev.
void add_tev(CLI::App& render);

/// Reads --tev: HOST, HOST:PORT or [IPv6]:PORT. Throws Error (exit code 1).
[[nodiscard]] std::optional<TevAddress> read_tev(const CLI::App& command);

}  // namespace weft

#endif
