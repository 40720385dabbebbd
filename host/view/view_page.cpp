// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_page.h"

#include <array>

namespace weft {
namespace {

constexpr std::string_view html = "text/html; charset=utf-8";
constexpr std::string_view css = "text/css; charset=utf-8";
constexpr std::string_view svg = "image/svg+xml";
constexpr std::string_view javascript = "text/javascript; charset=utf-8";

struct PageFile {
    std::string_view path;
    ViewFile file;
};

constexpr std::array<PageFile, 8> files = {{
    {"/",
     {
         html,
#include "index.html.inc"
     }},
    {"/view.css",
     {
         css,
#include "view.css.inc"
     }},
    {"/view.svg",
     {
         svg,
#include "view.svg.inc"
     }},
    {"/view.js",
     {
         javascript,
#include "view.js.inc"
     }},
    {"/view_panes.js",
     {
         javascript,
#include "view_panes.js.inc"
     }},
    {"/view_edit.js",
     {
         javascript,
#include "view_edit.js.inc"
     }},
    {"/view_judge.js",
     {
         javascript,
#include "view_judge.js.inc"
     }},
    {"/view_start.js",
     {
         javascript,
#include "view_start.js.inc"
     }},
}};

}  // namespace

std::optional<ViewFile> view_file(std::string_view path) {
    for (const PageFile& known : files)
        if (known.path == path) return known.file;
    return {};
}

}  // namespace weft
