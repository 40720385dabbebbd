// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_RENDER_PATH_H
#define WEFT_APP_RENDER_PATH_H

#include <memory>

#include "app/options.h"
#include "app/progress.h"
#include "base/stopwatch.h"
#include "frame/path_renderer.h"

namespace weft {

/// The path tracer that the options ask for. With --resume, goes on from the file where there is
/// one. Throws Error (exit code 2) where that file is of another picture.
[[nodiscard]] std::unique_ptr<PathRenderer> make_path_renderer(Executor& executor,
                                                               const FlatScene& scene,
                                                               const Camera& camera,
                                                               const RenderOptions& options,
                                                               const PathSettings& settings);

/// Renders until all samples are there, the time or the target error is reached, or the user ends
/// it; keeps the file of --resume up to date. Returns whether the user let it end.
[[nodiscard]] bool render_path(PathRenderer& renderer, const RenderOptions& options,
                               Progress& progress, const Stopwatch& watch);

/// Writes sums and the picture they make to the file of --resume, if there is one.
void write_checkpoint(const FilmSums& sums, Image image, const RenderOptions& options);

}  // namespace weft

#endif
