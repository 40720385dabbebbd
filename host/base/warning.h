// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_WARNING_H
#define WEFT_BASE_WARNING_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// What a warning counts, such as {"material", "materials"}. Both refer to literals; empty where
/// there is nothing to count.
struct WarningUnit {
    std::string_view one;
    std::string_view many;
};

/// One kind of warning, with every place where it applies.
struct Warning {
    /// A place, such as `file:line` or `file#/nodes/3`, and how many units it has. The text may be
    /// empty, and may hold any bytes except control characters.
    struct Place {
        std::string text;
        std::size_t number = 1;
    };

    std::string message;  ///< one line without place and number
    WarningUnit unit{};
    bool of_file = false;  ///< names what the image lacks of what a scene file asks for
    std::size_t number = 0;
    std::vector<Place> places;        ///< in order; those that there is room for
    std::size_t places_left_out = 0;  ///< those that there was no room for
};

/// The most characters of a line of standard error that holds a warning.
inline constexpr std::size_t longest_warning_line = 160;

/// `3 materials: message; first: place` or, without a unit, `place: message`. Has at most
/// `longest` characters, for which places lose folders, then quoted names and file names lose
/// their middle, and at last the place is left out. Only a message that is longer without its
/// quoted names makes a longer line.
[[nodiscard]] std::string warning_line(const Warning& warning,
                                       std::size_t longest = std::string::npos);

/// The message with its number, then every place, one line each; one line where there is one place.
[[nodiscard]] std::vector<std::string> warning_details(const Warning& warning);

/// What is not as the file says, in few words: the message up to its first comma outside of quotes.
[[nodiscard]] std::string warning_title(const Warning& warning);

}  // namespace weft

#endif
