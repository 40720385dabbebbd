// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/tev_options.h"

#include <cstddef>
#include <limits>
#include <string>

#include "app/command_line.h"
#include "app/parse_values.h"
#include "base/error.h"
#include "base/quote.h"

namespace weft {
namespace {

constexpr const char* option = "--tev";

}  // namespace

void add_tev(CLI::App& render) {
    add_value(render, option, "HOST:PORT",
              "Shows the image in the viewer tev while it is rendered (port: 14158)");
}

std::optional<TevAddress> read_tev(const CLI::App& command) {
    const auto text = value_of(command, option);
    if (!text) return {};
    TevAddress address;
    address.host = *text;
    // An address of IPv6 has colons of its own, and stands in brackets where a port follows.
    const bool bracketed = text->starts_with('[');
    const std::size_t end = bracketed ? text->find(']') : text->find(':');
    const bool has_port = end != std::string::npos && text->rfind(':') == end + (bracketed ? 1 : 0);
    if (bracketed && end != std::string::npos) address.host = text->substr(1, end - 1);
    if (has_port) {
        if (!bracketed) address.host = text->substr(0, end);
        address.port =
            static_cast<std::uint16_t>(parse_unsigned(option, text->substr(text->rfind(':') + 1), 1,
                                                      std::numeric_limits<std::uint16_t>::max()));
    }
    const bool whole =
        !bracketed || (end != std::string::npos && (has_port || end + 1 == text->size()));
    if (address.host.empty() || !whole)
        throw usage_error(std::string(option) + ": " + quote(*text) +
                          " is not valid, expected HOST:PORT, such as localhost:14158");
    return address;
}

}  // namespace weft
