// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_data.h"

#include <string>
#include <utility>

#include "base/base64.h"
#include "base/file.h"
#include "base/limits.h"

namespace weft {

GltfData::GltfData(const GltfDocument& document) : document_(document), root_(document.root()) {}

std::vector<std::byte> GltfData::read_uri(const JsonValue& uri, std::size_t max_bytes) const {
    const std::string& text = uri.as_string();
    if (text.rfind("data:", 0) != 0) {
        return read_file(resolve_reference(document_.path, text, uri.place(), true), max_bytes,
                         uri.place());
    }
    if (text.size() > limits::max_data_uri_bytes)
        throw uri.error("data URI is longer than the limit of " +
                        std::to_string(limits::max_data_uri_bytes) + " bytes");
    const std::size_t comma = text.find(',');
    constexpr std::string_view marker = ";base64";
    if (comma == std::string::npos || comma < marker.size() ||
        text.compare(comma - marker.size(), marker.size(), marker) != 0)
        throw uri.error("data URI is not base64 encoded, expected 'data:...;base64,...'");
    return decode_base64(std::string_view(text).substr(comma + 1), uri.place());
}

std::span<const std::byte> GltfData::buffer(const JsonValue& reference) {
    const std::size_t index = reference.as_index(root_.size_of("buffers"), "buffers");
    if (const auto known = buffers_.find(index); known != buffers_.end()) return known->second;
    const JsonValue value = root_.at("buffers").element(index);
    const JsonValue length_value = value.at("byteLength");
    const std::uint64_t length = length_value.as_integer();
    std::span<const std::byte> bytes;
    if (const std::optional<JsonValue> uri = value.find("uri")) {
        if (length > limits::max_binary_file_bytes - bytes_read_)
            throw length_value.error("all buffers together are longer than the limit of " +
                                     std::to_string(limits::max_binary_file_bytes) + " bytes");
        std::vector<std::byte>& stored = storage_[index];
        stored = read_uri(*uri, limits::max_binary_file_bytes - bytes_read_);
        bytes_read_ += stored.size();
        bytes = stored;
    } else if (index == 0 && document_.binary_chunk) {
        bytes = *document_.binary_chunk;
    } else {
        throw value.error("lacks 'uri', and there is no binary chunk that could stand for it");
    }
    if (bytes.size() < length)
        throw length_value.error("is " + std::to_string(length) + ", but the buffer has only " +
                                 std::to_string(bytes.size()) + " bytes");
    bytes = bytes.first(static_cast<std::size_t>(length));
    buffers_[index] = bytes;
    return bytes;
}

GltfBufferView GltfData::view(const JsonValue& reference) {
    const std::size_t index = reference.as_index(root_.size_of("bufferViews"), "bufferViews");
    const JsonValue value = root_.at("bufferViews").element(index);
    const std::span<const std::byte> bytes = buffer(value.at("buffer"));
    const std::uint64_t offset = value.integer_or("byteOffset", 0);
    const std::uint64_t length = value.at("byteLength").as_integer();
    if (offset > bytes.size() || length > bytes.size() - offset)
        throw value.error("covers bytes " + std::to_string(offset) + " to " +
                          std::to_string(offset + length) + ", but the buffer has only " +
                          std::to_string(bytes.size()));
    GltfBufferView view;
    view.bytes = bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
    if (const std::optional<JsonValue> stride = value.find("byteStride")) {
        view.stride = static_cast<std::size_t>(stride->as_integer());
        if (view.stride < 4 || view.stride > 252)
            throw stride->error("is " + std::to_string(view.stride) + ", expected 4 to 252");
    }
    return view;
}

const GltfAccessor& GltfData::accessor(const JsonValue& reference) {
    const std::size_t index = reference.as_index(root_.size_of("accessors"), "accessors");
    std::unique_ptr<GltfAccessor>& slot = accessors_[index];
    if (!slot) slot = std::make_unique<GltfAccessor>(*this, root_.at("accessors").element(index));
    return *slot;
}

}  // namespace weft
