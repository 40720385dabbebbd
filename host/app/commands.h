// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_COMMANDS_H
#define WEFT_APP_COMMANDS_H

#include "app/options.h"
#include "base/diagnostics.h"
#include "base/error.h"

namespace weft {

/// `weft render`: reads, renders, writes. Returns success or interrupted; failures are Errors.
[[nodiscard]] ExitCode render_command(const RenderOptions& given, Diagnostics& diagnostics);

/// `weft view`: serves a page to look at the scene from, until the user ends it.
[[nodiscard]] ExitCode view_command(const ViewOptions& options, Diagnostics& diagnostics);

/// `weft merge`: adds up the exact sums of disjoint sample ranges, and writes an image that holds
/// them. Warns where samples between those of the parts are missing.
void merge_command(const MergeOptions& options, Diagnostics& diagnostics);

/// `weft compare`: prints how two images differ on stdout, and writes a map of their differences.
void compare_command(const CompareOptions& options);

/// `weft tradeoff`: measures what accuracy costs on a scene, and writes files to a folder and a
/// summary to stdout. Throws Error (exit code 130) where the user ends it.
void tradeoff_command(const TradeoffOptions& options, Diagnostics& diagnostics);

/// `weft info`: prints what a scene contains and needs on stdout.
void info_command(const InfoOptions& options, Diagnostics& diagnostics);

/// `weft devices`: prints the devices that can run kernels on stdout, and what is wrong with
/// others. Returns success; with --check the code for devices that fail where one does.
[[nodiscard]] ExitCode devices_command(const DevicesOptions& options);

/// `weft selftest`: runs the cases with known answers and prints their results on stdout. Returns
/// success where all of them pass, else the code for devices that fail.
[[nodiscard]] ExitCode selftest_command(const SelftestOptions& options);

}  // namespace weft

#endif
