// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_COUNTING_EXECUTOR_H
#define WEFT_TESTS_COUNTING_EXECUTOR_H

#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "device/executor.h"

namespace weft::test {

/// An executor that writes down what it is asked to do.
class CountingExecutor : public Executor {
  public:
    /// Kernel, first work-item, work-items.
    using Run = std::tuple<std::string, std::uint32_t, std::uint32_t>;
    /// What for, bytes.
    using Allocation = std::pair<std::string, std::size_t>;

    explicit CountingExecutor(std::unique_ptr<Executor> inner) : inner_(std::move(inner)) {}

    [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
    [[nodiscard]] const std::vector<Allocation>& allocations() const { return allocations_; }
    [[nodiscard]] const std::vector<std::string>& kernels() const { return kernels_; }
    /// How many scenes were made.
    [[nodiscard]] std::size_t scenes() const { return scenes_; }
    [[nodiscard]] const std::vector<std::uint32_t>& features() const { return features_; }

    [[nodiscard]] const DeviceInfo& device() const override { return inner_->device(); }
    [[nodiscard]] std::uint32_t lanes() const override { return inner_->lanes(); }
    [[nodiscard]] std::unique_ptr<Buffer> allocate(std::size_t bytes,
                                                   std::string_view what) override {
        allocations_.emplace_back(what, bytes);
        return inner_->allocate(bytes, what);
    }
    void with_mapped(Buffer& buffer, Access access,
                     const std::function<void(std::span<std::byte>)>& use) override {
        inner_->with_mapped(buffer, access, use);
    }
    [[nodiscard]] std::unique_ptr<TracedScene> make_scene(const TracedGeometry& geometry) override {
        ++scenes_;
        return inner_->make_scene(geometry);
    }
    void update_scene(TracedScene& scene, const TracedGeometry& geometry) override {
        inner_->update_scene(scene, geometry);
    }
    void build(std::span<const KernelId> kernels, std::uint32_t features) override {
        for (const KernelId kernel : kernels) kernels_.emplace_back(kernel_name(kernel));
        features_.push_back(features);
        inner_->build(kernels, features);
    }
    bool run(const Launch& launch, const std::function<bool(double done)>& keep_going) override {
        runs_.emplace_back(kernel_name(launch.kernel), launch.options.first_item, launch.items);
        return inner_->run(launch, keep_going);
    }
    double take_milliseconds() override { return inner_->take_milliseconds(); }
    [[nodiscard]] const std::vector<KernelBuild>& builds() const override {
        return inner_->builds();
    }
    [[nodiscard]] double scene_ms() const override { return inner_->scene_ms(); }
    [[nodiscard]] std::size_t allocated_bytes() const override { return inner_->allocated_bytes(); }

  private:
    std::unique_ptr<Executor> inner_;
    std::size_t scenes_ = 0;
    std::vector<Run> runs_;
    std::vector<Allocation> allocations_;
    std::vector<std::string> kernels_;
    std::vector<std::uint32_t> features_;
};

}  // namespace weft::test

#endif
