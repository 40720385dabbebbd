// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_MESSAGE_SOCKET_H
#define WEFT_DEVICE_OPENCL_MESSAGE_SOCKET_H

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace weft {

/// Sends one message; whether the other process took it. None has more than `max_message_bytes`.
[[nodiscard]] bool send_message(int socket, std::span<const std::byte> message);

/// Waits for the next message; nothing where the other process has ended, or says what is no
/// message.
[[nodiscard]] std::optional<std::vector<std::byte>> receive_message(int socket);

inline constexpr std::size_t max_message_bytes = std::size_t{256} << 20;

}  // namespace weft

#endif
