// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_DATA_H
#define WEFT_SCENE_GLTF_GLTF_DATA_H

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "scene/gltf/gltf_accessor.h"
#include "scene/gltf/gltf_document.h"

namespace weft {

/// Bytes of a bufferView; `stride` is 0 where the file gives none.
struct GltfBufferView {
    std::span<const std::byte> bytes;
    std::size_t stride = 0;
};

/// The buffers, buffer views and accessors of a document, each read and checked at its first use.
/// Everything it returns stays valid as long as it lives.
class GltfData {
  public:
    explicit GltfData(const GltfDocument& document);

    /// The bufferView whose index `reference` holds.
    [[nodiscard]] GltfBufferView view(const JsonValue& reference);

    /// The accessor whose index `reference` holds.
    [[nodiscard]] const GltfAccessor& accessor(const JsonValue& reference);

    /// Bytes of an `uri` (data URI or file beside the document), at most `max_bytes`.
    [[nodiscard]] std::vector<std::byte> read_uri(const JsonValue& uri,
                                                  std::size_t max_bytes) const;

  private:
    [[nodiscard]] std::span<const std::byte> buffer(const JsonValue& reference);

    const GltfDocument& document_;
    JsonValue root_;
    std::size_t bytes_read_ = 0;
    std::map<std::size_t, std::vector<std::byte>> storage_;
    std::map<std::size_t, std::span<const std::byte>> buffers_;
    std::map<std::size_t, std::unique_ptr<GltfAccessor>> accessors_;
};

}  // namespace weft

#endif
