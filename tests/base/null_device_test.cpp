// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/null_device.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>

namespace weft::null_device_test {
namespace {

bool is_null_device(int descriptor) {
    struct stat found {};
    struct stat null_device {};
    return ::fstat(descriptor, &found) == 0 && ::stat("/dev/null", &null_device) == 0 &&
           S_ISCHR(found.st_mode) && found.st_rdev == null_device.st_rdev;
}

/// The number that the next descriptor to be opened gets.
int next_descriptor() {
    const int next = ::open("/", O_RDONLY | O_CLOEXEC);
    ::close(next);
    return next;
}

TEST(NullDevice, DropsWhatIsWrittenAndHasNothingToRead) {
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    const int free_one = next_descriptor();
    EXPECT_TRUE(lead_to_null_device({pipe[0], pipe[1]}));
    EXPECT_EQ(next_descriptor(), free_one);  // none is left open
    EXPECT_TRUE(is_null_device(pipe[0]));
    EXPECT_TRUE(is_null_device(pipe[1]));
    char letter = 'x';
    EXPECT_EQ(::write(pipe[1], &letter, 1), 1);
    EXPECT_EQ(::read(pipe[0], &letter, 1), 0);
    ::close(pipe[0]);
    ::close(pipe[1]);
}

TEST(NullDevice, TakesDescriptorsThatWereClosed) {
    const int closed = next_descriptor();
    EXPECT_TRUE(lead_to_null_device({closed}));
    EXPECT_TRUE(is_null_device(closed));
    EXPECT_EQ(::fcntl(closed, F_GETFD) & FD_CLOEXEC, 0);
    ::close(closed);
}

TEST(NullDevice, SaysWhereADescriptorCannotBe) {
    const int free_one = next_descriptor();
    EXPECT_FALSE(lead_to_null_device({-1}));
    EXPECT_EQ(next_descriptor(), free_one);
}

}  // namespace
}  // namespace weft::null_device_test
