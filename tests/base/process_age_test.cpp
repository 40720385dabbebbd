// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/process_age.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace weft::process_age_test {
namespace {

TEST(ProcessAge, IsThatOfThisProcessAndNotOfTheSystem) {
    const double first = process_age_ms();
    EXPECT_GE(first, 0.0);
    ::usleep(30'000);
    const double second = process_age_ms();
    // Sleeping takes no processor time: the age is wall time.
    EXPECT_GT(second, first + 25.0);
    // A child that has just been forked is younger by all that this process did before.
    const pid_t child = ::fork();
    if (child == 0) ::_exit(process_age_ms() < second - 10.0 ? 0 : 1);
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace weft::process_age_test
