// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_accessor.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "base/limits.h"
#include "base/quote.h"
#include "scene/gltf/gltf_data.h"

namespace weft {
namespace {

template <typename T>
T load(const std::byte* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

std::size_t component_size(GltfComponent type) {
    switch (type) {
        case GltfComponent::int8:
        case GltfComponent::uint8:
            return 1;
        case GltfComponent::int16:
        case GltfComponent::uint16:
            return 2;
        case GltfComponent::uint32:
        case GltfComponent::float32:
            break;
    }
    return 4;
}

GltfComponent component_type(const JsonValue& value) {
    const std::uint64_t code = value.as_integer();
    constexpr std::array known = {GltfComponent::int8,   GltfComponent::uint8,
                                  GltfComponent::int16,  GltfComponent::uint16,
                                  GltfComponent::uint32, GltfComponent::float32};
    for (const GltfComponent type : known)
        if (static_cast<std::uint32_t>(type) == code) return type;
    throw value.error("is " + std::to_string(code) +
                      ", expected 5120, 5121, 5122, 5123, 5125 or 5126");
}

std::size_t element_width(const JsonValue& value) {
    const std::string& name = value.as_string();
    if (name == "SCALAR") return 1;
    if (name == "VEC2") return 2;
    if (name == "VEC3") return 3;
    if (name == "VEC4") return 4;
    if (name == "MAT4") return 16;
    throw value.error("is " + quote(name) + ", expected SCALAR, VEC2, VEC3, VEC4 or MAT4");
}

std::uint32_t load_index(GltfComponent type, const std::byte* from) {
    if (type == GltfComponent::uint8) return load<std::uint8_t>(from);
    if (type == GltfComponent::uint16) return load<std::uint16_t>(from);
    return load<std::uint32_t>(from);
}

template <typename T>
float load_integer(const std::byte* from, bool normalized) {
    const auto value = static_cast<float>(load<T>(from));
    if (!normalized) return value;
    return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

float load_component(GltfComponent type, bool normalized, const std::byte* from) {
    switch (type) {
        case GltfComponent::int8:
            return load_integer<std::int8_t>(from, normalized);
        case GltfComponent::uint8:
            return load_integer<std::uint8_t>(from, normalized);
        case GltfComponent::int16:
            return load_integer<std::int16_t>(from, normalized);
        case GltfComponent::uint16:
            return load_integer<std::uint16_t>(from, normalized);
        case GltfComponent::uint32:
            return load_integer<std::uint32_t>(from, normalized);
        case GltfComponent::float32:
            break;
    }
    return load<float>(from);
}

/// The part of a view that holds `count` elements of `size` bytes, `stride` apart. `count` is at
/// most `max_vertices` and `stride` at most 252, so nothing here can overflow.
std::span<const std::byte> cut(const GltfBufferView& view, std::size_t offset, std::size_t count,
                               std::size_t size, std::size_t stride, const JsonValue& value) {
    const std::size_t length = (count - 1) * stride + size;
    if (offset > view.bytes.size() || length > view.bytes.size() - offset)
        throw value.error("needs " + std::to_string(length) + " bytes from byte " +
                          std::to_string(offset) + ", but the bufferView has only " +
                          std::to_string(view.bytes.size()));
    return view.bytes.subspan(offset, length);
}

std::size_t checked_count(const JsonValue& value, std::size_t largest) {
    const std::uint64_t count = value.as_integer();
    if (count == 0 || count > largest)
        throw value.error("is " + std::to_string(count) + ", expected 1 to " +
                          std::to_string(largest));
    return static_cast<std::size_t>(count);
}

}  // namespace

GltfAccessor::GltfAccessor(GltfData& data, const JsonValue& value) : place_(value.place()) {
    component_ = component_type(value.at("componentType"));
    width_ = element_width(value.at("type"));
    normalized_ = value.bool_or("normalized", false);
    const std::optional<JsonValue> view_reference = value.find("bufferView");
    count_ = checked_count(value.at("count"),
                           view_reference ? limits::max_vertices : limits::max_implicit_elements);
    const std::size_t size = width_ * component_size(component_);
    stride_ = size;
    if (view_reference) {
        const GltfBufferView view = data.view(*view_reference);
        if (view.stride != 0 && view.stride < size)
            throw value.error("has elements of " + std::to_string(size) +
                              " bytes, but its bufferView has a byteStride of " +
                              std::to_string(view.stride));
        if (view.stride != 0) stride_ = view.stride;
        bytes_ = cut(view, static_cast<std::size_t>(value.integer_or("byteOffset", 0)), count_,
                     size, stride_, value);
    }
    if (const std::optional<JsonValue> sparse = value.find("sparse")) read_sparse(data, *sparse);
}

void GltfAccessor::read_sparse(GltfData& data, const JsonValue& sparse) {
    sparse_count_ = checked_count(sparse.at("count"), count_);
    const JsonValue indices = sparse.at("indices");
    const JsonValue values = sparse.at("values");
    const JsonValue type = indices.at("componentType");
    sparse_type_ = component_type(type);
    if (sparse_type_ != GltfComponent::uint8 && sparse_type_ != GltfComponent::uint16 &&
        sparse_type_ != GltfComponent::uint32)
        throw type.error("is not an unsigned integer, expected 5121, 5123 or 5125");
    const std::size_t index_size = component_size(sparse_type_);
    const std::size_t value_size = width_ * component_size(component_);
    sparse_indices_ = cut(data.view(indices.at("bufferView")),
                          static_cast<std::size_t>(indices.integer_or("byteOffset", 0)),
                          sparse_count_, index_size, index_size, indices);
    sparse_values_ = cut(data.view(values.at("bufferView")),
                         static_cast<std::size_t>(values.integer_or("byteOffset", 0)),
                         sparse_count_, value_size, value_size, values);
    for (std::size_t i = 0; i < sparse_count_; ++i) {
        const std::uint32_t index =
            load_index(sparse_type_, sparse_indices_.data() + i * index_size);
        if (index >= count_)
            throw indices.error("index " + std::to_string(index) + " of element " +
                                std::to_string(i) + " is out of range, expected below " +
                                std::to_string(count_));
        if (i > 0 &&
            index <= load_index(sparse_type_, sparse_indices_.data() + (i - 1) * index_size))
            throw indices.error("element " + std::to_string(i) +
                                " does not increase, expected strictly increasing indices");
    }
}

const std::byte* GltfAccessor::element(std::size_t index) const {
    const std::size_t index_size = component_size(sparse_type_);
    std::size_t low = 0;
    std::size_t high = sparse_count_;
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        const std::uint32_t at =
            load_index(sparse_type_, sparse_indices_.data() + middle * index_size);
        if (at == index)
            return sparse_values_.data() + middle * width_ * component_size(component_);
        if (at < index)
            low = middle + 1;
        else
            high = middle;
    }
    return bytes_.empty() ? nullptr : bytes_.data() + index * stride_;
}

void GltfAccessor::read(std::size_t index, std::span<float> to) const {
    const std::byte* from = element(index);
    const std::size_t size = component_size(component_);
    for (std::size_t i = 0; i < width_; ++i)
        to[i] = from == nullptr ? 0.0F : load_component(component_, normalized_, from + i * size);
}

std::uint32_t GltfAccessor::read_index(std::size_t index) const {
    const std::byte* from = element(index);
    return from == nullptr ? 0U : load_index(component_, from);
}

}  // namespace weft
