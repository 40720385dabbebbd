// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_DEVICE_BUFFER_H
#define WEFT_DEVICE_DEVICE_BUFFER_H

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "device/executor.h"
#include "shared/shared_types.h"

namespace weft {

/// The kinds of buffers, by what they hold: one type for each entry of kernels/core/buffers.def,
/// whose Element is one element of the buffer.
namespace kinds {
using namespace shared;
#define WEFT_BUFFER(kind, element) \
    struct kind {                  \
        using Element = element;   \
    };
#include "kernels/core/buffers.def"
#undef WEFT_BUFFER
}  // namespace kinds

/// Owns device memory of one kind, or none.
template <class Kind>
class DeviceBuffer {
  public:
    using Element = typename Kind::Element;

    DeviceBuffer() = default;
    explicit DeviceBuffer(std::unique_ptr<Buffer> memory) : memory_(std::move(memory)) {}

    [[nodiscard]] Buffer* get() const noexcept { return memory_.get(); }
    [[nodiscard]] Buffer& operator*() const noexcept { return *memory_; }
    [[nodiscard]] Buffer* operator->() const noexcept { return memory_.get(); }
    [[nodiscard]] explicit operator bool() const noexcept { return memory_ != nullptr; }

  private:
    std::unique_ptr<Buffer> memory_;
};

/// Refers to a DeviceBuffer that another object owns, or to none.
template <class Kind>
class BufferRef {
  public:
    using Element = typename Kind::Element;

    BufferRef() = default;
    BufferRef(const DeviceBuffer<Kind>& buffer) : memory_(buffer.get()) {}

    [[nodiscard]] Buffer* get() const noexcept { return memory_; }
    [[nodiscard]] Buffer& operator*() const noexcept { return *memory_; }
    [[nodiscard]] Buffer* operator->() const noexcept { return memory_; }
    [[nodiscard]] explicit operator bool() const noexcept { return memory_ != nullptr; }
    [[nodiscard]] bool operator==(const BufferRef&) const = default;

  private:
    Buffer* memory_ = nullptr;
};

/// Allocates a buffer of `count` elements; `what` names it in errors.
template <class Kind>
[[nodiscard]] DeviceBuffer<Kind> allocate(Executor& executor, std::size_t count,
                                          std::string_view what) {
    return DeviceBuffer<Kind>(executor.allocate(count * sizeof(typename Kind::Element), what));
}

/// Allocates a buffer that holds `values`, or 16 bytes where there are none.
template <class Kind>
[[nodiscard]] DeviceBuffer<Kind> upload(
    Executor& executor, std::type_identity_t<std::span<const typename Kind::Element>> values,
    std::string_view what) {
    return DeviceBuffer<Kind>(upload_bytes(executor, std::as_bytes(values), what));
}

/// Writes `values`, which fit in the buffer; there may be none where there are no values.
template <class Kind>
void write_buffer(Executor& executor, BufferRef<Kind> buffer,
                  std::type_identity_t<std::span<const typename Kind::Element>> values) {
    if (values.empty()) return;
    write_buffer<typename Kind::Element>(executor, *buffer, values);
}
template <class Kind>
void write_buffer(Executor& executor, const DeviceBuffer<Kind>& buffer,
                  std::type_identity_t<std::span<const typename Kind::Element>> values) {
    write_buffer(executor, BufferRef<Kind>(buffer), values);
}

/// Reads the first `count` elements of a buffer.
template <class Kind>
[[nodiscard]] std::vector<typename Kind::Element> read_buffer(Executor& executor,
                                                              const DeviceBuffer<Kind>& buffer,
                                                              std::size_t count) {
    return read_buffer<typename Kind::Element>(executor, *buffer, count);
}
template <class Kind>
[[nodiscard]] std::vector<typename Kind::Element> read_buffer(Executor& executor,
                                                              BufferRef<Kind> buffer,
                                                              std::size_t count) {
    return read_buffer<typename Kind::Element>(executor, *buffer, count);
}

}  // namespace weft

#endif
