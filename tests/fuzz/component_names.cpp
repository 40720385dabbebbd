// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The names that reading options asks for. The list of components itself (components.def) brings
// kernels and devices, which no reader needs; options_fuzz only needs names of both kinds.
#include "components/component.h"

namespace weft {

std::vector<std::string_view> choosable_components(Choice choice) {
    if (choice == Choice::by_default)
        return {"direct", "indirect", "reflection", "refraction", "glossy", "media"};
    return {"occlusion"};
}

std::vector<std::string_view> choosable_components() {
    return {"direct", "indirect", "reflection", "refraction", "glossy", "media", "occlusion"};
}

}  // namespace weft
