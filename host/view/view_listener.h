// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_LISTENER_H
#define WEFT_VIEW_VIEW_LISTENER_H

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include "view/view_connection.h"

namespace weft {

/// Takes connections as they come: of a port, or of a Unix socket.
template <typename Protocol>
class ViewListener {
  public:
    ViewListener(boost::asio::io_context& context, const typename Protocol::endpoint& endpoint,
                 ViewPages& pages)
        : acceptor_(context), retry_(context), pages_(pages) {
        acceptor_.open(endpoint.protocol());
        if constexpr (std::is_same_v<Protocol, boost::asio::ip::tcp>)
            acceptor_.set_option(boost::asio::socket_base::reuse_address(true));
        acceptor_.bind(endpoint);
    }

    void listen() {
        acceptor_.listen();
        accept();
    }
    [[nodiscard]] typename Protocol::endpoint endpoint() const {
        return acceptor_.local_endpoint();
    }
    void close() {
        boost::beast::error_code ignored;
        acceptor_.close(ignored);
        retry_.cancel();
    }

  private:
    static constexpr std::size_t most_connections = 32;  // those without a key among them

    void accept() {
        acceptor_.async_accept(
            [this](boost::beast::error_code error, typename Protocol::socket socket) {
                if (error == boost::asio::error::operation_aborted || !acceptor_.is_open()) return;
                if (error) return accept_later();
                if constexpr (std::is_same_v<Protocol, boost::asio::ip::tcp>) {
                    boost::beast::error_code ignored;
                    socket.set_option(boost::asio::ip::tcp::no_delay(true), ignored);
                }
                if (pages_.connections.size() < most_connections) {
                    auto connection = std::make_shared<ViewConnection>(
                        ViewConnection::Socket(std::move(socket)), pages_);
                    pages_.connections.insert(connection);
                    connection->start();
                }
                accept();
            });
    }

    /// Goes on in a while: there may be no descriptors left just now.
    void accept_later() {
        retry_.expires_after(std::chrono::milliseconds(100));
        retry_.async_wait([this](boost::beast::error_code error) {
            if (!error) accept();
        });
    }

    typename Protocol::acceptor acceptor_;
    boost::asio::steady_timer retry_;
    ViewPages& pages_;
};

}  // namespace weft

#endif
