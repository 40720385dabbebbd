// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/null_device.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace weft {

bool lead_to_null_device(std::initializer_list<int> descriptors) noexcept {
    const int opened = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    if (opened < 0) return false;
    // A descriptor that was closed may be the one that opening gave; it must outlive this call.
    const bool is_wanted =
        std::find(descriptors.begin(), descriptors.end(), opened) != descriptors.end();
    bool all = true;
    for (const int descriptor : descriptors)
        if (descriptor == opened)
            all = ::fcntl(opened, F_SETFD, 0) == 0 && all;  // inherited, as the others are
        else
            all = ::dup2(opened, descriptor) >= 0 && all;
    if (!is_wanted) ::close(opened);
    return all;
}

}  // namespace weft
