// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/message_socket.h"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace weft {
namespace {

/// Number of bytes of a message, which is sent before it.
using Length = std::uint64_t;

bool send_fully(int socket, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        // A broken connection must be reported here and not raise SIGPIPE, which ends the program.
        const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
    return true;
}

bool receive_fully(int socket, std::span<std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t got = ::recv(socket, bytes.data(), bytes.size(), 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(got));
    }
    return true;
}

}  // namespace

bool send_message(int socket, std::span<const std::byte> message) {
    if (message.size() > max_message_bytes) return false;
    const std::array<Length, 1> length{message.size()};
    return send_fully(socket, std::as_bytes(std::span(length))) && send_fully(socket, message);
}

std::optional<std::vector<std::byte>> receive_message(int socket) {
    std::array<Length, 1> length{};
    if (!receive_fully(socket, std::as_writable_bytes(std::span(length)))) return {};
    if (length[0] > max_message_bytes) return {};
    std::vector<std::byte> message(static_cast<std::size_t>(length[0]));
    if (!receive_fully(socket, message)) return {};
    return message;
}

}  // namespace weft
