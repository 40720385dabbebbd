// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_origin.h"

#include <gtest/gtest.h>

namespace weft::view_origin_test {
namespace {

TEST(ViewOrigin, HostsAreThisMachineByItsOwnNames) {
    for (const char* host :
         {"localhost", "127.0.0.1", "[::1]", "localhost:8123", "127.0.0.1:1", "[::1]:65535"})
        EXPECT_TRUE(is_own_host(host)) << host;
    for (const char* host : {"", "example.com", "localhost.example.com", "localhost:",
                             "localhost:80x", "127.0.0.1.example.com:80", "localhost:123456",
                             "evil@localhost", "LOCALHOST", "::1", "127.0.0.2", "localhost:80:80"})
        EXPECT_FALSE(is_own_host(host)) << host;
}

TEST(ViewOrigin, OriginsAreThePageOfTheHost) {
    EXPECT_TRUE(is_own_origin("http://127.0.0.1:8123", "127.0.0.1:8123"));
    EXPECT_TRUE(is_own_origin("http://localhost", "localhost"));
    for (const char* origin :
         {"", "null", "https://127.0.0.1:8123", "http://127.0.0.1:8124", "http://localhost:8123",
          "http://127.0.0.1:8123/", "http://evil.example", "127.0.0.1:8123"})
        EXPECT_FALSE(is_own_origin(origin, "127.0.0.1:8123")) << origin;
}

}  // namespace
}  // namespace weft::view_origin_test
