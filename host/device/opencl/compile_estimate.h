// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_COMPILE_ESTIMATE_H
#define WEFT_DEVICE_OPENCL_COMPILE_ESTIMATE_H

#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft {

/// Estimates when workers that take programs one after the other will have compiled them all. It
/// compares when programs were done with when they should have been, so that a machine that is
/// faster or slower than expected is noticed at the first of them.
class CompileEstimate {
  public:
    /// `expected_ms`: what each program is expected to take, in the order in which they are taken,
    /// above 0; `workers` at once, 1 and up.
    CompileEstimate(const std::vector<double>& expected_ms, std::uint32_t workers);

    /// Milliseconds until the last program is done, when so many are and so much time has gone.
    /// Neither may fall from call to call.
    [[nodiscard]] double left_ms(std::size_t done, double elapsed_ms);

  private:
    std::vector<double> ends_ms_;  ///< when a program is expected to be done, ascending
    std::size_t done_ = 0;
    double slowness_ = 1.0;  ///< time taken over time expected
};

}  // namespace weft

#endif
