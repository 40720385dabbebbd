// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/parse_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <system_error>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

constexpr double seconds_per_year = 365.0 * 24.0 * 3600.0;

[[noreturn]] void fail(std::string_view option, std::string_view text,
                       const std::string& expected) {
    throw Error(ExitCode::usage, std::string(option),
                quote(text) + " is not valid, expected " + expected);
}

/// True when the whole text is a number of that type that can be represented.
template <typename Number>
bool parse_all(std::string_view text, Number& number) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end;
}

/// Optimal string alignment distance.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1);
    std::vector<std::size_t> above(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before.swap(above);
        above.swap(row);
    }
    return above[b.size()];
}

/// `A:B` with A < B <= most.
bool parse_half_open(std::string_view text, std::uint32_t most, std::uint32_t& first,
                     std::uint32_t& end) {
    const std::size_t colon = text.find(':');
    return colon != std::string_view::npos && parse_all(text.substr(0, colon), first) &&
           parse_all(text.substr(colon + 1), end) && first < end && end <= most;
}

std::string join(std::span<const std::string_view> names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::string did_you_mean(std::string_view text, std::span<const std::string_view> names) {
    constexpr std::size_t longest_name = 64;
    if (text.size() > longest_name) return {};
    std::string_view best;
    // The dashes of an option are no letters that were typed right.
    const auto letters = [](std::string_view word) {
        return word.size() - std::min(word.find_first_not_of('-'), word.size());
    };
    std::size_t best_distance = std::max<std::size_t>(1, letters(text) / 3) + 1;
    for (const std::string_view name : names) {
        const std::size_t found = distance(text, name);
        // A name that differs in every letter is no mistyped one.
        if (found < best_distance && found < letters(name)) {
            best = name;
            best_distance = found;
        }
    }
    return best.empty() ? std::string() : fmt::format(", did you mean '{}'?", best);
}

std::uint32_t parse_unsigned(std::string_view option, std::string_view text, std::uint32_t min,
                             std::uint32_t max) {
    std::uint32_t value = 0;
    if (!parse_all(text, value) || value < min || value > max)
        fail(option, text, fmt::format("a whole number from {} to {}", min, max));
    return value;
}

double parse_number(std::string_view option, std::string_view text, double min, double max,
                    std::string_view words) {
    double value = 0.0;
    if (!parse_all(text, value) || !std::isfinite(value) || value < min || value > max)
        fail(option, text,
             fmt::format("{}{}a number from {} to {}", words, words.empty() ? "" : " or ", min,
                         max));
    return value;
}

glm::dvec3 parse_vector(std::string_view option, std::string_view text) {
    glm::dvec3 vector(0.0);
    std::size_t begin = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const bool is_last = axis == 2;
        double& value = vector[axis];
        if (!parse_all(text.substr(begin, end - begin), value) || !std::isfinite(value) ||
            std::abs(value) > limits::max_coordinate || (end == text.size()) != is_last)
            fail(
                option, text,
                fmt::format("three numbers, such as 1,2.5,-3, up to {:g}", limits::max_coordinate));
        begin = std::min(end + 1, text.size());
    }
    return vector;
}

double parse_duration(std::string_view option, std::string_view text) {
    struct Unit {
        std::string_view suffix;
        double seconds;
    };
    constexpr std::array<Unit, 3> units = {{{"ms", 1e-3}, {"s", 1.0}, {"m", 60.0}}};
    const auto unit = std::find_if(units.begin(), units.end(), [&](const Unit& candidate) {
        return text.ends_with(candidate.suffix);
    });
    double value = 0.0;
    if (unit != units.end() &&
        parse_all(text.substr(0, text.size() - unit->suffix.size()), value)) {
        const double seconds = value * unit->seconds;
        if (seconds > 0.0 && seconds <= seconds_per_year) return seconds;
    }
    fail(option, text, "a time above 0 and up to a year, such as 300ms, 2.5s or 2m");
}

FilmSize parse_size(std::string_view option, std::string_view text) {
    const std::size_t cross = text.find('x');
    FilmSize size;
    const bool numbers = cross != std::string_view::npos &&
                         parse_all(text.substr(0, cross), size.width) &&
                         parse_all(text.substr(cross + 1), size.height);
    if (!numbers || size.width == 0 || size.height == 0 || size.width > limits::max_film_edge ||
        size.height > limits::max_film_edge ||
        std::size_t{size.width} * size.height > limits::max_film_pixels)
        fail(option, text,
             fmt::format("WxH in pixels, such as 640x480, up to {} each way and {} in all",
                         limits::max_film_edge, limits::max_film_pixels));
    return size;
}

SampleRange parse_range(std::string_view option, std::string_view text) {
    SampleRange range;
    if (!parse_half_open(text, limits::max_samples_per_pixel, range.first, range.end))
        fail(option, text,
             fmt::format("A:B, such as 0:64 for the first 64 samples, up to {}",
                         limits::max_samples_per_pixel));
    return range;
}

PartOfMany parse_part(std::string_view option, std::string_view text) {
    PartOfMany of;
    const std::size_t bar = text.find('/');
    if (bar == std::string_view::npos || !parse_all(text.substr(0, bar), of.part) ||
        !parse_all(text.substr(bar + 1), of.parts) || of.part < 1 || of.part > of.parts)
        fail(option, text, "I/N, such as 1/16 for the first of 16 parts");
    return of;
}

FrameRange parse_frames(std::string_view option, std::string_view text) {
    FrameRange range;
    if (!parse_half_open(text, limits::max_frames, range.first, range.end))
        fail(
            option, text,
            fmt::format("A:B, such as 0:30 for the first 30 frames, up to {}", limits::max_frames));
    return range;
}

std::size_t parse_name(std::string_view option, std::string_view text,
                       std::span<const std::string_view> names) {
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end())
        fail(option, text, fmt::format("one of {}{}", join(names), did_you_mean(text, names)));
    return static_cast<std::size_t>(found - names.begin());
}

std::vector<std::string> parse_name_list(std::string_view option, std::string_view text,
                                         std::span<const std::string_view> names) {
    std::vector<bool> given(names.size());
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::size_t index = parse_name(option, text.substr(begin, end - begin), names);
        if (given[index]) fail(option, text, fmt::format("each of {} at most once", join(names)));
        given[index] = true;
        begin = end + 1;
    }
    std::vector<std::string> result;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (given[i]) result.emplace_back(names[i]);
    return result;
}

}  // namespace weft
