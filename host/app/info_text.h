// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_INFO_TEXT_H
#define WEFT_APP_INFO_TEXT_H

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace weft {

/// The result of info_json() for a terminal of 80 columns: a label, then one entry a line. Long
/// lists and names are shortened, and characters that would move the cursor are replaced.
[[nodiscard]] std::string info_text(const nlohmann::json& info);

}  // namespace weft

#endif
