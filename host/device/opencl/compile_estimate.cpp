// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/compile_estimate.h"

#include <algorithm>

namespace weft {

CompileEstimate::CompileEstimate(const std::vector<double>& expected_ms, std::uint32_t workers) {
    std::vector<double> free_at(std::max(1U, workers), 0.0);
    for (const double ms : expected_ms) {
        const auto next = std::min_element(free_at.begin(), free_at.end());
        *next += ms;
        ends_ms_.push_back(*next);
    }
    std::sort(ends_ms_.begin(), ends_ms_.end());
}

double CompileEstimate::left_ms(std::size_t done, double elapsed_ms) {
    if (done >= ends_ms_.size()) return 0.0;
    if (done > done_) {
        slowness_ = elapsed_ms / ends_ms_[done - 1];
        done_ = done;
    }
    // The next one is late already.
    slowness_ = std::max(slowness_, elapsed_ms / ends_ms_[done]);
    return std::max(0.0, slowness_ * ends_ms_.back() - elapsed_ms);
}

}  // namespace weft
