// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_ORIGIN_H
#define WEFT_VIEW_VIEW_ORIGIN_H

#include <string_view>

namespace weft {

/// Whether a request's Host names this machine as the browser on it would: localhost, 127.0.0.1 or
/// [::1], with or without a port. Another name is that of a site whose name was made to lead here.
[[nodiscard]] bool is_own_host(std::string_view host);

/// Whether a WebSocket's Origin is the page that this Host serves: `http://` and the host. Pages of
/// other sites may open sockets to this machine, but browsers say whose page it is.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

}  // namespace weft

#endif
