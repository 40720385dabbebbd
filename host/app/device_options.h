// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_DEVICE_OPTIONS_H
#define WEFT_APP_DEVICE_OPTIONS_H

#include <optional>
#include <string>

#include "app/options.h"

namespace CLI {
class App;
}

namespace weft {

/// Adds --backend, which `backend` describes, and --device.
void add_device_choice(CLI::App& command, const std::string& backend);

/// The backend as given, if any. Throws Error (exit code 1).
[[nodiscard]] std::optional<Backend> read_backend(const CLI::App& command);

/// The device as given, if any: an index if all digits (fits 32 bits), else a name. Throws Error
/// (exit code 1).
[[nodiscard]] std::optional<std::string> read_device(const CLI::App& command);

}  // namespace weft

#endif
