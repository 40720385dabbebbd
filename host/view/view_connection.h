// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_CONNECTION_H
#define WEFT_VIEW_VIEW_CONNECTION_H

#include <array>
#include <atomic>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "view/view_frame.h"
#include "view/view_server.h"

// Two files alone include this, since Boost.Beast takes long to compile.
namespace weft {

class ViewConnection;

/// What the connections of a server share. Used by the server's thread alone, but for `count`.
struct ViewPages {
    std::string token;
    ViewEvents& events;
    std::set<std::shared_ptr<ViewConnection>> connections{};
    std::map<std::uint32_t, ViewConnection*> shown{};  ///< those that have shown the key
    std::atomic<std::size_t> count = 0;                ///< of these
    std::uint32_t next_page = 1;
    std::array<std::optional<ViewFrame>, view_panes> frames{};  ///< the last that were shown
    std::uint64_t next_number = 1;                              ///< of a frame
    std::function<void()> when_empty{};  ///< called once no connection is left; may be empty
};

/// One connection: a request for a file, or the socket of a page.
class ViewConnection : public std::enable_shared_from_this<ViewConnection> {
  public:
    using Socket = boost::asio::generic::stream_protocol::socket;

    ViewConnection(Socket socket, ViewPages& pages) : stream_(std::move(socket)), pages_(pages) {}

    /// Reads a request and answers it.
    void start();

    /// Sends JSON to the page.
    void send_text(std::string text);

    /// Shows the page a frame once it has drawn others.
    void show(const ViewFrame& frame);

    /// The page's number of what a version of the view shows.
    [[nodiscard]] std::uint32_t state_at(std::uint64_t version) const;

    /// Says farewell to a page, and closes what is none.
    void end(const std::string& reason);

    /// Closes the connection at once.
    void drop();

  private:
    using Stream = boost::beast::basic_stream<boost::asio::generic::stream_protocol>;

    /// What goes on once something is written.
    [[nodiscard]] auto written();

    [[nodiscard]] bool is_page() const { return page_ != 0; }
    [[nodiscard]] Stream& lowest() {
        return socket_ ? boost::beast::get_lowest_layer(*socket_) : stream_;
    }

    /// Forgets the connection, which goes once nothing that it waits for is left.
    void leave();

    void answer();

    void respond(boost::beast::http::status status, std::string_view text,
                 std::string_view type = "text/plain; charset=utf-8");

    void open_socket();

    void read();

    void take();

    void take_key(std::string_view text);

    void take_message(std::string_view text);

    void take_ack(const ViewAck& ack);

    /// Writes what waits, texts first, unless something is being written.
    void write_next();

    void write_text();

    /// The oldest of the frames that wait; null where none does.
    [[nodiscard]] std::optional<ViewFrame>* next_frame();

    void write_frame();

    void say_farewell();

    Stream stream_;
    ViewPages& pages_;
    boost::beast::flat_buffer buffer_;
    boost::beast::http::request_parser<boost::beast::http::empty_body> parser_;
    boost::beast::http::response<boost::beast::http::string_body> response_;
    std::optional<boost::beast::websocket::stream<Stream>> socket_;

    std::uint32_t page_ = 0;  ///< 0 before it has shown the key
    std::deque<std::string> texts_;
    std::string sent_text_;
    std::optional<std::string> farewell_;
    bool is_writing_ = false;

    std::array<std::optional<ViewFrame>, view_panes> waiting_;  ///< the newest of each pane
    ViewFrame sent_;
    std::array<std::byte, view_frame_head_bytes> head_{};
    std::uint32_t sequence_ = 0;
    std::deque<std::uint32_t> undrawn_;
    /// What the page has asked for and has not been shown: versions of the view, numbers of the
    /// page.
    std::deque<std::pair<std::uint64_t, std::uint32_t>> asked_;
    std::uint32_t state_ = 0;  ///< of the page: what the last frame showed
};

}  // namespace weft

#endif
