// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_PROCESS_AGE_H
#define WEFT_BASE_PROCESS_AGE_H

namespace weft {

/// Milliseconds since this process was started, loading of its libraries included, to about half a
/// tick of the system's clock (5 ms). Where the system does not say, the processor time used.
[[nodiscard]] double process_age_ms();

}  // namespace weft

#endif
