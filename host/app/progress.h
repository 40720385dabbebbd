// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_PROGRESS_H
#define WEFT_APP_PROGRESS_H

#include <cstddef>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace weft {

/// How progress is shown: a bar on a terminal and plain lines elsewhere, always plain lines, or not
/// at all.
enum class ProgressMode { automatic, plain, none };

/// Seconds left of work that got from the fraction `first` to `fraction` in `seconds`; nothing
/// where that cannot be told yet.
[[nodiscard]] std::optional<double> seconds_left(double first, double fraction, double seconds);

/// Percent done, time spent and, where it is known, time left: `42 %, 3.1 s, 4.3 s left`.
/// `fraction` is clamped to [0, 1], NaN counts as 0; 100 % only shows when all is done.
[[nodiscard]] std::string format_progress(double fraction, double elapsed_seconds,
                                          std::optional<double> left_seconds = {});

/// A bar, the text of format_progress() and the stage, shortened to at most `columns` characters.
[[nodiscard]] std::string format_bar(double fraction, const std::string& text,
                                     std::string_view stage, std::size_t columns);

/// Shows how far a piece of work has come. Used from one thread.
class Progress {
  public:
    /// `stream` is not closed. `clock` returns seconds; the steady clock where it is empty.
    Progress(ProgressMode mode, std::FILE* stream, std::function<double()> clock = {});

    /// Removes the bar from the terminal, so that an error message starts on a clean line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows that `fraction` of all work is done, and the stage that runs now. Cheap enough to call
    /// often: the bar is drawn at most ten times a second; a plain line follows the one before
    /// after at least a second and the next 10 % or a new stage.
    void update(double fraction, std::string_view stage);

    /// Shows a stage that is no part of the work, such as a preparation, and how many seconds it
    /// still takes. As cheap as update().
    void prepare(std::string_view stage, double seconds_left);

    /// Lets fractions count, from now on, within the part [begin, begin + size) of all work.
    void begin_part(double begin, double size);

    /// Removes the bar from the terminal until the next update(), so that a message starts on a
    /// clean line.
    void clear_bar();

    /// Ends progress when all is done: removes the bar, or prints the last line with the whole
    /// time.
    void finish();

  private:
    enum class Style { bar, lines, silent };

    void show(double fraction, std::string_view stage, std::string_view note);
    /// Seconds until all is done, by how fast it has gone since work began.
    [[nodiscard]] std::optional<double> left(double fraction, double now) const;
    void draw_bar(double fraction, double now, const std::string& stage);
    void print_line(double fraction, double now, std::string_view stage);
    void write(const std::string& text);

    std::FILE* stream_;
    std::function<double()> clock_;
    Style style_;
    double start_;
    // Preparations are no measure of how fast work goes: when it began, and with which fraction.
    double work_start_ = 0.0;
    double first_fraction_ = 0.0;
    double part_begin_ = 0.0;
    double part_size_ = 1.0;
    bool shown_ = false;
    bool finished_ = false;
    double last_time_ = 0.0;
    double last_fraction_ = 0.0;
    std::string last_stage_;
    std::size_t bar_length_ = 0;
};

}  // namespace weft

#endif
