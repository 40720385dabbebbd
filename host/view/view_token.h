// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_TOKEN_H
#define WEFT_VIEW_VIEW_TOKEN_H

#include <string>
#include <string_view>

namespace weft {

/// 128 random bits as 32 hexadecimal digits, from the system's source of secrets. Whoever has them
/// may use the view: others on the same machine reach its port, too. Throws Error (exit code 5).
[[nodiscard]] std::string make_view_token();

/// Whether the texts are equal, in a time that does not tell where they differ.
[[nodiscard]] bool is_same_token(std::string_view token, std::string_view given) noexcept;

}  // namespace weft

#endif
