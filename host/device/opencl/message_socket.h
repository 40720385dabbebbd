// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_MESSAGE_SOCKET_H
#define WEFT_DEVICE_OPENCL_MESSAGE_SOCKET_H

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace weft {

/// Sends one message of at most `max_message_bytes`; returns whether the other process took it.
[[nodiscard]] bool send_message(int socket, std::span<const std::byte> message);

/// Waits for the next message; returns nothing where the other process has ended, or sends what is
/// no message.
[[nodiscard]] std::optional<std::vector<std::byte>> receive_message(int socket);

inline constexpr std::size_t max_message_bytes = std::size_t{256} << 20;

}  // namespace weft

#endif
