// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include "device/opencl/message_socket.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <thread>
#include <vector>

namespace weft::message_socket_test {
namespace {

TEST(MessageSocket, ArriveWholeOrNotAtAll) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    // More than a socket holds at once.
    const std::vector<std::byte> message(std::size_t{4} << 20, std::byte{7});
    std::thread sender([&] {
        EXPECT_TRUE(send_message(ends[0], message));
        EXPECT_TRUE(send_message(ends[0], {}));
        const std::uint64_t cut = 100;  // bytes, of which one comes
        EXPECT_EQ(::write(ends[0], &cut, sizeof(cut)), 8);
        EXPECT_EQ(::write(ends[0], &cut, 1), 1);
        ::close(ends[0]);
    });
    EXPECT_EQ(receive_message(ends[1]), message);
    EXPECT_EQ(receive_message(ends[1]), std::vector<std::byte>());
    EXPECT_EQ(receive_message(ends[1]), std::nullopt);
    sender.join();
    EXPECT_FALSE(send_message(ends[1], message));  // nobody is there
    ::close(ends[1]);
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    const std::uint64_t length = std::numeric_limits<std::uint64_t>::max();
    EXPECT_EQ(::write(ends[0], &length, sizeof(length)), 8);
    EXPECT_EQ(receive_message(ends[1]), std::nullopt);
    ::close(ends[0]);
    ::close(ends[1]);
}

}  // namespace
}  // namespace weft::message_socket_test

#endif
