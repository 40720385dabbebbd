// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_OWN_QUERIES_H
#define WEFT_BENCH_COMMON_OWN_QUERIES_H

#include <memory>
#include <string>
#include <vector>

#include "bench/common/candidate.h"
#include "bench/common/ray_sets.h"
#include "device/executor.h"

namespace weft::bench {

/// Ray queries by the kernels query_closest, query_any and query_packet.
class OwnQueries {
  public:
    /// Builds the kernels. Executor and scene must outlive this object and its candidates.
    OwnQueries(std::string name, Executor& executor, const TracedScene& scene);

    /// Candidates for one ray set, which may be gone when they run.
    [[nodiscard]] Candidate closest(const RaySet& rays) const;
    [[nodiscard]] Candidate any(const RaySet& rays) const;
    [[nodiscard]] Candidate packets(const PacketSet& packets) const;

    /// Closest hits at once.
    [[nodiscard]] std::vector<QueryHit> trace(const RaySet& rays) const;

    [[nodiscard]] const std::string& name() const noexcept { return name_; }

  private:
    std::string name_;
    Executor& executor_;
    const TracedScene& scene_;
};

/// The OpenCL device to measure: the one `wanted` names as `--device` of the program does; where
/// that is empty, the first processor. Null where there is none or Weft was built without OpenCL.
/// `threads` is 0 for all; to be called before any other use of OpenCL.
[[nodiscard]] std::unique_ptr<Executor> open_opencl(const std::string& wanted, int threads);

/// `opencl`, on a device as above, `embree` or `native`. Throws Error (exit code 3) where there is
/// no device.
[[nodiscard]] std::unique_ptr<Executor> open_backend(const std::string& backend,
                                                     const std::string& device, int threads);

}  // namespace weft::bench

#endif
