// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace weft::progress_test {
namespace {

/// What a test run writes to a stream that is no terminal.
class Capture {
  public:
    Capture() : stream_(std::tmpfile()) {}
    ~Capture() { std::fclose(stream_); }
    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;

    [[nodiscard]] std::FILE* stream() const { return stream_; }
    [[nodiscard]] std::string text() const {
        std::rewind(stream_);
        std::string result;
        for (int c = std::fgetc(stream_); c != EOF; c = std::fgetc(stream_))
            result += static_cast<char>(c);
        return result;
    }

  private:
    std::FILE* stream_;
};

std::ptrdiff_t count(const std::string& text, char c) {
    return std::count(text.begin(), text.end(), c);
}

TEST(Progress, FormatsPercentTimeAndTimeLeft) {
    EXPECT_EQ(format_progress(0.25, 2.0, 6.0), "25 %, 2.0 s, 6.0 s left");
    EXPECT_EQ(format_progress(0.25, 2.0), "25 %, 2.0 s");
    EXPECT_EQ(format_progress(0.5, 90.0, 90.0), "50 %, 1 min 30 s, 1 min 30 s left");
    EXPECT_EQ(format_progress(0.5, 4000.0, 4000.0), "50 %, 1 h 06 min, 1 h 06 min left");
    EXPECT_EQ(format_progress(1.0, 30.0), "100 %, 30 s");
    EXPECT_EQ(format_progress(0.999999, 1.0).substr(0, 4), "99 %");
    EXPECT_EQ(format_progress(0.5, 59.7, 59.7), "50 %, 1 min 00 s, 1 min 00 s left");
}

TEST(Progress, FormatsNonsenseAsSomethingSmall) {
    EXPECT_EQ(format_progress(0.0, 0.0), "0 %, 0.0 s");
    EXPECT_EQ(format_progress(-1.0, 5.0), "0 %, 5.0 s");
    EXPECT_EQ(format_progress(7.0, 5.0), "100 %, 5.0 s");
    EXPECT_EQ(format_progress(std::nan(""), 5.0), "0 %, 5.0 s");
    EXPECT_EQ(format_progress(0.5, -1.0), "50 %, 0.0 s");
    EXPECT_EQ(format_progress(0.5, std::numeric_limits<double>::infinity()).substr(0, 6), "50 %, ");
}

TEST(Progress, TimeLeftIsByTheWorkDoneSinceItBegan) {
    EXPECT_DOUBLE_EQ(seconds_left(0.0, 0.25, 2.0).value(), 6.0);
    EXPECT_DOUBLE_EQ(seconds_left(0.5, 0.75, 2.0).value(), 2.0);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double first : {0.0, 0.3}) {
        EXPECT_FALSE(seconds_left(first, first, 5.0).has_value());
        EXPECT_FALSE(seconds_left(first, 1.0, 5.0).has_value());
        EXPECT_FALSE(seconds_left(first, -1.0, 5.0).has_value());
        EXPECT_FALSE(seconds_left(first, std::nan(""), 5.0).has_value());
        EXPECT_FALSE(seconds_left(first, 0.5, 0.0).has_value());
        EXPECT_FALSE(seconds_left(first, 0.5, -1.0).has_value());
        EXPECT_FALSE(seconds_left(first, 0.5, infinity).has_value());
    }
    EXPECT_FALSE(seconds_left(0.0, 1e-300, 5.0).has_value());
}

TEST(Progress, PreparationsAreNoMeasureOfTheWork) {
    const Capture capture;
    double now = 0.0;
    Progress progress(ProgressMode::plain, capture.stream(), [&] { return now; });
    progress.update(0.0, "building");
    for (int i = 1; i <= 10; ++i) {
        now += 1.0;
        progress.prepare("compiling kernels", 11.0 - i);
    }
    for (int i = 0; i <= 4; ++i) {
        now += 1.0;
        progress.update(0.1 + 0.1 * i, "direct");
    }
    const std::string text = capture.text();
    EXPECT_NE(text.find("0 %, 1.0 s  compiling kernels, 10 s more\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("9.0 s more"), std::string::npos) << "one line a stage: " << text;
    EXPECT_NE(text.find("20 %, 12 s, 8.0 s left  direct\n"), std::string::npos) << text;
    EXPECT_NE(text.find("50 %, 15 s, 5.0 s left  direct\n"), std::string::npos) << text;
}

TEST(Progress, BarFillsAndKeepsToTheTerminal) {
    EXPECT_EQ(format_bar(0.0, "0 %", "", 80), "[" + std::string(24, '.') + "] 0 %");
    EXPECT_EQ(format_bar(1.0, "100 %, 1.0 s", "done", 80),
              "[" + std::string(24, '#') + "] 100 %, 1.0 s  done");
    EXPECT_EQ(count(format_bar(0.5, "", "x", 80), '#'), 12);
    EXPECT_EQ(format_bar(0.5, "", std::string(200, 'x'), 79).size(), 79u);
    EXPECT_EQ(format_bar(0.5, "", "x", 0), "");
}

TEST(Progress, PlainLinesAreFewAndMarkStartAndEnd) {
    const Capture capture;
    double now = 100.0;
    Progress progress(ProgressMode::plain, capture.stream(), [&] { return now; });
    for (int i = 0; i <= 2000; ++i) {
        progress.update(i / 2000.0, "direct");
        now += 0.01;
    }
    progress.finish();
    progress.finish();
    const std::string text = capture.text();
    EXPECT_EQ(text.substr(0, text.find('\n')), "0 %, 0.0 s  direct");
    EXPECT_TRUE(text.ends_with("\n100 %, 20 s  done\n")) << text;
    // A line at the start, one each 10 %, which here is every two seconds, and the end.
    EXPECT_EQ(count(text, '\n'), 11) << text;
    EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, PlainLinesKeepASecondApart) {
    const Capture capture;
    double now = 0.0;
    Progress progress(ProgressMode::automatic, capture.stream(), [&] { return now; });
    progress.update(0.0, "bvh");
    now = 0.9;
    progress.update(0.5, "direct");
    EXPECT_EQ(count(capture.text(), '\n'), 1) << "too early";
    now = 1.1;
    progress.update(0.55, "bvh");
    progress.update(0.6, "direct");
    EXPECT_EQ(count(capture.text(), '\n'), 2) << "half of the work is news";
    now = 2.2;
    progress.update(0.59, "bvh");
    EXPECT_EQ(count(capture.text(), '\n'), 2) << "the same stage, hardly further";
    progress.update(0.6, "indirect");
    EXPECT_EQ(count(capture.text(), '\n'), 3) << "a new stage";
}

TEST(Progress, PartsAreOfTheWhole) {
    const Capture capture;
    double now = 0.0;
    Progress progress(ProgressMode::plain, capture.stream(), [&] { return now; });
    progress.begin_part(0.25, 0.5);
    progress.update(0.0, "first");
    now = 4.0;
    progress.update(0.5, "second");
    now = 8.0;
    progress.update(1.0, "third");
    EXPECT_EQ(capture.text(),
              "25 %, 0.0 s  first\n50 %, 4.0 s, 8.0 s left  second\n"
              "75 %, 8.0 s, 4.0 s left  third\n");
}

TEST(Progress, NoneIsSilent) {
    const Capture capture;
    {
        Progress progress(ProgressMode::none, capture.stream());
        progress.update(0.5, "direct");
        progress.finish();
    }
    EXPECT_EQ(capture.text(), "");
}

TEST(Progress, BarOnATerminalIsRedrawnTenTimesASecondAndCleared) {
    const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
    if (master < 0 || ::grantpt(master) != 0 || ::unlockpt(master) != 0)
        GTEST_SKIP() << "no pseudo-terminals here";
    std::FILE* terminal = std::fopen(::ptsname(master), "w");
    ASSERT_NE(terminal, nullptr);
    ASSERT_EQ(::setenv("TERM", "xterm", 1), 0);
    double now = 0.0;
    {
        Progress progress(ProgressMode::automatic, terminal, [&] { return now; });
        for (int i = 0; i < 100; ++i) {
            progress.update(i / 100.0, i < 50 ? "a long stage" : "short");
            now += 0.01;
        }
    }
    std::fclose(terminal);
    std::string text;
    char buffer[4096];
    for (ssize_t size = 0; (size = ::read(master, buffer, sizeof buffer)) > 0;)
        text.append(buffer, static_cast<std::size_t>(size));
    ::close(master);
    ASSERT_FALSE(text.empty());
    EXPECT_EQ(count(text, '\n'), 0);
    const auto drawn = count(text, '[');
    EXPECT_GE(drawn, 9);
    EXPECT_LE(drawn, 11);
    EXPECT_NE(text.find("\r[####"), std::string::npos);
    // The last thing written is a blank line over the bar.
    const std::size_t blank = text.rfind('\r', text.size() - 2);
    EXPECT_EQ(text.back(), '\r');
    EXPECT_EQ(text.find_first_not_of(' ', blank + 1), text.size() - 1);
    EXPECT_GT(text.size() - blank, 30u);
}

}  // namespace
}  // namespace weft::progress_test
