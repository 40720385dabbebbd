// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_ACCESSOR_H
#define WEFT_SCENE_GLTF_GLTF_ACCESSOR_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "base/json_value.h"

namespace weft {

class GltfData;

/// The numbers that glTF component types stand for.
enum class GltfComponent : std::uint32_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126,
};

/// Random access to a checked glTF accessor of scalars, vectors or 4x4 matrices. After construction
/// every element below count() can be read without further checks.
class GltfAccessor {
  public:
    /// Checks `value`, an element of `/accessors`. Throws Error (exit code 2).
    GltfAccessor(GltfData& data, const JsonValue& value);

    [[nodiscard]] std::size_t count() const { return count_; }
    /// Components of an element: 1 (SCALAR) to 4 (VEC4), or 16 (MAT4, by columns).
    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] GltfComponent component() const { return component_; }
    [[nodiscard]] bool normalized() const { return normalized_; }
    [[nodiscard]] const std::string& place() const { return place_; }

    /// Writes width() components of element `index`, normalized integers decoded to [0,1] or
    /// [-1,1]. `to` holds at least width() numbers.
    void read(std::size_t index, std::span<float> to) const;

    /// First component of element `index` of an unsigned integer accessor, as it is.
    [[nodiscard]] std::uint32_t read_index(std::size_t index) const;

  private:
    void read_sparse(GltfData& data, const JsonValue& sparse);
    [[nodiscard]] const std::byte* element(std::size_t index) const;

    std::string place_;
    GltfComponent component_ = GltfComponent::float32;
    std::size_t width_ = 1;
    std::size_t count_ = 0;
    std::size_t stride_ = 0;
    bool normalized_ = false;
    std::span<const std::byte> bytes_;  ///< empty: all zero
    GltfComponent sparse_type_ = GltfComponent::uint32;
    std::span<const std::byte> sparse_indices_;
    std::span<const std::byte> sparse_values_;
    std::size_t sparse_count_ = 0;
};

}  // namespace weft

#endif
