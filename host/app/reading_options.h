// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_READING_OPTIONS_H
#define WEFT_APP_READING_OPTIONS_H

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "scene/load/load_scene.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds --light, --environment, --environment-rotation and --materials to a command that reads a
/// scene.
void add_reading(CLI::App& command);

/// Reads them. Throws Error (exit code 1).
[[nodiscard]] SceneReading parse_reading(const CLI::App& command);

/// The name of --light that the command line uses; null for the choice without the option.
[[nodiscard]] nlohmann::json light_choice_json(DefaultLight choice);

/// The name of --materials.
[[nodiscard]] std::string_view material_detail_name(MaterialDetail detail);

/// Those of the options that were given, each after a blank, as the shell reads them.
[[nodiscard]] std::string reading_arguments(const SceneReading& reading);

}  // namespace weft

#endif
