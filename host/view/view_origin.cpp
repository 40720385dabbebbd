// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_origin.h"

#include <algorithm>
#include <array>

namespace weft {

bool is_own_host(std::string_view host) {
    constexpr std::array<std::string_view, 3> names = {"localhost", "127.0.0.1", "[::1]"};
    return std::ranges::any_of(names, [&](std::string_view name) {
        if (!host.starts_with(name)) return false;
        std::string_view port = host.substr(name.size());
        if (port.empty()) return true;
        port.remove_prefix(1);
        constexpr std::size_t most_digits = 5;
        return host[name.size()] == ':' && !port.empty() && port.size() <= most_digits &&
               std::ranges::all_of(port, [](char c) { return c >= '0' && c <= '9'; });
    });
}

bool is_own_origin(std::string_view origin, std::string_view host) {
    constexpr std::string_view scheme = "http://";
    return origin.starts_with(scheme) && origin.substr(scheme.size()) == host;
}

}  // namespace weft
