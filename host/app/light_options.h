// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_LIGHT_OPTIONS_H
#define WEFT_APP_LIGHT_OPTIONS_H

#include <nlohmann/json_fwd.hpp>

#include "scene/default_light.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds --light to a command that reads a scene.
void add_light_choice(CLI::App& command);

/// Reads --light. Throws Error (exit code 1).
[[nodiscard]] DefaultLight read_light_choice(const CLI::App& command);

/// The name the command line uses; null for the choice without the option.
[[nodiscard]] nlohmann::json light_choice_json(DefaultLight choice);

}  // namespace weft

#endif
