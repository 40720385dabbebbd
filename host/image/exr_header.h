// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_IMAGE_EXR_HEADER_H
#define WEFT_IMAGE_EXR_HEADER_H

#include <cstddef>
#include <span>
#include <string>

namespace weft {

/// Checks the first bytes of an OpenEXR file (at most limits::max_exr_header_bytes are read) before
/// the OpenEXR library gets them, so that it only gets single-part scan-line files of a size within
/// the limits and a compression that every version of the library knows, whose attributes lie
/// inside the file. Throws Error (exit code 2) that names `place`.
void check_exr_header(std::span<const std::byte> bytes, const std::string& place);

}  // namespace weft

#endif
