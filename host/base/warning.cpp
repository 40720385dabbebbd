// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/warning.h"

#include <algorithm>
#include <utility>

#include "base/shorten.h"

namespace weft {
namespace {

constexpr std::string_view dots = "...";
constexpr std::size_t shortest_cut = 12;  // characters of a name that lost its middle

/// Where the part of a place within its file begins: `#/nodes/3` or `:17`, perhaps with a quoted
/// name behind.
std::size_t begin_of_part(std::string_view place) {
    const std::size_t pointer = place.rfind("#/");
    if (pointer != std::string_view::npos) return pointer;
    const std::size_t name = place.ends_with('\'') ? place.find(" '") : place.size();
    const std::string_view head = place.substr(0, name);
    const std::size_t colon = head.rfind(':');
    const bool is_line = colon != std::string_view::npos && colon + 1 < head.size() &&
                         head.find_first_not_of("0123456789", colon + 1) == std::string_view::npos;
    return is_line ? colon : place.size();
}

/// A place in `room` characters; empty where it cannot be told in that.
std::string fit_place(std::string_view place, std::size_t room) {
    if (count_characters(place) <= room) return std::string(place);
    const std::size_t begin = begin_of_part(place);
    const std::string_view file = place.substr(0, begin);
    const std::string_view part = place.substr(begin);
    for (std::size_t slash = file.find('/'); slash != std::string_view::npos;
         slash = file.find('/', slash + 1)) {
        std::string shorter = std::string(dots) + std::string(place.substr(slash));
        if (count_characters(shorter) <= room) return shorter;
    }
    const std::string_view name = file.substr(file.rfind('/') + 1);
    const std::size_t part_length = count_characters(part);
    constexpr std::size_t shortest_file = 8;
    if (part_length + shortest_file <= room)
        return without_middle(name, room - part_length) + std::string(part);
    return room >= shortest_cut ? without_middle(place.substr(begin - name.size()), room) : "";
}

/// The longest quoted name in `message`, with its quotes: where it begins and how long it is.
std::pair<std::size_t, std::size_t> longest_quoted(std::string_view message) {
    std::pair<std::size_t, std::size_t> found{0, 0};
    for (std::size_t begin = message.find('\''); begin != std::string_view::npos;) {
        const std::size_t end = message.find('\'', begin + 1);
        if (end == std::string_view::npos) break;
        if (end + 1 - begin > found.second) found = {begin, end + 1 - begin};
        begin = message.find('\'', end + 1);
    }
    return found;
}

/// A message whose longest quoted name has lost `excess` characters, or as many as it can spare.
std::string with_shorter_name(const std::string& message, std::size_t excess) {
    const auto [begin, length] = longest_quoted(message);
    if (length < 2) return message;
    const std::string_view name = std::string_view(message).substr(begin + 1, length - 2);
    const std::size_t characters = count_characters(name);
    const std::size_t room =
        std::max(characters - std::min(excess, characters), std::min(characters, shortest_cut));
    return message.substr(0, begin + 1) + without_middle(name, room) +
           message.substr(begin + length - 1);
}

std::size_t count_places(const Warning& warning) {
    return warning.places.size() + warning.places_left_out;
}

/// What stands before and behind the place in a line; `{}` where there is none.
struct Frame {
    std::string before;
    std::string after;
    std::string without_place;
};

Frame frame_of(const Warning& warning, const std::string& message) {
    const std::size_t places = count_places(warning);
    if (warning.unit.one.empty()) {
        const std::string more = places > 1 ? " (and at " + std::to_string(places - 1) +
                                                  (places == 2 ? " more place)" : " more places)")
                                            : "";
        return {"", ": " + message + more, message + more};
    }
    const std::string counted =
        std::to_string(warning.number) + " " +
        std::string(warning.number == 1 ? warning.unit.one : warning.unit.many) + ": " + message;
    return {counted + (places > 1 ? "; first: " : "; at "), "", counted};
}

std::string join(const Frame& frame, const std::string& place) {
    return place.empty() ? frame.without_place : frame.before + place + frame.after;
}

}  // namespace

std::string warning_line(const Warning& warning, std::size_t longest) {
    const std::string& place = warning.places.empty() ? std::string() : warning.places.front().text;
    const Frame whole = frame_of(warning, warning.message);
    std::string line = join(whole, place);
    if (count_characters(line) <= longest) return line;
    // The place within its file, and something of the file's name, is worth more than the middle
    // of a long quoted name.
    const std::size_t wanted =
        std::min(count_characters(place),
                 count_characters(std::string_view(place).substr(begin_of_part(place))) + 24);
    const std::size_t around = count_characters(whole.before) + count_characters(whole.after);
    Frame frame = whole;
    if (around + wanted > longest)
        frame = frame_of(warning, with_shorter_name(warning.message, around + wanted - longest));
    const std::size_t taken = count_characters(frame.before) + count_characters(frame.after);
    line = join(frame, fit_place(place, longest - std::min(longest, taken)));
    return line;
}

std::vector<std::string> warning_details(const Warning& warning) {
    if (count_places(warning) < 2) return {warning_line(warning)};
    Warning without_places = warning;
    without_places.places.clear();
    without_places.places_left_out = 0;
    std::vector<std::string> lines{warning_line(without_places)};
    for (const Warning::Place& place : warning.places)
        lines.push_back("  " + place.text +
                        (place.number > 1 ? " (" + std::to_string(place.number) + ")" : ""));
    if (warning.places_left_out > 0)
        lines.push_back("  and " + std::to_string(warning.places_left_out) + " more places");
    return lines;
}

std::string warning_title(const Warning& warning) {
    bool quoted = false;
    for (std::size_t i = 0; i < warning.message.size(); ++i) {
        if (warning.message[i] == '\'') quoted = !quoted;
        if (warning.message[i] == ',' && !quoted) return warning.message.substr(0, i);
    }
    return warning.message;
}

}  // namespace weft
