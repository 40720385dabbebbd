// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_KERNELS_KERNEL_METER_H
#define WEFT_BENCH_KERNELS_KERNEL_METER_H

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "device/forwarding_executor.h"
#include "pipeline/frame_renderer.h"

namespace weft::bench {

/// One call of Executor::run, or several of one kernel together.
struct KernelUse {
    KernelId kernel{};
    std::uint64_t launches = 0;  ///< that the executor cut it into
    std::uint64_t items = 0;     ///< work-items
    /// Sizes of the different buffers that it was given, without the acceleration structure: what
    /// it would move if it touched each byte of them once.
    std::uint64_t bound_bytes = 0;
    double ms = 0.0;         ///< on the device
    std::uint64_t rays = 0;  ///< see add_rays

    /// Takes over what another one of the same kernel took.
    void add(const KernelUse& other);
};

/// What went through an executor in some time.
struct Metered {
    std::vector<KernelUse> runs;      ///< in order, one for every call of Executor::run
    std::uint64_t read_bytes = 0;     ///< of buffers that the host mapped to read them
    std::uint64_t written_bytes = 0;  ///< or to write them
};

/// Passes everything on to another executor and takes down what each kernel took there.
class KernelMeter : public ForwardingExecutor {
  public:
    using ForwardingExecutor::ForwardingExecutor;

    /// Waits for what still runs; returns what went through since last asked.
    [[nodiscard]] Metered take();

    void with_mapped(Buffer& buffer, Access access,
                     const std::function<void(std::span<std::byte>)>& use) override;
    bool run(const Launch& launch, const std::function<bool(double)>& keep_going) override;
    double take_milliseconds() override;

  private:
    /// Where the caller wants the time of a run.
    struct Wanted {
        std::size_t run;
        double* milliseconds;
    };

    std::deque<KernelUse> runs_;  ///< none moves: the inner executor adds its time there
    std::vector<Wanted> wanted_;
    std::uint64_t read_bytes_ = 0;
    std::uint64_t written_bytes_ = 0;
};

/// Gives the runs of one frame the rays that its stages counted. Each run is a stage, and stages
/// are in the order of the runs with work of the host between them, so that a run belongs to the
/// next stage of the same time. Returns false where that leaves rays or runs over.
[[nodiscard]] bool add_rays(const FrameStats& frame, std::span<KernelUse> runs);

/// The runs of each kernel as one, those that took longest first.
[[nodiscard]] std::vector<KernelUse> by_kernel(std::span<const KernelUse> runs);

}  // namespace weft::bench

#endif
