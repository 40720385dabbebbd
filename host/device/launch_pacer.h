// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_LAUNCH_PACER_H
#define WEFT_DEVICE_LAUNCH_PACER_H

#include <cstdint>
#include <map>
#include <utility>

#include "device/executor.h"

namespace weft {

/// Chooses how many work-items one launch has, by the times of those before: about as many as run
/// in launch_ms, so that a run that is cancelled ends soon. Results do not depend on it.
class LaunchPacer {
  public:
    static constexpr double launch_ms = 6.0;

    /// Launches have at least `least` work-items, which keep the device busy.
    explicit LaunchPacer(std::uint32_t least) : least_(least > 0 ? least : 1) {}

    /// Work-items of the next launch of a kernel, from 1 to `most`. A kernel launched with another
    /// `most` than before is another workload, whose cost is not known.
    [[nodiscard]] std::uint32_t items(KernelId kernel, std::uint32_t most);

    /// Tells how long a launch of `items` work-items took.
    void took(KernelId kernel, std::uint32_t most, std::uint32_t items, double ms);

  private:
    struct Pace {
        double ms_per_item = 0.0;   ///< 0: not known
        std::uint32_t largest = 0;  ///< items of the largest launch that was measured
    };

    std::uint32_t least_;
    std::map<std::pair<KernelId, std::uint32_t>, Pace> paces_;
};

}  // namespace weft

#endif
