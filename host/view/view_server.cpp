// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_server.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <atomic>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/json_text.h"
#include "view/view_origin.h"
#include "view/view_page.h"
#include "view/view_token.h"

namespace weft {
// Not unnamed, since a type of the header holds what is here.
namespace view_server {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using namespace std::chrono_literals;
using Socket = asio::generic::stream_protocol::socket;
using Stream = beast::basic_stream<asio::generic::stream_protocol>;

constexpr auto patience = 10s;                   // for requests and keys
constexpr std::uint32_t most_head_bytes = 8192;  // of a request
constexpr std::size_t most_connections = 32;     // those without a key among them
constexpr std::size_t most_texts = 256;          // that wait for a page
constexpr std::size_t most_undrawn = 2;          // frames that a page has not answered

constexpr std::string_view policy =
    "default-src 'self'; img-src 'self' blob:; connect-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

std::string error_text(std::string_view line) {
    return json_line({{"error", line}});
}

class Connection;

/// What connections share. Used by the server's thread alone.
struct Shared {
    std::string token;
    ViewEvents& events;
    std::set<std::shared_ptr<Connection>> connections{};
    std::map<std::uint32_t, Connection*> pages{};  ///< those that have shown the key
    std::atomic<std::size_t> page_count = 0;
    std::uint32_t next_page = 1;
    std::optional<ViewFrame> frame{};  ///< the last that was shown
};

/// One connection: a request for a file, or the socket of a page.
class Connection : public std::enable_shared_from_this<Connection> {
  public:
    Connection(Socket socket, Shared& shared) : stream_(std::move(socket)), shared_(shared) {}

    void start() {
        stream_.expires_after(patience);
        parser_.header_limit(most_head_bytes);
        parser_.body_limit(0);
        http::async_read(stream_, buffer_, parser_,
                         [self = shared_from_this()](beast::error_code error, std::size_t) {
                             if (error) return self->leave();
                             self->answer();
                         });
    }

    void send_text(std::string text) {
        if (texts_.size() >= most_texts) return drop();
        texts_.push_back(std::move(text));
        write_next();
    }

    void show(const ViewFrame& frame) {
        waiting_ = frame;
        write_next();
    }

    /// The page's number of what a version of the view shows.
    [[nodiscard]] std::uint32_t state_at(std::uint64_t version) const {
        std::uint32_t state = state_;
        for (const auto& [asked, number] : asked_)
            if (asked <= version) state = number;
        return state;
    }

    /// Says farewell to a page, and closes what is none.
    void end(const std::string& reason) {
        if (!socket_ || !is_page()) return drop();
        farewell_ = reason;
        write_next();
    }

    /// Closes the connection at once.
    void drop() {
        beast::error_code ignored;
        lowest().socket().close(ignored);
    }

  private:
    /// What goes on once something is written.
    [[nodiscard]] auto written() {
        return [self = shared_from_this()](beast::error_code error, std::size_t) {
            self->is_writing_ = false;
            if (error) return self->drop();  // its read then ends
            self->write_next();
        };
    }

    [[nodiscard]] bool is_page() const { return page_ != 0; }
    [[nodiscard]] Stream& lowest() { return socket_ ? beast::get_lowest_layer(*socket_) : stream_; }

    void leave() {
        if (is_page()) {
            shared_.pages.erase(page_);
            shared_.page_count = shared_.pages.size();
        }
        page_ = 0;
        shared_.connections.erase(shared_from_this());
    }

    void answer() {
        const auto& request = parser_.get();
        const std::string_view host(request[http::field::host].data(),
                                    request[http::field::host].size());
        const std::string_view target(request.target().data(), request.target().size());
        if (!is_own_host(host))
            return respond(http::status::forbidden, "This view is for this machine alone.\n");
        if (websocket::is_upgrade(request)) {
            const std::string_view origin(request[http::field::origin].data(),
                                          request[http::field::origin].size());
            if (target != "/ws")
                return respond(http::status::not_found, "There is no such page.\n");
            if (!is_own_origin(origin, host))
                return respond(http::status::forbidden,
                               "Only the page of this view may open its socket.\n");
            return open_socket();
        }
        if (request.method() != http::verb::get && request.method() != http::verb::head)
            return respond(http::status::method_not_allowed, "Only GET and HEAD are known here.\n");
        const auto file = view_file(target);
        if (!file) return respond(http::status::not_found, "There is no such page.\n");
        respond(http::status::ok, file->text, file->type);
    }

    void respond(http::status status, std::string_view text,
                 std::string_view type = "text/plain; charset=utf-8") {
        const bool only_head = parser_.get().method() == http::verb::head;
        response_.result(status);
        response_.version(11);
        response_.keep_alive(false);
        const auto set = [&](auto name, std::string_view value) {
            response_.set(name, beast::string_view(value.data(), value.size()));
        };
        set(http::field::content_type, type);
        set(http::field::cache_control, "no-store");
        set("Content-Security-Policy", policy);
        set("X-Content-Type-Options", "nosniff");
        set("Referrer-Policy", "no-referrer");
        response_.content_length(text.size());
        if (!only_head) response_.body() = std::string(text);
        stream_.expires_after(patience);
        http::async_write(stream_, response_,
                          [self = shared_from_this()](beast::error_code, std::size_t) {
                              beast::error_code ignored;
                              self->stream_.socket().shutdown(Socket::shutdown_send, ignored);
                              self->leave();
                          });
    }

    void open_socket() {
        stream_.expires_never();
        socket_.emplace(std::move(stream_));
        // Until a page has shown the key, it may be silent only so long.
        websocket::stream_base::timeout timeout{};
        timeout.handshake_timeout = patience;
        timeout.idle_timeout = patience;
        timeout.keep_alive_pings = false;
        socket_->set_option(timeout);
        socket_->read_message_max(max_view_message_bytes);
        socket_->async_accept(parser_.get(), [self = shared_from_this()](beast::error_code error) {
            if (error) return self->leave();
            self->buffer_.clear();
            self->read();
        });
    }

    void read() {
        socket_->async_read(buffer_,
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                                if (error) return self->leave();
                                self->take();
                            });
    }

    void take() {
        const auto data = buffer_.data();
        const std::string_view text(static_cast<const char*>(data.data()), data.size());
        if (!socket_->got_text())
            farewell_ = "a message was not text";
        else if (!is_page())
            take_key(text);
        else
            take_message(text);
        buffer_.consume(buffer_.size());
        if (farewell_) return write_next();
        read();
    }

    void take_key(std::string_view text) {
        try {
            const ViewMessage message = read_view_message(text);
            const auto* const key = std::get_if<ViewKey>(&message);
            if (key == nullptr || !is_same_token(shared_.token, key->token)) {
                farewell_ = "the key is not that of this view";
                return;
            }
        } catch (const Error&) {
            farewell_ = "the key is not that of this view";
            return;
        }
        if (shared_.pages.size() >= ViewServer::most_pages) {
            farewell_ = fmt::format("{} pages show this view already", ViewServer::most_pages);
            return;
        }
        page_ = shared_.next_page++;
        shared_.pages[page_] = this;
        shared_.page_count = shared_.pages.size();
        socket_->set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
        send_text(shared_.events.hello());
        if (shared_.frame) show(*shared_.frame);
    }

    void take_message(std::string_view text) {
        try {
            const ViewMessage message = read_view_message(text);
            if (const auto* const ack = std::get_if<ViewAck>(&message)) return take_ack(*ack);
            if (std::holds_alternative<ViewKey>(message))
                throw input_error("message#", "is a key, which this page has shown already");
            const std::uint64_t version = shared_.events.take(page_, message);
            if (version > 0) asked_.emplace_back(version, state_of(message));
        } catch (const Error& error) {
            send_text(error_text(error.what()));
        }
    }

    static std::uint32_t state_of(const ViewMessage& message) {
        if (const auto* const camera = std::get_if<ViewCamera>(&message)) return camera->state;
        if (const auto* const settings = std::get_if<ViewSettings>(&message))
            return settings->state;
        return 0;
    }

    void take_ack(const ViewAck& ack) {
        while (!undrawn_.empty() && undrawn_.front() <= ack.sequence) undrawn_.pop_front();
        write_next();
    }

    /// Writes what waits, texts first, unless something is being written.
    void write_next() {
        if (is_writing_ || !socket_) return;
        if (!texts_.empty()) return write_text();
        if (farewell_) return say_farewell();
        if (is_page() && waiting_ && undrawn_.size() < most_undrawn) write_frame();
    }

    void write_text() {
        is_writing_ = true;
        sent_text_ = std::move(texts_.front());
        texts_.pop_front();
        socket_->text(true);
        socket_->async_write(asio::buffer(sent_text_), written());
    }

    void write_frame() {
        is_writing_ = true;
        sent_ = std::move(*waiting_);
        waiting_.reset();
        state_ = state_at(sent_.version);
        while (!asked_.empty() && asked_.front().first <= sent_.version) asked_.pop_front();
        undrawn_.push_back(++sequence_);
        head_ = view_frame_head(sent_, sequence_, state_);
        socket_->binary(true);
        socket_->async_write(
            std::array<asio::const_buffer, 2>{asio::buffer(head_), asio::buffer(*sent_.file)},
            written());
    }

    void say_farewell() {
        is_writing_ = true;
        websocket::close_reason reason(websocket::close_code::policy_error);
        // What is longer does not fit into the message that closes a socket.
        constexpr std::size_t most = 120;
        reason.reason = farewell_->substr(0, most);
        socket_->async_close(reason,
                             [self = shared_from_this()](beast::error_code) { self->leave(); });
    }

    Stream stream_;
    Shared& shared_;
    beast::flat_buffer buffer_;
    http::request_parser<http::empty_body> parser_;
    http::response<http::string_body> response_;
    std::optional<websocket::stream<Stream>> socket_;

    std::uint32_t page_ = 0;  ///< 0 before it has shown the key
    std::deque<std::string> texts_;
    std::string sent_text_;
    std::optional<std::string> farewell_;
    bool is_writing_ = false;

    std::optional<ViewFrame> waiting_;
    ViewFrame sent_;
    std::array<std::byte, view_frame_head_bytes> head_{};
    std::uint32_t sequence_ = 0;
    std::deque<std::uint32_t> undrawn_;
    /// What the page has asked for and has not been shown: versions of the view, numbers of the
    /// page.
    std::deque<std::pair<std::uint64_t, std::uint32_t>> asked_;
    std::uint32_t state_ = 0;  ///< of the page: what the last frame showed
};

/// Takes connections as they come.
template <typename Protocol>
class Listener {
  public:
    Listener(asio::io_context& context, const typename Protocol::endpoint& endpoint, Shared& shared)
        : acceptor_(context), retry_(context), shared_(shared) {
        acceptor_.open(endpoint.protocol());
        if constexpr (std::is_same_v<Protocol, asio::ip::tcp>)
            acceptor_.set_option(asio::socket_base::reuse_address(true));
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
        beast::error_code ignored;
        acceptor_.close(ignored);
        retry_.cancel();
    }

  private:
    void accept() {
        acceptor_.async_accept([this](beast::error_code error, typename Protocol::socket socket) {
            if (error == asio::error::operation_aborted || !acceptor_.is_open()) return;
            if (error) return accept_later();
            if constexpr (std::is_same_v<Protocol, asio::ip::tcp>) {
                beast::error_code ignored;
                socket.set_option(asio::ip::tcp::no_delay(true), ignored);
            }
            if (shared_.connections.size() < most_connections) {
                auto connection = std::make_shared<Connection>(Socket(std::move(socket)), shared_);
                shared_.connections.insert(connection);
                connection->start();
            }
            accept();
        });
    }

    /// Goes on in a while: there may be no descriptors left just now.
    void accept_later() {
        retry_.expires_after(100ms);
        retry_.async_wait([this](beast::error_code error) {
            if (!error) accept();
        });
    }

    typename Protocol::acceptor acceptor_;
    asio::steady_timer retry_;
    Shared& shared_;
};

}  // namespace view_server

using namespace view_server;

class ViewServer::Impl {
  public:
    Impl(const ViewAddress& address, std::string token, ViewEvents& events)
        : shared_{std::move(token), events}, address_(address), end_(context_) {
        if (address.socket)
            listen_at(*address.socket);
        else
            listen_at(address.port.value_or(0));
        thread_ = std::thread([this] { run(); });
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
    [[nodiscard]] std::size_t pages() const { return shared_.page_count; }

    void send(std::uint32_t page, std::string text) {
        asio::post(context_, [this, page, text = std::move(text)] {
            const auto found = shared_.pages.find(page);
            if (found != shared_.pages.end()) found->second->send_text(text);
        });
    }
    void send(std::string text) {
        asio::post(context_, [this, text = std::move(text)] {
            for (const auto& [page, connection] : shared_.pages) connection->send_text(text);
        });
    }
    void send_status(const std::string& status, std::uint64_t version) {
        asio::post(context_, [this, members = status.substr(1), version] {
            for (const auto& [page, connection] : shared_.pages)
                connection->send_text(fmt::format(R"({{"status":{{"state":{},{}}})",
                                                  connection->state_at(version), members));
        });
    }
    void show(ViewFrame frame) {
        asio::post(context_, [this, frame = std::move(frame)] {
            for (const auto& [page, connection] : shared_.pages) connection->show(frame);
            shared_.frame = frame;
        });
    }

  private:
    void listen_at(std::uint16_t port) {
        const asio::ip::tcp::endpoint endpoint(asio::ip::address_v4::loopback(), port);
        try {
            tcp_.emplace(context_, endpoint, shared_);
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
                           shared_);
            // Nobody can connect before it listens.
            if (::chmod(socket.c_str(), S_IRUSR | S_IWUSR) != 0)
                throw refuse("it cannot be made private");
            local_->listen();
        } catch (const boost::system::system_error& error) {
            throw refuse(error.code().message());
        }
    }

    void run() { context_.run(); }

    /// Says farewell to all, and ends a little later, whoever has not answered.
    void end() {
        if (tcp_) tcp_->close();
        if (local_) local_->close();
        const auto connections = shared_.connections;
        for (const auto& connection : connections) connection->end("the program has ended");
        end_.expires_after(300ms);
        end_.async_wait([this](beast::error_code) { context_.stop(); });
        stop_when_empty();
    }

    void stop_when_empty() {
        if (shared_.connections.empty()) return context_.stop();
        asio::post(context_, [this] {
            std::this_thread::sleep_for(1ms);
            stop_when_empty();
        });
    }

    asio::io_context context_{1};
    Shared shared_;
    ViewAddress address_;
    std::uint16_t port_ = 0;
    asio::steady_timer end_;
    std::optional<Listener<asio::ip::tcp>> tcp_;
    std::optional<Listener<asio::local::stream_protocol>> local_;
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
void ViewServer::show(ViewFrame frame) {
    impl_->show(std::move(frame));
}

}  // namespace weft
