// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_FORWARDING_EXECUTOR_H
#define WEFT_DEVICE_FORWARDING_EXECUTOR_H

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "device/executor.h"

namespace weft {

/// Passes everything on to another executor: the base class of executors that change or observe
/// some of it.
class ForwardingExecutor : public Executor {
  public:
    /// `inner` must outlive it.
    explicit ForwardingExecutor(Executor& inner) : inner_(inner) {}

    [[nodiscard]] const DeviceInfo& device() const override { return inner_.device(); }
    [[nodiscard]] std::uint32_t lanes() const override { return inner_.lanes(); }
    [[nodiscard]] std::unique_ptr<Buffer> allocate(std::size_t bytes,
                                                   std::string_view what) override {
        return inner_.allocate(bytes, what);
    }
    void with_mapped(Buffer& buffer, Access access,
                     const std::function<void(std::span<std::byte>)>& use) override {
        inner_.with_mapped(buffer, access, use);
    }
    [[nodiscard]] std::unique_ptr<TracedScene> make_scene(const TracedGeometry& geometry) override {
        return inner_.make_scene(geometry);
    }
    void update_scene(TracedScene& scene, const TracedGeometry& geometry) override {
        inner_.update_scene(scene, geometry);
    }
    void compile(std::span<const KernelUse> uses) override { inner_.compile(uses); }
    void watch_builds(const std::function<void(const BuildProgress&)>& watch) override {
        inner_.watch_builds(watch);
    }
    void build(std::span<const KernelId> kernels, std::uint32_t features) override {
        inner_.build(kernels, features);
    }
    bool run(const Launch& launch, const std::function<bool(double done)>& keep_going) override {
        return inner_.run(launch, keep_going);
    }
    [[nodiscard]] bool cancelled() const override { return inner_.cancelled(); }
    double take_milliseconds() override { return inner_.take_milliseconds(); }
    [[nodiscard]] const std::vector<KernelBuild>& builds() const override {
        return inner_.builds();
    }
    [[nodiscard]] const BvhStats* bvh() const override { return inner_.bvh(); }
    [[nodiscard]] double scene_ms() const override { return inner_.scene_ms(); }
    [[nodiscard]] std::size_t allocated_bytes() const override { return inner_.allocated_bytes(); }

  protected:
    [[nodiscard]] Executor& inner() const noexcept { return inner_; }

  private:
    Executor& inner_;
};

}  // namespace weft

#endif
