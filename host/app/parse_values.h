// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_PARSE_VALUES_H
#define WEFT_APP_PARSE_VALUES_H

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/frame_options.h"
#include "film/film_sums.h"
#include "scene/scene.h"

namespace weft {

/// The name nearest to a mistyped one by insertions, deletions, replacements and swaps of
/// neighbours, as `, did you mean 'name'?`; empty where none is near.
[[nodiscard]] std::string did_you_mean(std::string_view text,
                                       std::span<const std::string_view> names);

// Each of these reads the whole value of an option and throws Error (exit code 1) that names the
// option, the text and what was expected.

/// A decimal whole number from `min` to `max`, without sign.
[[nodiscard]] std::uint32_t parse_unsigned(std::string_view option, std::string_view text,
                                           std::uint32_t min, std::uint32_t max);

/// A finite decimal number from `min` to `max`. `words`, which the caller reads, are named in the
/// error as well.
[[nodiscard]] double parse_number(std::string_view option, std::string_view text, double min,
                                  double max, std::string_view words = {});

/// `X,Y,Z`: three numbers, each as parse_number takes it, of at most `limits::max_coordinate`.
[[nodiscard]] glm::dvec3 parse_vector(std::string_view option, std::string_view text);

/// A length of time such as `300ms`, `2.5s` or `2m`, in seconds; more than 0, at most a year.
[[nodiscard]] double parse_duration(std::string_view option, std::string_view text);

/// `A:B`, the whole numbers from A to B - 1, of which there is at least one.
[[nodiscard]] SampleRange parse_range(std::string_view option, std::string_view text);

struct PartOfMany {
    std::uint32_t part = 1;  ///< 1 to `parts`
    std::uint32_t parts = 1;
};

/// `I/N`, part I of N, from 1 on.
[[nodiscard]] PartOfMany parse_part(std::string_view option, std::string_view text);

/// `A:B`, the frames from A to B - 1, of which there is at least one.
[[nodiscard]] FrameRange parse_frames(std::string_view option, std::string_view text);

/// `WxH` within the limits of a film.
[[nodiscard]] FilmSize parse_size(std::string_view option, std::string_view text);

/// The index in `names` of a name.
[[nodiscard]] std::size_t parse_name(std::string_view option, std::string_view text,
                                     std::span<const std::string_view> names);

/// A comma-separated list of distinct names, returned in the order of `names`.
[[nodiscard]] std::vector<std::string> parse_name_list(std::string_view option,
                                                       std::string_view text,
                                                       std::span<const std::string_view> names);

}  // namespace weft

#endif
