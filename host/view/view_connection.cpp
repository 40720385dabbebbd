// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_connection.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json_text.h"
#include "view/view_message.h"
#include "view/view_origin.h"
#include "view/view_page.h"
#include "view/view_token.h"

namespace weft {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr std::chrono::seconds patience(10);     // for requests and keys
constexpr std::uint32_t most_head_bytes = 8192;  // of a request
constexpr std::size_t most_texts = 256;          // that wait for a page
constexpr std::size_t most_undrawn = 2;          // frames that a page has not answered

constexpr std::string_view policy =
    "default-src 'self'; img-src 'self' blob:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

}  // namespace

auto ViewConnection::written() {
    return [self = shared_from_this()](beast::error_code error, std::size_t) {
        self->is_writing_ = false;
        if (error) return self->drop();  // its read then ends
        self->write_next();
    };
}

void ViewConnection::start() {
    stream_.expires_after(patience);
    parser_.header_limit(most_head_bytes);
    parser_.body_limit(0);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                         if (error) return self->leave();
                         self->answer();
                     });
}

void ViewConnection::send_text(std::string text) {
    if (texts_.size() >= most_texts) return drop();
    texts_.push_back(std::move(text));
    write_next();
}

void ViewConnection::show(const ViewFrame& frame) {
    waiting_.at(frame.pane) = frame;
    write_next();
}

std::uint32_t ViewConnection::state_at(std::uint64_t version) const {
    std::uint32_t state = state_;
    for (const auto& [asked, number] : asked_)
        if (asked <= version) state = number;
    return state;
}

void ViewConnection::end(const std::string& reason) {
    if (!socket_ || !is_page()) return drop();
    farewell_ = reason;
    write_next();
}

void ViewConnection::drop() {
    beast::error_code ignored;
    lowest().socket().close(ignored);
}

void ViewConnection::leave() {
    if (is_page()) {
        pages_.shown.erase(page_);
        pages_.count = pages_.shown.size();
    }
    page_ = 0;
    pages_.connections.erase(shared_from_this());
    if (pages_.connections.empty() && pages_.when_empty) pages_.when_empty();
}

void ViewConnection::answer() {
    const auto& request = parser_.get();
    const std::string_view host(request[http::field::host].data(),
                                request[http::field::host].size());
    const std::string_view target(request.target().data(), request.target().size());
    if (!is_own_host(host))
        return respond(http::status::forbidden, "This view is for this machine alone.\n");
    if (websocket::is_upgrade(request)) {
        const std::string_view origin(request[http::field::origin].data(),
                                      request[http::field::origin].size());
        if (target != "/ws") return respond(http::status::not_found, "There is no such page.\n");
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

void ViewConnection::respond(http::status status, std::string_view text, std::string_view type) {
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
    http::async_write(
        stream_, response_, [self = shared_from_this()](beast::error_code, std::size_t) {
            beast::error_code ignored;
            self->stream_.socket().shutdown(asio::socket_base::shutdown_send, ignored);
            self->leave();
        });
}

void ViewConnection::open_socket() {
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

void ViewConnection::read() {
    socket_->async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
        if (error) return self->leave();
        self->take();
    });
}

void ViewConnection::take() {
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

void ViewConnection::take_key(std::string_view text) {
    try {
        const ViewMessage message = read_view_message(text);
        const auto* const key = std::get_if<ViewKey>(&message);
        if (key == nullptr || !is_same_token(pages_.token, key->token)) {
            farewell_ = "the key is not that of this view";
            return;
        }
    } catch (const Error&) {
        farewell_ = "the key is not that of this view";
        return;
    }
    if (pages_.shown.size() >= ViewServer::most_pages) {
        farewell_ = fmt::format("{} pages show this view already", ViewServer::most_pages);
        return;
    }
    page_ = pages_.next_page++;
    pages_.shown[page_] = this;
    pages_.count = pages_.shown.size();
    socket_->set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    send_text(pages_.events.hello());
    for (const std::optional<ViewFrame>& frame : pages_.frames)
        if (frame) show(*frame);
}

void ViewConnection::take_message(std::string_view text) {
    try {
        const ViewMessage message = read_view_message(text);
        if (const auto* const ack = std::get_if<ViewAck>(&message)) return take_ack(*ack);
        if (std::holds_alternative<ViewKey>(message))
            throw input_error("message#", "is a key, which this page has shown already");
        const std::uint64_t version = pages_.events.take(page_, message);
        if (version > 0) asked_.emplace_back(version, state_of(message));
    } catch (const Error& error) {
        send_text(json_line({{"error", error.what()}}));
    }
}

void ViewConnection::take_ack(const ViewAck& ack) {
    while (!undrawn_.empty() && undrawn_.front() <= ack.sequence) undrawn_.pop_front();
    write_next();
}

std::optional<ViewFrame>* ViewConnection::next_frame() {
    std::optional<ViewFrame>* next = nullptr;
    for (std::optional<ViewFrame>& frame : waiting_)
        if (frame && (next == nullptr || frame->number < (*next)->number)) next = &frame;
    return next;
}

void ViewConnection::write_next() {
    if (is_writing_ || !socket_) return;
    if (!texts_.empty()) return write_text();
    if (farewell_) return say_farewell();
    if (is_page() && next_frame() != nullptr && undrawn_.size() < most_undrawn) write_frame();
}

void ViewConnection::write_text() {
    is_writing_ = true;
    sent_text_ = std::move(texts_.front());
    texts_.pop_front();
    socket_->text(true);
    socket_->async_write(asio::buffer(sent_text_), written());
}

void ViewConnection::write_frame() {
    is_writing_ = true;
    std::optional<ViewFrame>& next = *next_frame();
    sent_ = std::move(*next);
    next.reset();
    state_ = state_at(sent_.version);
    while (!asked_.empty() && asked_.front().first <= sent_.version) asked_.pop_front();
    undrawn_.push_back(++sequence_);
    head_ = view_frame_head(sent_, sequence_, state_);
    socket_->binary(true);
    socket_->async_write(
        std::array<asio::const_buffer, 2>{asio::buffer(head_), asio::buffer(*sent_.file)},
        written());
}

void ViewConnection::say_farewell() {
    is_writing_ = true;
    websocket::close_reason reason(websocket::close_code::policy_error);
    // What is longer does not fit into the message that closes a socket.
    constexpr std::size_t most = 120;
    reason.reason = farewell_->substr(0, most);
    socket_->async_close(reason, [self = shared_from_this()](beast::error_code) { self->leave(); });
}

}  // namespace weft
