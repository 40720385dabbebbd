// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_PROCESSOR_WAIT_H
#define WEFT_BASE_PROCESSOR_WAIT_H

#include <sys/types.h>

namespace weft {

/// Milliseconds for which a process could have run and had no processor, since others did: of the
/// thread that waited longest. 0 where the system does not say.
[[nodiscard]] double processor_wait_ms(pid_t process) noexcept;

}  // namespace weft

#endif
