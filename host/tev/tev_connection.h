// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TEV_TEV_CONNECTION_H
#define WEFT_TEV_TEV_CONNECTION_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace weft {

/// Where a viewer listens.
struct TevAddress {
    std::string host = "127.0.0.1";  ///< a name or an address
    std::uint16_t port = 14158;      ///< tev's own
};

/// A TCP connection, over which bytes go one way. It waits for the other side no longer than
/// `patience_ms` at a time.
class TevConnection {
  public:
    static constexpr int patience_ms = 2000;

    TevConnection() = default;
    ~TevConnection() { close(); }
    TevConnection(const TevConnection&) = delete;
    TevConnection& operator=(const TevConnection&) = delete;

    /// Connects, unless it is connected. Returns what is wrong; empty where nothing is.
    [[nodiscard]] std::string open(const TevAddress& address);
    /// Sends all bytes. Returns what is wrong, after which it is closed; empty where nothing is.
    [[nodiscard]] std::string send(std::span<const std::byte> bytes);
    /// Whether the other side has not closed it so far.
    [[nodiscard]] bool is_open() const { return socket_ >= 0; }
    /// Closes it where the other side has done so.
    void notice_end();
    void close();

  private:
    int socket_ = -1;
};

}  // namespace weft

#endif
