// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/processor_wait.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "base/stopwatch.h"

namespace weft::processor_wait_test {
namespace {

/// Keeps a processor busy.
void run_for(double milliseconds) {
    for (const Stopwatch watch; watch.total() < milliseconds;) {
    }
}

TEST(ProcessorWait, GrowsWhereThreadsShareAProcessor) {
    if (!std::ifstream("/proc/self/schedstat").good()) GTEST_SKIP() << "the system does not say";
    cpu_set_t before;
    ASSERT_EQ(::sched_getaffinity(0, sizeof(before), &before), 0);
    cpu_set_t one;
    CPU_ZERO(&one);
    int first = 0;
    while (!CPU_ISSET(first, &before)) ++first;
    CPU_SET(first, &one);
    ASSERT_EQ(::sched_setaffinity(0, sizeof(one), &one), 0);
    const double earlier = processor_wait_ms(::getpid());
    // Both together have 600 ms of work for one processor in 600 ms; each waits half of that.
    std::thread other(run_for, 600.0);
    run_for(600.0);
    const double waited = processor_wait_ms(::getpid()) - earlier;
    other.join();
    ::sched_setaffinity(0, sizeof(before), &before);
    EXPECT_GT(waited, 100.0);
}

TEST(ProcessorWait, OfNoProcessIsNone) {
    EXPECT_EQ(processor_wait_ms(-1), 0.0);
}

}  // namespace
}  // namespace weft::processor_wait_test
