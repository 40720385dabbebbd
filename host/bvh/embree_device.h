// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_EMBREE_DEVICE_H
#define WEFT_BVH_EMBREE_DEVICE_H

#include <mutex>
#include <string>

#include "bvh/embree.h"

namespace weft {

/// Embree's device, which all of its objects belong to, and the first error that it reports from
/// whichever thread. The cache for subdivision surfaces, which Weft has none of, is left out: where
/// there is no memory for it, Embree fails with a lock held and waits for itself ever after.
class EmbreeDevice {
  public:
    /// `threads` is 0 for all. Throws Error (exit code 3 or 4).
    explicit EmbreeDevice(int threads = 0);
    ~EmbreeDevice();
    EmbreeDevice(const EmbreeDevice&) = delete;
    EmbreeDevice& operator=(const EmbreeDevice&) = delete;

    [[nodiscard]] RTCDevice handle() const noexcept { return device_; }
    /// Records an error, as Embree does. Threads may call it at once.
    void add_error(RTCError code, const char* text) noexcept;
    /// Throws the first error, if there is any: exit code 4 when memory ran out, else 3. `action`
    /// completes "Embree failed while ...".
    void throw_if_failed(const char* action) const;

  private:
    RTCDevice device_ = nullptr;
    mutable std::mutex mutex_;
    RTCError code_ = RTC_ERROR_NONE;
    std::string text_;
};

}  // namespace weft

#endif
