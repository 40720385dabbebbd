// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tev/tev_connection.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

namespace weft {
namespace {

std::string words_of(int error) {
    return std::strerror(error);
}

/// Waits until bytes can be sent; 0, or the error.
int wait_for_room(int socket) {
    pollfd wanted{socket, POLLOUT, 0};
    const int ready = ::poll(&wanted, 1, TevConnection::patience_ms);
    if (ready < 0) return errno;
    return ready == 0 ? ETIMEDOUT : 0;
}

/// Connects a socket that does not block; 0, or the error.
int connect(int socket, const addrinfo& to) {
    if (::connect(socket, to.ai_addr, to.ai_addrlen) == 0) return 0;
    if (errno != EINPROGRESS) return errno;
    if (const int error = wait_for_room(socket)) return error;
    int error = 0;
    socklen_t size = sizeof(error);
    return ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

}  // namespace

std::string TevConnection::open(const TevAddress& address) {
    if (is_open()) return {};
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int failed =
        ::getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &found);
    if (failed != 0) return ::gai_strerror(failed);
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> all(found, ::freeaddrinfo);
    int error = EADDRNOTAVAIL;
    for (const addrinfo* to = all.get(); to != nullptr; to = to->ai_next) {
        const int socket = ::socket(to->ai_family, to->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC,
                                    to->ai_protocol);
        if (socket < 0) {
            error = errno;
            continue;
        }
        error = connect(socket, *to);
        if (error == 0) {
            socket_ = socket;
            return {};
        }
        ::close(socket);
    }
    return words_of(error);
}

std::string TevConnection::send(std::span<const std::byte> bytes) {
    if (!is_open()) return words_of(ENOTCONN);
    while (!bytes.empty()) {
        const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent > 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(sent));
            continue;
        }
        int error = errno;
        if (error == EAGAIN || error == EWOULDBLOCK) error = wait_for_room(socket_);
        if (error == 0 || error == EINTR) continue;
        close();
        return words_of(error);
    }
    return {};
}

void TevConnection::notice_end() {
    if (!is_open()) return;
    // tev sends nothing, so that anything but silence is the end.
    std::byte one{};
    const ssize_t got = ::recv(socket_, &one, 1, MSG_PEEK | MSG_DONTWAIT);
    const bool silent = got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
    if (!silent && got <= 0) close();
}

void TevConnection::close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
}

}  // namespace weft
