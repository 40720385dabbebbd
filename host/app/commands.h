// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_COMMANDS_H
#define WEFT_APP_COMMANDS_H

#include "app/options.h"
#include "base/diagnostics.h"
#include "base/error.h"

namespace weft {

/// `weft render`: reads, renders, writes. Returns success or interrupted; failures are Errors.
[[nodiscard]] ExitCode render_command(const RenderOptions& options, Diagnostics& diagnostics);

/// `weft merge`: the exact union of sample ranges, as a picture that holds them.
void merge_command(const MergeOptions& options);

/// `weft compare`: how two pictures differ, on stdout, and a map of it.
void compare_command(const CompareOptions& options);

/// `weft tradeoff`: what accuracy costs on a scene, in files of a folder and on stdout. Throws
/// Error (exit code 130) where the user ends it.
void tradeoff_command(const TradeoffOptions& options, Diagnostics& diagnostics);

/// `weft info`: what a scene holds and calls for, on stdout.
void info_command(const InfoOptions& options, Diagnostics& diagnostics);

/// `weft devices`: what kernels can run on, on stdout.
void devices_command(const DevicesOptions& options);

/// `weft selftest`: what has a known answer, on stdout. Returns success where all of it came out,
/// else the code for devices that fail.
[[nodiscard]] ExitCode selftest_command(const SelftestOptions& options);

}  // namespace weft

#endif
