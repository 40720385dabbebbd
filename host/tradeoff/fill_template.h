// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_FILL_TEMPLATE_H
#define WEFT_TRADEOFF_FILL_TEMPLATE_H

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace weft {

/// A Mustache template for HTML, filled with an object of texts, booleans, lists and objects. An
/// empty text counts as false. Texts go through escape_markup, unless they stand in three braces,
/// and are never taken for templates. Throws std::invalid_argument for a mistake in the template,
/// which a name without a value and a partial are, too, and for values of other types.
[[nodiscard]] std::string fill_template(std::string_view text, const nlohmann::json& values);

}  // namespace weft

#endif
