// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_DOCUMENT_H
#define WEFT_SCENE_GLTF_GLTF_DOCUMENT_H

#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/json_value.h"

namespace weft {

/// A `.gltf` or `.glb` file split into JSON and binary data, which are not interpreted yet.
struct GltfDocument {
    std::filesystem::path path;
    std::vector<std::byte> file;  ///< all bytes of a binary file, else empty
    std::shared_ptr<const nlohmann::json> json;
    std::optional<std::span<const std::byte>> binary_chunk;  ///< inside `file`

    /// The top-level object.
    [[nodiscard]] JsonValue root() const;
};

/// Reads the file, checks the chunks of a binary one, bounds nesting and number of JSON values
/// before parsing, and checks `asset/version`. Throws Error (exit code 2).
[[nodiscard]] GltfDocument read_gltf_document(const std::filesystem::path& path);

}  // namespace weft

#endif
