// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_OVERLAY_OUTPUT_H
#define WEFT_APP_OVERLAY_OUTPUT_H

namespace CLI {
class App;
}

namespace weft {

struct RenderOptions;

/// Adds `--overlays` to `weft render`.
void add_overlays(CLI::App& render);

/// Reads `--overlays`, after all other options have been read. Throws Error (exit code 1).
void read_overlays(const CLI::App& command, RenderOptions& options);

}  // namespace weft

#endif
