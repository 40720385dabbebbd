// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/cancellable_executor.h"

namespace weft {

bool CancellableExecutor::run(const Launch& launch, const std::function<bool(double)>& keep_going) {
    if (launch.options.whole) return inner().run(launch, keep_going);
    if (cancelled()) return false;
    return inner().run(launch, [&](double done) {
        const bool wanted = !keep_going || keep_going(done);
        return wanted && !cancelled();
    });
}

}  // namespace weft
