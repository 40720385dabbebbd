// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_CANCELLABLE_EXECUTOR_H
#define WEFT_DEVICE_CANCELLABLE_EXECUTOR_H

#include <atomic>
#include <memory>

#include "device/executor.h"

namespace weft {

/// Passes everything on to another executor, and lets another thread cancel what runs on it: no
/// further launch begins then, whoever asks for it, but for those that are `whole`.
class CancellableExecutor : public Executor {
  public:
    explicit CancellableExecutor(std::unique_ptr<Executor> inner) : inner_(std::move(inner)) {}

    /// Asks for an end. From any thread, at any time.
    void request_cancel() noexcept { requested_ = true; }

    /// While it lives the executor heeds requests, also one that came before. Outside nothing is
    /// cancelled.
    class Scope {
      public:
        explicit Scope(CancellableExecutor& executor) : executor_(executor) {
            executor_.heeding_ = true;
        }
        ~Scope() { executor_.heeding_ = false; }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        CancellableExecutor& executor_;
    };

    /// Takes the request back; returns whether there was one.
    bool take_request() noexcept { return requested_.exchange(false); }

    [[nodiscard]] bool cancelled() const override { return heeding_ && requested_; }
    bool run(const Launch& launch, const std::function<bool(double)>& keep_going) override;

    [[nodiscard]] const DeviceInfo& device() const override { return inner_->device(); }
    [[nodiscard]] std::uint32_t lanes() const override { return inner_->lanes(); }
    [[nodiscard]] std::unique_ptr<Buffer> allocate(std::size_t bytes,
                                                   std::string_view what) override {
        return inner_->allocate(bytes, what);
    }
    void with_mapped(Buffer& buffer, Access access,
                     const std::function<void(std::span<std::byte>)>& use) override {
        inner_->with_mapped(buffer, access, use);
    }
    [[nodiscard]] std::unique_ptr<TracedScene> make_scene(const TracedGeometry& geometry) override {
        return inner_->make_scene(geometry);
    }
    void update_scene(TracedScene& scene, const TracedGeometry& geometry) override {
        inner_->update_scene(scene, geometry);
    }
    void compile(std::span<const KernelUse> uses) override { inner_->compile(uses); }
    void build(std::span<const KernelId> kernels, std::uint32_t features) override {
        inner_->build(kernels, features);
    }
    double take_milliseconds() override { return inner_->take_milliseconds(); }
    [[nodiscard]] const std::vector<KernelBuild>& builds() const override {
        return inner_->builds();
    }
    [[nodiscard]] const BvhStats* bvh() const override { return inner_->bvh(); }
    [[nodiscard]] double scene_ms() const override { return inner_->scene_ms(); }
    [[nodiscard]] std::size_t allocated_bytes() const override { return inner_->allocated_bytes(); }

  private:
    std::unique_ptr<Executor> inner_;
    std::atomic<bool> requested_{false};
    bool heeding_ = false;  ///< of the thread that runs launches
};

}  // namespace weft

#endif
