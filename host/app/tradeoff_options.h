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

/// Reads the options of the command. Throws Error (exit code 1).
[[nodiscard]] TradeoffOptions read_tradeoff(const CLI::App& command);

/// Throws Error (exit code 1) where the metrics cannot compare images of that size.
void check_comparable(const FilmSize& size);

/// The options with which `weft render` makes the same images from a preset; begins with a space.
[[nodiscard]] std::string tradeoff_image_options(const TradeoffOptions& options);

/// A command line that repeats the run, with the values that were chosen where none were given.
[[nodiscard]] std::string tradeoff_command_line(const TradeoffOptions& options);

}  // namespace weft

#endif
