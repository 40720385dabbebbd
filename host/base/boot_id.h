// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_BOOT_ID_H
#define WEFT_BASE_BOOT_ID_H

#include <string>

namespace weft {

/// A name for the running system, until the machine is started again, by which machines that share
/// a folder tell what is theirs. Containers on a machine share it. The machine's name in its
/// network where the system does not say.
[[nodiscard]] std::string boot_id();

}  // namespace weft

#endif
