// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace weft {
namespace {

constexpr double bar_interval = 0.1;   // seconds
constexpr double line_interval = 1.0;  // seconds
constexpr double lines_in_all = 10.0;  // one each 10 % of the work
constexpr double longest_left = 1e7;   // seconds; a longer estimate is not shown
constexpr std::size_t bar_cells = 24;
constexpr std::size_t default_columns = 80;

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double clamp_fraction(double fraction) {
    return fraction > 0.0 ? std::min(fraction, 1.0) : 0.0;
}

/// Index of the line that a fraction belongs to; the small term is for rounding in sums of tenths.
double line_step(double fraction) {
    return std::floor(lines_in_all * clamp_fraction(fraction) + 1e-9);
}

std::string format_seconds(double seconds) {
    if (!(seconds > 0.0)) seconds = 0.0;
    if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
    if (seconds < 59.5) return fmt::format("{:.0f} s", seconds);
    const auto whole = std::llround(std::min(seconds, 1e15));
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

bool is_terminal(std::FILE* stream) {
    const char* kind = std::getenv("TERM");
    const bool dumb = kind != nullptr && std::string_view(kind) == "dumb";
    return !dumb && ::isatty(::fileno(stream)) != 0;
}

std::size_t terminal_columns(std::FILE* stream) {
    winsize size{};
    if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return default_columns;
    return size.ws_col;
}

}  // namespace

std::optional<double> seconds_left(double first, double fraction, double seconds) {
    const double done = clamp_fraction(fraction);
    if (done <= clamp_fraction(first) || done >= 1.0) return {};
    const double left = seconds * (1.0 - done) / (done - clamp_fraction(first));
    return left > 0.0 && left < longest_left ? std::optional(left) : std::nullopt;
}

std::string format_progress(double fraction, double elapsed_seconds,
                            std::optional<double> left_seconds) {
    std::string text = fmt::format("{} %, {}", std::floor(100.0 * clamp_fraction(fraction)),
                                   format_seconds(elapsed_seconds));
    if (left_seconds) text += ", " + format_seconds(*left_seconds) + " left";
    return text;
}

std::string format_bar(double fraction, const std::string& text, std::string_view stage,
                       std::size_t columns) {
    const auto filled = static_cast<std::size_t>(
        std::floor(static_cast<double>(bar_cells) * clamp_fraction(fraction)));
    std::string bar = "[" + std::string(filled, '#') + std::string(bar_cells - filled, '.') + "] ";
    bar += text;
    if (!stage.empty()) bar.append("  ").append(stage);
    return bar.substr(0, columns);
}

Progress::Progress(ProgressMode mode, std::FILE* stream, std::function<double()> clock)
    : stream_(stream),
      clock_(clock ? std::move(clock) : steady_seconds),
      style_(mode == ProgressMode::none                               ? Style::silent
             : mode == ProgressMode::automatic && is_terminal(stream) ? Style::bar
                                                                      : Style::lines),
      start_(clock_()) {}

Progress::~Progress() {
    clear_bar();
}

void Progress::update(double fraction_of_part, std::string_view stage) {
    const double fraction = part_begin_ + part_size_ * clamp_fraction(fraction_of_part);
    if (!(first_fraction_ > 0.0) && fraction > 0.0) {
        work_start_ = clock_();
        first_fraction_ = fraction;
    }
    show(fraction, stage, {});
}

void Progress::prepare(std::string_view stage, double seconds_left) {
    show(last_fraction_, stage, ", " + format_seconds(seconds_left) + " more");
}

void Progress::show(double fraction, std::string_view stage, std::string_view note) {
    if (style_ == Style::silent || finished_) return;
    const double now = clock_();
    const double since = now - last_time_;
    if (style_ == Style::bar) {
        if (shown_ && since < bar_interval) return;
        draw_bar(fraction, now, std::string(stage).append(note));
    } else {
        // The end is printed by finish().
        const bool further = fraction < 1.0 && line_step(fraction) > line_step(last_fraction_);
        const bool news = further || stage != last_stage_;
        if (shown_ && (since < line_interval || !news)) return;
        print_line(fraction, now, std::string(stage).append(note));
    }
    shown_ = true;
    last_time_ = now;
    last_fraction_ = clamp_fraction(fraction);
    last_stage_ = stage;
}

void Progress::begin_part(double begin, double size) {
    part_begin_ = begin;
    part_size_ = size;
}

void Progress::finish() {
    if (finished_) return;
    finished_ = true;
    if (style_ == Style::lines) print_line(1.0, clock_(), "done");
    clear_bar();
}

std::optional<double> Progress::left(double fraction, double now) const {
    if (!(first_fraction_ > 0.0)) return {};
    return seconds_left(first_fraction_, fraction, now - work_start_);
}

void Progress::draw_bar(double fraction, double now, const std::string& stage) {
    // The last column stays free: some terminals wrap as soon as it is written.
    const std::string text =
        format_bar(fraction, format_progress(fraction, now - start_, left(fraction, now)), stage,
                   terminal_columns(stream_) - 1);
    const std::size_t rest = bar_length_ > text.size() ? bar_length_ - text.size() : 0;
    write("\r" + text + std::string(rest, ' '));
    bar_length_ = text.size();
}

void Progress::print_line(double fraction, double now, std::string_view stage) {
    write(fmt::format("{}{}{}\n", format_progress(fraction, now - start_, left(fraction, now)),
                      stage.empty() ? "" : "  ", stage));
}

void Progress::clear_bar() {
    if (bar_length_ == 0) return;
    write("\r" + std::string(bar_length_, ' ') + "\r");
    bar_length_ = 0;
}

void Progress::write(const std::string& text) {
    // A closed stream is no reason to stop the work, so failures are ignored.
    std::fputs(text.c_str(), stream_);
    std::fflush(stream_);
}

}  // namespace weft
