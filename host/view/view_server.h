// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_SERVER_H
#define WEFT_VIEW_VIEW_SERVER_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "view/view_frame.h"
#include "view/view_message.h"

namespace weft {

/// What a view does with what its pages say. Called by the thread of the server, one call at a
/// time.
class ViewEvents {
  public:
    virtual ~ViewEvents() = default;

    /// The first text that a page gets, JSON.
    [[nodiscard]] virtual std::string hello() = 0;
    /// Takes what a page asks for: anything but keys and acks. Returns the version of the view that
    /// will show it, see ViewFrame::version; 0 where nothing changes. Throws Error, whose line the
    /// page gets.
    [[nodiscard]] virtual std::uint64_t take(std::uint32_t page, const ViewMessage& message) = 0;
};

/// Where a view is served.
struct ViewAddress {
    std::optional<std::uint16_t> port;              ///< of 127.0.0.1; empty: a free one
    std::optional<std::filesystem::path> socket{};  ///< instead: a Unix socket
};

/// Serves the page of a view and talks with those who have opened it, on a thread of its own. Only
/// this machine reaches it, and only who knows the key is answered.
class ViewServer {
  public:
    static constexpr std::size_t most_pages = 4;

    /// Listens. `events` must outlive it. Throws Error (exit code 5) where the address cannot be
    /// had.
    ViewServer(const ViewAddress& address, std::string token, ViewEvents& events);
    /// Tells all pages that the view has ended.
    ~ViewServer();
    ViewServer(const ViewServer&) = delete;
    ViewServer& operator=(const ViewServer&) = delete;

    /// The port that it listens on; 0 with a Unix socket.
    [[nodiscard]] std::uint16_t port() const;
    /// Pages that have shown the key.
    [[nodiscard]] std::size_t pages() const;

    /// Sends JSON to one page, if it is still there. From any thread, as are the following.
    void send(std::uint32_t page, std::string text);
    /// Sends JSON to all pages.
    void send(std::string text);
    /// Sends all pages a `status`, a JSON object that has members, of a version of the view: pages
    /// know it by their own number, `state`.
    void send_status(const std::string& status, std::uint64_t version);
    /// Shows all pages a frame. One that has two frames to draw yet gets the newest once it has
    /// drawn one of them; of each pane, where there are two.
    void show(ViewFrame frame);
    /// Shows pages that come later no frame of that pane before there is another.
    void forget(std::uint32_t pane);

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft

#endif
