// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_VIEW_CLIENT_H
#define WEFT_TESTS_TESTING_VIEW_CLIENT_H

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

namespace weft::test {

/// What a page has received.
struct ViewReceived {
    std::string text;   ///< of a text message
    std::string bytes;  ///< of a frame
    std::string ended;  ///< why the socket was closed; "lost" where nothing says why

    /// A number of a frame's head, at a byte.
    [[nodiscard]] std::uint32_t word(std::size_t at) const {
        std::uint32_t value = 0;
        if (bytes.size() >= at + sizeof(value))
            std::memcpy(&value, bytes.data() + at, sizeof(value));
        return value;
    }
    [[nodiscard]] std::uint32_t sequence() const { return word(8); }
    [[nodiscard]] std::uint32_t state() const { return word(12); }
    [[nodiscard]] std::uint32_t samples() const { return word(20); }
};

/// A page of a view without a browser. All calls wait, without limit.
class ViewClient {
  public:
    explicit ViewClient(std::uint16_t port) : port_(port) {
        socket_.next_layer().connect({boost::asio::ip::address_v4::loopback(), port});
        host_ = "127.0.0.1:" + std::to_string(port);
        origin_ = "http://" + host_;
    }

    void set_host(std::string host) { host_ = std::move(host); }
    void set_origin(std::string origin) { origin_ = std::move(origin); }

    /// Opens the socket; returns the status of the answer: 101 where it is open.
    unsigned open(const std::string& target = "/ws") {
        namespace websocket = boost::beast::websocket;
        socket_.set_option(
            websocket::stream_base::decorator([this](websocket::request_type& request) {
                if (origin_.empty())
                    request.erase(boost::beast::http::field::origin);
                else
                    request.set(boost::beast::http::field::origin, origin_);
            }));
        socket_.read_message_max(std::size_t{256} << 20U);
        boost::beast::error_code error;
        socket_.handshake(host_, target, error);
        return error ? refusal(target) : 101U;
    }

    /// Opens the socket and shows the key; returns the first answer.
    ViewReceived enter(const std::string& token) {
        if (open() != 101) return {{}, {}, "refused"};
        send(R"({"token":")" + token + R"("})");
        return receive();
    }

    void send(const std::string& text) {
        boost::beast::error_code error;
        socket_.text(true);
        socket_.write(boost::asio::buffer(text), error);
    }
    void send_binary(const std::string& bytes) {
        boost::beast::error_code error;
        socket_.binary(true);
        socket_.write(boost::asio::buffer(bytes), error);
    }
    void ack(std::uint32_t sequence) { send("{\"ack\":" + std::to_string(sequence) + "}"); }

    ViewReceived receive() {
        boost::beast::flat_buffer buffer;
        boost::beast::error_code error;
        socket_.read(buffer, error);
        ViewReceived received;
        if (error) {
            received.ended = socket_.reason().reason.c_str();
            if (received.ended.empty()) received.ended = "lost";
            return received;
        }
        (socket_.got_text() ? received.text : received.bytes) =
            boost::beast::buffers_to_string(buffer.data());
        return received;
    }

    /// Closes the connection without a word.
    void hang_up() {
        boost::beast::error_code ignored;
        socket_.next_layer().close(ignored);
    }

    /// The code of the reason for which the socket was closed.
    [[nodiscard]] unsigned close_code() const { return socket_.reason().code; }

    /// The answer to a request of a file by another connection.
    boost::beast::http::response<boost::beast::http::string_body> get(
        const std::string& target, boost::beast::http::verb verb = boost::beast::http::verb::get) {
        namespace http = boost::beast::http;
        boost::asio::ip::tcp::socket socket(context_);
        socket.connect({boost::asio::ip::address_v4::loopback(), port_});
        http::request<http::string_body> request{verb, target, 11};
        request.set(http::field::host, host_);
        http::write(socket, request);
        boost::beast::flat_buffer buffer;
        http::response_parser<http::string_body> parser;
        parser.skip(verb == http::verb::head);
        boost::beast::error_code error;
        http::read(socket, buffer, parser, error);
        return parser.release();
    }

  private:
    /// The status of the answer to a request for a socket, asked by another connection: the first
    /// keeps it to itself.
    unsigned refusal(const std::string& target) {
        namespace http = boost::beast::http;
        boost::asio::ip::tcp::socket socket(context_);
        socket.connect({boost::asio::ip::address_v4::loopback(), port_});
        http::request<http::empty_body> request{http::verb::get, target, 11};
        request.set(http::field::host, host_);
        request.set(http::field::upgrade, "websocket");
        request.set(http::field::connection, "Upgrade");
        request.set(http::field::sec_websocket_version, "13");
        request.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
        if (!origin_.empty()) request.set(http::field::origin, origin_);
        http::write(socket, request);
        boost::beast::flat_buffer buffer;
        http::response<http::string_body> response;
        boost::beast::error_code error;
        http::read(socket, buffer, response, error);
        return error ? 0U : response.result_int();
    }

    std::uint16_t port_;
    boost::asio::io_context context_;
    boost::beast::websocket::stream<boost::asio::ip::tcp::socket> socket_{context_};
    std::string host_, origin_;
};

}  // namespace weft::test

#endif
