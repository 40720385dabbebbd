// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_PAGE_H
#define WEFT_VIEW_VIEW_PAGE_H

#include <optional>
#include <string_view>

namespace weft {

/// A file of the page that a browser shows.
struct ViewFile {
    std::string_view type;  ///< its media type
    std::string_view text;
};

/// The file at a path such as `/view.js`; none where there is no such file.
[[nodiscard]] std::optional<ViewFile> view_file(std::string_view path);

}  // namespace weft

#endif
