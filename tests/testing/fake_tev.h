// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_FAKE_TEV_H
#define WEFT_TESTS_TESTING_FAKE_TEV_H

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace weft::test {

/// What a viewer shows of an image.
struct TevImage {
    std::uint32_t width = 0, height = 0;
    std::map<std::string, std::vector<float>> channels;
};

/// A viewer that understands tev's packets and keeps what they bring. Listens on a free port of
/// this machine, and serves one connection after the other on a thread of its own.
class FakeTev {
  public:
    struct Habits {
        int receive_bytes = 0;          ///< of the socket's buffer; 0: as usual
        unsigned pause_us = 0;          ///< between two reads
        std::size_t hang_up_after = 0;  ///< bytes of the first connection; 0: never
    };

    FakeTev() : FakeTev(Habits{}) {}
    explicit FakeTev(const Habits& habits) : habits_(habits) {
        listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        // Connections take the size of the listener's buffer.
        if (habits.receive_bytes > 0)
            ::setsockopt(listener_, SOL_SOCKET, SO_RCVBUF, &habits.receive_bytes,
                         sizeof(habits.receive_bytes));
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof(address);
        if (listener_ < 0 ||
            ::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0 ||
            ::listen(listener_, 4) != 0 ||
            ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
            throw std::runtime_error("cannot listen");
        port_ = ntohs(address.sin_port);
        thread_ = std::thread([this] { serve(); });
    }
    ~FakeTev() {
        ended_ = true;
        thread_.join();
        ::close(listener_);
    }
    FakeTev(const FakeTev&) = delete;
    FakeTev& operator=(const FakeTev&) = delete;

    [[nodiscard]] std::uint16_t port() const { return port_; }

    /// Waits until that many updates have come, for at most ten seconds.
    void wait_for_updates(std::size_t count) const {
        for (int i = 0; i < 1000 && updates() < count; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        if (updates() < count) throw std::runtime_error("updates are missing: " + problem());
    }
    /// Closes the connection that there is, and waits until that is done.
    void hang_up() {
        hangs_up_ = true;
        while (hangs_up_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

    [[nodiscard]] std::size_t updates() const { return locked(updates_); }
    [[nodiscard]] std::size_t created() const { return locked(created_); }
    [[nodiscard]] std::size_t connections() const { return connections_; }
    [[nodiscard]] std::map<std::string, TevImage> images() const { return locked(images_); }
    /// What was wrong with the first packet that was; empty where none was.
    [[nodiscard]] std::string problem() const { return locked(problem_); }

  private:
    /// The fields of a packet, in order.
    class Reader {
      public:
        explicit Reader(const std::vector<std::byte>& bytes) : bytes_(bytes) {}

        template <typename Number>
        Number number() {
            Number value{};
            copy(&value, sizeof(value));
            return value;
        }
        std::string text() {
            std::string text;
            for (char c = number<char>(); c != '\0'; c = number<char>()) text += c;
            return text;
        }
        std::vector<std::string> channels() {
            std::vector<std::string> names(static_cast<std::size_t>(number<std::int32_t>()));
            for (std::string& name : names) name = text();
            return names;
        }
        std::vector<float> rest() {
            std::vector<float> values((bytes_.size() - at_) / sizeof(float));
            copy(values.data(), values.size() * sizeof(float));
            if (at_ != bytes_.size()) throw std::runtime_error("bytes are left over");
            return values;
        }
        void expect_end() const {
            if (at_ != bytes_.size()) throw std::runtime_error("bytes are left over");
        }

      private:
        void copy(void* to, std::size_t size) {
            if (bytes_.size() - at_ < size) throw std::runtime_error("a packet is too short");
            std::memcpy(to, bytes_.data() + at_, size);
            at_ += size;
        }

        const std::vector<std::byte>& bytes_;
        std::size_t at_ = 0;
    };

    template <typename Value>
    Value locked(const Value& value) const {
        const std::lock_guard guard(mutex_);
        return value;
    }

    void serve() {
        while (!ended_) {
            pollfd wanted{listener_, POLLIN, 0};
            if (::poll(&wanted, 1, 5) <= 0) continue;
            const int connection = ::accept(listener_, nullptr, nullptr);
            if (connection < 0) continue;
            ++connections_;
            receive(connection);
            ::close(connection);
            hangs_up_ = false;
        }
    }

    void receive(int connection) {
        std::vector<std::byte> waiting;
        std::size_t received = 0;
        std::array<std::byte, 1 << 16> buffer;
        while (!ended_ && !hangs_up_) {
            pollfd wanted{connection, POLLIN, 0};
            if (::poll(&wanted, 1, 5) <= 0) continue;
            const ssize_t got = ::recv(connection, buffer.data(), buffer.size(), 0);
            if (got <= 0) return;
            received += static_cast<std::size_t>(got);
            if (habits_.hang_up_after > 0 && connections_ == 1 && received > habits_.hang_up_after)
                return;
            waiting.insert(waiting.end(), buffer.begin(), buffer.begin() + got);
            take_packets(waiting);
            if (habits_.pause_us > 0)
                std::this_thread::sleep_for(std::chrono::microseconds(habits_.pause_us));
        }
    }

    void take_packets(std::vector<std::byte>& waiting) {
        std::size_t at = 0;
        while (waiting.size() - at >= sizeof(std::uint32_t)) {
            std::uint32_t length = 0;
            std::memcpy(&length, waiting.data() + at, sizeof(length));
            if (waiting.size() - at < length) break;
            const auto begin = waiting.begin() + static_cast<std::ptrdiff_t>(at);
            take(std::vector<std::byte>(begin + sizeof(length),
                                        begin + static_cast<std::ptrdiff_t>(length)));
            at += length;
        }
        waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(at));
    }

    void take(const std::vector<std::byte>& packet) {
        const std::lock_guard guard(mutex_);
        try {
            Reader reader(packet);
            const auto kind = reader.number<std::uint8_t>();
            (void)reader.number<std::uint8_t>();
            const std::string name = reader.text();
            if (kind == 4)
                create(reader, name);
            else if (kind == 6)
                update(reader, name);
            else
                throw std::runtime_error("a packet is of no known kind");
        } catch (const std::exception& error) {
            if (problem_.empty()) problem_ = error.what();
        }
    }

    void create(Reader& reader, const std::string& name) {
        TevImage image;
        image.width = static_cast<std::uint32_t>(reader.number<std::int32_t>());
        image.height = static_cast<std::uint32_t>(reader.number<std::int32_t>());
        for (const std::string& channel : reader.channels())
            image.channels[channel].resize(std::size_t{image.width} * image.height);
        reader.expect_end();
        images_[name] = image;
        ++created_;
    }

    void update(Reader& reader, const std::string& name) {
        const auto found = images_.find(name);
        if (found == images_.end()) throw std::runtime_error("an update of no image");
        TevImage& image = found->second;
        const std::vector<std::string> channels = reader.channels();
        std::array<std::int32_t, 4> window{};
        for (std::int32_t& value : window) value = reader.number<std::int32_t>();
        std::vector<std::int64_t> offsets(channels.size());
        std::vector<std::int64_t> strides(channels.size());
        for (std::int64_t& offset : offsets) offset = reader.number<std::int64_t>();
        for (std::int64_t& stride : strides) stride = reader.number<std::int64_t>();
        const std::vector<float> values = reader.rest();
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto channel = image.channels.find(channels[c]);
            if (channel == image.channels.end()) throw std::runtime_error("no such channel");
            for (std::int64_t y = 0; y < window[3]; ++y)
                for (std::int64_t x = 0; x < window[2]; ++x)
                    channel->second.at(
                        static_cast<std::size_t>((window[1] + y) * image.width + window[0] + x)) =
                        values.at(static_cast<std::size_t>(offsets[c] +
                                                           strides[c] * (y * window[2] + x)));
        }
        ++updates_;
    }

    Habits habits_;
    int listener_ = -1;
    std::uint16_t port_ = 0;
    std::atomic<bool> ended_ = false;
    std::atomic<bool> hangs_up_ = false;
    mutable std::mutex mutex_;
    std::size_t updates_ = 0, created_ = 0;
    std::atomic<std::size_t> connections_ = 0;
    std::map<std::string, TevImage> images_;
    std::string problem_;
    std::thread thread_;
};

}  // namespace weft::test

#endif
