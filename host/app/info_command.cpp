// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/info_json.h"
#include "app/info_text.h"
#include "app/print.h"
#include "scene/load/load_scene.h"

namespace weft {

void info_command(const InfoOptions& options, Diagnostics& diagnostics) {
    const Scene scene = load_scene(options.scene, diagnostics, options.reading);
    const nlohmann::json info = info_json(scene, diagnostics);
    print_warnings(diagnostics, options.verbose);
    print_result(options.json ? json_document(info) : info_text(info));
}

}  // namespace weft
