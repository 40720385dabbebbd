// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_SHELL_WORD_H
#define WEFT_BASE_SHELL_WORD_H

#include <string>
#include <string_view>

namespace weft {

/// A word of a command line, in quotes where a POSIX shell would split or change it.
[[nodiscard]] std::string shell_word(std::string_view word);

/// The same for the name of a file: one that begins with `-` would be taken for an option.
[[nodiscard]] std::string shell_file(std::string_view file);

}  // namespace weft

#endif
