// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_server.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <thread>
#include <utility>

#include "base/error.h"
#include "view/view_connection.h"
#include "view/view_listener.h"

namespace weft {
namespace {

namespace asio = boost::asio;

}  // namespace

class ViewServer::Impl {
  public:
    Impl(const ViewAddress& address, std::string token, ViewEvents& events)
        : pages_{std::move(token), events}, address_(address), end_(context_) {
        if (address.socket)
            listen_at(*address.socket);
        else
            listen_at(address.port.value_or(0));
        thread_ = std::thread([this] { context_.run(); });
    }

    ~Impl() {
        asio::post(context_, [this] { end(); });
        thread_.join();
        if (local_) {
            std::error_code ignored;
            std::filesystem::remove(*address_.socket, ignored);
        }
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] std::size_t pages() const { return pages_.count; }

    void send(std::uint32_t page, std::string text) {
        asio::post(context_, [this, page, text = std::move(text)] {
            const auto found = pages_.shown.find(page);
            if (found != pages_.shown.end()) found->second->send_text(text);
        });
    }
    void send(std::string text) {
        asio::post(context_, [this, text = std::move(text)] {
            for (const auto& [page, connection] : pages_.shown) connection->send_text(text);
        });
    }
    void send_status(const std::string& status, std::uint64_t version) {
        asio::post(context_, [this, members = status.substr(1), version] {
            for (const auto& [page, connection] : pages_.shown)
                connection->send_text(fmt::format(R"({{"status":{{"state":{},{}}})",
                                                  connection->state_at(version), members));
        });
    }
    void forget(std::uint32_t pane) {
        asio::post(context_, [this, pane] { pages_.frames.at(pane).reset(); });
    }
    void show(ViewFrame frame) {
        asio::post(context_, [this, frame = std::move(frame)]() mutable {
            frame.number = pages_.next_number++;
            for (const auto& [page, connection] : pages_.shown) connection->show(frame);
            pages_.frames.at(frame.pane) = std::move(frame);
        });
    }

  private:
    void listen_at(std::uint16_t port) {
        const asio::ip::tcp::endpoint endpoint(asio::ip::address_v4::loopback(), port);
        try {
            tcp_.emplace(context_, endpoint, pages_);
            tcp_->listen();
            port_ = tcp_->endpoint().port();
        } catch (const boost::system::system_error& error) {
            throw Error(ExitCode::output, fmt::format("port {} of 127.0.0.1", port),
                        "cannot be served: " + error.code().message());
        }
    }

    void listen_at(const std::filesystem::path& socket) {
        const auto refuse = [&](const std::string& why) {
            return Error(ExitCode::output, socket.string(), "cannot be served: " + why);
        };
        constexpr std::size_t longest = 107;  // of the name of a Unix socket
        if (socket.string().size() > longest) throw refuse("its name has more than 107 bytes");
        try {
            local_.emplace(context_, asio::local::stream_protocol::endpoint(socket.string()),
                           pages_);
            // Nobody can connect before it listens.
            if (::chmod(socket.c_str(), S_IRUSR | S_IWUSR) != 0)
                throw refuse("it cannot be made private");
            local_->listen();
        } catch (const boost::system::system_error& error) {
            throw refuse(error.code().message());
        }
    }

    /// Says farewell to all, and ends a little later, whoever has not answered.
    void end() {
        if (tcp_) tcp_->close();
        if (local_) local_->close();
        pages_.when_empty = [this] { context_.stop(); };
        if (pages_.connections.empty()) return context_.stop();
        // Each leaves while they are visited.
        const auto connections = pages_.connections;
        for (const auto& connection : connections) connection->end("the program has ended");
        end_.expires_after(std::chrono::milliseconds(300));
        end_.async_wait([this](boost::system::error_code) { context_.stop(); });
    }

    asio::io_context context_{1};
    ViewPages pages_;
    ViewAddress address_;
    std::uint16_t port_ = 0;
    asio::steady_timer end_;
    std::optional<ViewListener<asio::ip::tcp>> tcp_;
    std::optional<ViewListener<asio::local::stream_protocol>> local_;
    std::thread thread_;
};

ViewServer::ViewServer(const ViewAddress& address, std::string token, ViewEvents& events)
    : impl_(std::make_unique<Impl>(address, std::move(token), events)) {}
ViewServer::~ViewServer() = default;

std::uint16_t ViewServer::port() const {
    return impl_->port();
}
std::size_t ViewServer::pages() const {
    return impl_->pages();
}
void ViewServer::send(std::uint32_t page, std::string text) {
    impl_->send(page, std::move(text));
}
void ViewServer::send(std::string text) {
    impl_->send(std::move(text));
}
void ViewServer::send_status(const std::string& status, std::uint64_t version) {
    impl_->send_status(status, version);
}
void ViewServer::forget(std::uint32_t pane) {
    impl_->forget(pane);
}
void ViewServer::show(ViewFrame frame) {
    impl_->show(std::move(frame));
}

}  // namespace weft
