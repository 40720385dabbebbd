// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tev/tev_packet.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace weft::tev_packet_test {
namespace {

TEST(TevPacket, HoldsWhatTheFormatAllows) {
    EXPECT_TRUE(tev_can_update(16384, 16384, 3));
    EXPECT_FALSE(tev_can_update(32768, 8192, 4));
    EXPECT_FALSE(tev_can_update(32768, 32768, 1));
    // Byte by byte: length, kind, whether to show it, name, size, number of channels, channel.
    const std::vector<std::string> channels{"Z"};
    const std::vector<std::byte> packet = tev_create("ab", 3, 258, channels);
    const std::string expected(
        "\x17\0\0\0\x04\x01"
        "ab\0\3\0\0\0\2\1\0\0\1\0\0\0Z\0",
        23);
    ASSERT_EQ(packet.size(), expected.size());
    for (std::size_t i = 0; i < packet.size(); ++i)
        EXPECT_EQ(packet[i], static_cast<std::byte>(expected[i])) << i;
}

}  // namespace
}  // namespace weft::tev_packet_test
