// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/interrupt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "base/null_device.h"

namespace weft::interrupt_test {
namespace {

TEST(Interrupt, SignalsSetTheFlag) {
    for (const int signal : {SIGINT, SIGTERM}) {
        InterruptGuard guard("a message");
        guard.keep_work();
        EXPECT_FALSE(interrupt_flag());
        std::raise(signal);
        EXPECT_TRUE(interrupt_flag());
        std::raise(signal);  // the same signal, passed on twice by another program
        EXPECT_TRUE(interrupt_flag());
    }
}

TEST(Interrupt, EarlierHandlersComeBack) {
    const auto earlier = std::signal(SIGINT, SIG_IGN);
    { const InterruptGuard guard("a message"); }
    EXPECT_EQ(std::signal(SIGINT, earlier), SIG_IGN);
}

TEST(InterruptDeathTest, SignalsEndAtOnceWhereThereIsNoWorkToKeep) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const auto interrupt = [&] {
            const InterruptGuard guard("nothing was done yet");
            std::raise(signal);
        };
        EXPECT_EXIT(interrupt(), testing::ExitedWithCode(130), "^nothing was done yet\n$");
    }
}

TEST(InterruptDeathTest, TheMessageIsReadWhateverStandardErrorIsNow) {
    const auto interrupt = [] {
        const InterruptGuard guard("nothing was done yet");
        lead_to_null_device({STDERR_FILENO});
        std::raise(SIGINT);
    };
    EXPECT_EXIT(interrupt(), testing::ExitedWithCode(130), "^nothing was done yet\n$");
}

TEST(InterruptDeathTest, SecondCtrlCEndsAtOnce) {
    const auto press_twice = [] {
        InterruptGuard guard("a message");
        guard.keep_work();
        std::raise(SIGINT);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        std::raise(SIGINT);
    };
    EXPECT_EXIT(press_twice(), testing::ExitedWithCode(130), "");
}

TEST(InterruptDeathTest, RepeatedTerminationRequestsDoNotEnd) {
    const auto terminate_twice = [] {
        InterruptGuard guard("a message");
        guard.keep_work();
        std::raise(SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        std::raise(SIGTERM);
        std::_Exit(interrupt_flag() ? 0 : 1);
    };
    EXPECT_EXIT(terminate_twice(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace weft::interrupt_test
