// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_COUNTING_EXECUTOR_H
#define WEFT_TESTS_TESTING_COUNTING_EXECUTOR_H

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "device/forwarding_executor.h"

namespace weft::test {

/// Runs a launch in quarters and asks after each whether to go on. Backends size their launches by
/// time, so that what ends after a number of theirs would end elsewhere in each run.
inline bool run_in_quarters(Executor& executor, const Launch& launch,
                            const std::function<bool(double done)>& keep_going) {
    constexpr std::uint32_t parts = 4;
    for (std::uint32_t part = 0; part < parts; ++part) {
        const std::uint32_t first = part * launch.items / parts;
        const std::uint32_t end = (part + 1) * launch.items / parts;
        if (first == end) continue;
        Launch quarter = launch;
        quarter.items = end - first;
        quarter.options.first_item += first;
        (void)executor.run(quarter, {});
        if (keep_going && !keep_going(static_cast<double>(end) / launch.items)) return false;
    }
    return true;
}

/// An executor that writes down what it is asked to do.
class CountingExecutor : public ForwardingExecutor {
  public:
    /// Kernel, first work-item, work-items.
    using Run = std::tuple<std::string, std::uint32_t, std::uint32_t>;
    /// What for, bytes.
    using Allocation = std::pair<std::string, std::size_t>;

    explicit CountingExecutor(std::unique_ptr<Executor> inner)
        : ForwardingExecutor(*inner), owned_(std::move(inner)) {}

    [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
    [[nodiscard]] const std::vector<Allocation>& allocations() const { return allocations_; }
    [[nodiscard]] const std::vector<std::string>& kernels() const { return kernels_; }
    /// How many scenes were made.
    [[nodiscard]] std::size_t scenes() const { return scenes_; }
    [[nodiscard]] const std::vector<std::uint32_t>& features() const { return features_; }

    [[nodiscard]] std::unique_ptr<Buffer> allocate(std::size_t bytes,
                                                   std::string_view what) override {
        allocations_.emplace_back(what, bytes);
        return inner().allocate(bytes, what);
    }
    [[nodiscard]] std::unique_ptr<TracedScene> make_scene(const TracedGeometry& geometry) override {
        ++scenes_;
        return inner().make_scene(geometry);
    }
    void build(std::span<const KernelId> kernels, std::uint32_t features) override {
        for (const KernelId kernel : kernels) kernels_.emplace_back(kernel_name(kernel));
        features_.push_back(features);
        inner().build(kernels, features);
    }
    bool run(const Launch& launch, const std::function<bool(double done)>& keep_going) override {
        runs_.emplace_back(kernel_name(launch.kernel), launch.options.first_item, launch.items);
        return inner().run(launch, keep_going);
    }

  private:
    std::unique_ptr<Executor> owned_;
    std::size_t scenes_ = 0;
    std::vector<Run> runs_;
    std::vector<Allocation> allocations_;
    std::vector<std::string> kernels_;
    std::vector<std::uint32_t> features_;
};

}  // namespace weft::test

#endif
