// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_HOST_NAME_H
#define WEFT_BASE_HOST_NAME_H

#include <string>

namespace weft {

/// This machine's name in its network, by which machines that share a folder tell what is theirs;
/// empty where it has none.
[[nodiscard]] std::string host_name();

}  // namespace weft

#endif
