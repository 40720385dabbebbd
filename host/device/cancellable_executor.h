// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_CANCELLABLE_EXECUTOR_H
#define WEFT_DEVICE_CANCELLABLE_EXECUTOR_H

#include <atomic>
#include <memory>

#include "device/forwarding_executor.h"

namespace weft {

/// Passes everything on to another executor, and lets another thread cancel what runs on it: then
/// no further launch begins, except those that are `whole`.
class CancellableExecutor : public ForwardingExecutor {
  public:
    explicit CancellableExecutor(std::unique_ptr<Executor> inner)
        : ForwardingExecutor(*inner), owned_(std::move(inner)) {}

    /// Requests that launches end. May be called from any thread, at any time.
    void request_cancel() noexcept { requested_ = true; }

    /// While it lives the executor heeds requests, even one that came before. Outside nothing is
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

    /// Withdraws the request; returns whether there was one.
    bool take_request() noexcept { return requested_.exchange(false); }

    [[nodiscard]] bool cancelled() const override { return heeding_ && requested_; }
    bool run(const Launch& launch, const std::function<bool(double)>& keep_going) override;

  private:
    std::unique_ptr<Executor> owned_;
    std::atomic<bool> requested_{false};
    bool heeding_ = false;  ///< used only by the thread that runs launches
};

}  // namespace weft

#endif
