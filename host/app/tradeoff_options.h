// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_TRADEOFF_OPTIONS_H
#define WEFT_APP_TRADEOFF_OPTIONS_H

#include "app/options.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds `weft tradeoff` to the command line.
void add_tradeoff(CLI::App& app);

/// Its options as given. Throws Error (exit code 1).
[[nodiscard]] TradeoffOptions read_tradeoff(const CLI::App& command);

/// Throws Error (exit code 1) where the metrics cannot compare pictures of that size.
void check_comparable(const FilmSize& size);

/// What of them `weft render` takes to make the same pictures by a preset; begins with a space.
[[nodiscard]] std::string tradeoff_picture_options(const TradeoffOptions& options);

/// A command line that measures the same again, with what was chosen where nothing was given.
[[nodiscard]] std::string tradeoff_command_line(const TradeoffOptions& options);

}  // namespace weft

#endif
