// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/info_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "app/info_surfaces.h"
#include "base/quote.h"
#include "base/shorten.h"

namespace weft {
namespace {

using nlohmann::json;

constexpr std::size_t columns = 80;
constexpr std::size_t label_columns = 14;
constexpr std::size_t name_columns = 24;  // of an entry in a list
constexpr std::size_t longest_list = 12;  // lines

/// `text` broken at blanks into lines of at most `room` characters, and `indent` fewer from the
/// second on; a word that is longer than a line stays whole.
std::vector<std::string> wrapped(std::string_view text, std::size_t room, std::size_t indent) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t begin = 0; begin < text.size();) {
        std::size_t end = text.find(' ', begin + 1);
        if (end == std::string_view::npos) end = text.size();
        const std::string_view word = text.substr(begin, end - begin);
        const std::size_t left = lines.empty() ? room : room - indent;
        if (!line.empty() && count_characters(line) + count_characters(word) > left) {
            lines.push_back(std::move(line));
            line = word.substr(word.front() == ' ' ? 1 : 0);
        } else {
            line += word;
        }
        begin = end;
    }
    lines.push_back(std::move(line));
    return lines;
}

/// A label with its lines; those that are too long go on below, `indent` characters further in.
std::string block(std::string_view label, const std::vector<std::string>& entries,
                  std::size_t indent = 0) {
    std::string text;
    for (const std::string& entry : entries) {
        std::size_t inner = 0;
        for (const std::string& line : wrapped(one_line(entry), columns - label_columns, indent)) {
            text += fmt::format("{:<{}}{:<{}}{}\n", text.empty() ? label : "", label_columns, "",
                                inner, line);
            inner = indent;
        }
    }
    return text;
}

std::string padded(std::string text, std::size_t width) {
    const std::size_t length = count_characters(text);
    return text.append(width - std::min(width, length), ' ');
}

/// Lists `name  description` with all descriptions in one column; a long list ends early.
std::string list_block(std::string_view label,
                       const std::vector<std::pair<std::string, std::string>>& entries) {
    if (entries.empty()) return block(label, {"none"});
    // One line more is shown in place of `and 1 more`.
    const std::size_t shown = entries.size() <= longest_list + 1 ? entries.size() : longest_list;
    std::size_t width = 0;
    for (std::size_t i = 0; i < shown; ++i)
        width = std::max(width, std::min(name_columns, count_characters(entries[i].first)));
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < shown; ++i)
        lines.push_back(padded(without_middle(entries[i].first, name_columns), width) + "  " +
                        entries[i].second);
    if (shown < entries.size())
        lines.push_back(fmt::format("and {} more, which --json lists", entries.size() - shown));
    return block(label, lines, width + 2);
}

/// A number with that many digits; up to ten million all before the point, without an exponent.
std::string rounded(double value, int digits) {
    const double size = std::abs(value);
    return size >= std::pow(10.0, digits) && size < 1e7 ? fmt::format("{:.0f}", value)
                                                        : fmt::format("{:.{}g}", value, digits);
}

std::string triple(const json& v, std::string_view between, int digits = 4) {
    return fmt::format("{1}{0}{2}{0}{3}", between, rounded(v[0].get<double>(), digits),
                       rounded(v[1].get<double>(), digits), rounded(v[2].get<double>(), digits));
}

/// `3 lamps`, or `1 lamp`.
std::string counted(const json& number, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", number.get<std::size_t>(), number == 1 ? one : many);
}

std::string describe_camera(const json& camera) {
    std::string text = camera["kind"].get<std::string>();
    if (camera.contains("extent"))
        text += fmt::format(", {:.3g} x {:.3g} scene units", camera["extent"][0].get<double>(),
                            camera["extent"][1].get<double>());
    else
        text += fmt::format(", {:.3g} degrees ({})", camera["field_of_view"].get<double>(),
                            camera["field_of_view_axis"].get<std::string>());
    if (camera["animated"]) text += ", animated";
    if (camera["fallback"]) text += ", added by Weft";
    return text;
}

std::string describe_light(const json& light) {
    const json& power = light["power"];
    const bool grey = power[0] == power[1] && power[1] == power[2];
    const std::string amount =
        grey ? rounded(power[0].get<double>(), 3) : "RGB " + triple(power, " ", 3);
    std::string text = fmt::format("{}, {} {}", light["kind"].get<std::string>(), amount,
                                   light["unit"].get<std::string>());
    if (light.contains("triangles"))
        text += ", " + counted(light["triangles"], "triangle", "triangles");
    if (light.contains("image"))
        text += fmt::format(" on average, image of {} x {} pixels",
                            light["image"][0].get<std::uint32_t>(),
                            light["image"][1].get<std::uint32_t>());
    if (light["default"]) text += ", added by Weft";
    return text;
}

std::string describe_animation(const json& animation) {
    const std::size_t all = animation["channels"];
    const std::size_t played = animation["channels_played"];
    std::string text =
        fmt::format("{:.4g} s, {} at 30 a second", animation["duration"].get<double>(),
                    counted(animation["frames"], "frame", "frames"));
    if (played == 0)
        text += ", not played";
    else if (played < all)
        text += fmt::format(", {} of {} channels played", played, all);
    return text;
}

/// A list of objects, each with its name and what `describe` says of it.
template <class Describe>
std::string named_block(std::string_view label, const json& list, const Describe& describe) {
    std::vector<std::pair<std::string, std::string>> entries;
    for (const json& entry : list)
        entries.emplace_back(one_line(entry["name"].get<std::string>()), describe(entry));
    return list_block(label, entries);
}

std::string approximation_block(const json& list) {
    std::vector<std::string> lines;
    for (const json& entry : list) {
        const std::string unit = entry["unit"];
        const std::string title = entry["title"];
        lines.push_back(unit.empty() ? title
                                     : fmt::format("{} {}: {}", entry["number"].get<std::size_t>(),
                                                   unit, title));
    }
    return block("approximated", lines.empty() ? std::vector<std::string>{"nothing"} : lines, 2);
}

std::string joined_block(std::string_view label, const json& names) {
    const auto list = names.get<std::vector<std::string>>();
    return block(label, {list.empty() ? "none" : fmt::format("{}", fmt::join(list, ", "))});
}

std::string bounds_block(const json& bounds) {
    if (bounds.is_null()) return block("size", {"nothing is placed"});
    return block("size", {triple(bounds["size"], " x ") + " scene units"}) +
           block("bounds", {fmt::format("from ({}) to ({})", triple(bounds["low"], ", "),
                                        triple(bounds["high"], ", "))});
}

/// The materials that are more than diffuse, none where all are.
std::string surface_block(const json& surfaces, const json& materials) {
    if (surfaces.empty()) return "";
    const std::string head = fmt::format("more than diffuse: {} of {}", surfaces.size(),
                                         counted(materials, "material", "materials"));
    return block("surfaces", {head}) + named_block("", surfaces, describe_surface);
}

/// Where indirect light comes from, and why.
std::string indirect_text(const json& indirect) {
    const std::string method = indirect["method"];
    const json& landed = indirect["vpls_landed"];
    const std::string share =
        landed.is_null() ? ""
                         : fmt::format(", of which {:.0f} % land", 100.0 * landed.get<double>());
    if (method == "rays") return "a path through each pixel, not virtual lights" + share;
    if (method == "vpl") return "virtual lights" + share;
    return "none";
}

}  // namespace

std::string info_text(const json& info) {
    std::string text = block("scene", {info["scene"].get<std::string>()});
    text += block("geometry", {fmt::format("{} in {}, placed {}",
                                           counted(info["triangles"], "triangle", "triangles"),
                                           counted(info["meshes"], "mesh", "meshes"),
                                           counted(info["instances"], "time", "times"))});
    text += block("materials", {fmt::format("{}, with {}", info["materials"].get<std::size_t>(),
                                            counted(info["textures"], "texture", "textures"))});
    text += surface_block(info["surfaces"], info["materials"]);
    text += bounds_block(info["bounds"]);
    text += named_block("cameras", info["camera_list"], describe_camera);
    text += named_block("lights", info["light_list"], describe_light);
    text += block("media",
                  info["medium_list"].empty() ? std::vector<std::string>{"none"}
                                              : info["medium_list"].get<std::vector<std::string>>(),
                  2);
    text += named_block("animations", info["animations"], describe_animation);
    text += approximation_block(info["approximations"]);
    text += block("indirect", {indirect_text(info["indirect"])});
    for (const char* label : {"effects", "components", "kernels"})
        text += joined_block(label, info[label]);
    return text;
}

}  // namespace weft
