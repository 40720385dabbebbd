// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_page.h"

namespace weft {
namespace {

constexpr std::string_view page =
#include "index.html.inc"
    ;
constexpr std::string_view style =
#include "view.css.inc"
    ;
constexpr std::string_view program =
#include "view.js.inc"
    ;

}  // namespace

std::optional<ViewFile> view_file(std::string_view path) {
    if (path == "/") return ViewFile{"text/html; charset=utf-8", page};
    if (path == "/view.css") return ViewFile{"text/css; charset=utf-8", style};
    if (path == "/view.js") return ViewFile{"text/javascript; charset=utf-8", program};
    return {};
}

}  // namespace weft
