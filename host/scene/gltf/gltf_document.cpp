// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_document.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "base/json_text.h"
#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

// glTF is little-endian and its bytes are copied straight into numbers.
static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t glb_magic = 0x46546C67;     // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942;  // "BIN\0"
constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_header_size = 8;

std::uint32_t load_word(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Walks the text once without recursion, so that neither the parser nor the tree it makes can
/// exhaust stack or memory.
void check_extent(const std::filesystem::path& path, std::string_view text) {
    int depth = 0;
    std::size_t values = 1;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                in_string = false;
            continue;
        }
        if (c == '"') in_string = true;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (c == '[' || c == '{' || c == ',') ++values;
        if (depth > limits::max_nesting)
            throw input_error(
                line_place(path.string(), text, i),
                "JSON is nested deeper than " + std::to_string(limits::max_nesting) + " levels");
        if (values > limits::max_json_values)
            throw input_error(
                line_place(path.string(), text, i),
                "JSON holds more than " + std::to_string(limits::max_json_values) + " values");
    }
}

nlohmann::json parse(const std::filesystem::path& path, std::string_view text) {
    check_extent(path, text);
    try {
        return nlohmann::json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t byte = error.byte > 0 ? error.byte - 1 : 0;
        const std::string_view before = text.substr(0, std::min(byte, text.size()));
        const std::size_t newline = before.rfind('\n');
        const std::size_t column =
            before.size() - (newline == std::string_view::npos ? 0 : newline + 1) + 1;
        throw input_error(line_place(path.string(), text, byte),
                          "JSON syntax error at column " + std::to_string(column));
    } catch (const nlohmann::json::exception&) {
        throw number_too_large(path.string(), text);
    }
}

struct Chunks {
    std::span<const std::byte> json;
    std::optional<std::span<const std::byte>> binary;
};

Chunks split_chunks(const std::filesystem::path& path, std::span<const std::byte> file) {
    const auto fail = [&](const std::string& message) {
        return input_error(path.string(), "binary glTF " + message);
    };
    if (file.size() < header_size) throw fail("is shorter than its 12 byte header");
    if (load_word(file, 4) != 2)
        throw fail("has container version " + std::to_string(load_word(file, 4)) + ", expected 2");
    const std::size_t length = load_word(file, 8);
    if (length < header_size || length > file.size())
        throw fail("states a length of " + std::to_string(length) + " bytes, but the file has " +
                   std::to_string(file.size()));
    Chunks chunks;
    std::size_t offset = header_size;
    for (std::size_t number = 0; offset < length; ++number) {
        if (length - offset < chunk_header_size)
            throw fail("ends inside the header of chunk " + std::to_string(number));
        const std::size_t size = load_word(file, offset);
        const std::uint32_t type = load_word(file, offset + 4);
        offset += chunk_header_size;
        if (size > length - offset)
            throw fail("chunk " + std::to_string(number) + " of " + std::to_string(size) +
                       " bytes does not fit into the " + std::to_string(length - offset) +
                       " bytes left");
        if ((number == 0) != (type == json_chunk))
            throw fail("expected one JSON chunk, as the first");
        if (type == json_chunk) chunks.json = file.subspan(offset, size);
        if (type == binary_chunk && !chunks.binary) chunks.binary = file.subspan(offset, size);
        offset += size;
    }
    if (chunks.json.empty()) throw fail("holds no JSON chunk");
    if (chunks.json.size() > limits::max_text_file_bytes)
        throw fail("has a JSON chunk longer than the limit of " +
                   std::to_string(limits::max_text_file_bytes) + " bytes");
    return chunks;
}

void check_version(const JsonValue& root) {
    const JsonValue asset = root.at("asset");
    const JsonValue version = asset.at("version");
    const std::string& text = version.as_string();
    if (text.substr(0, text.find('.')) != "2")
        throw version.error("glTF version " + quote(text) + ", expected 2.0");
    const std::optional<JsonValue> minimum = asset.find("minVersion");
    if (minimum && minimum->as_string() != "2.0")
        throw minimum->error("needs glTF version " + quote(minimum->as_string()) +
                             " or later, expected 2.0");
}

}  // namespace

JsonValue GltfDocument::root() const {
    return {*json, path.string() + "#"};
}

GltfDocument read_gltf_document(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    GltfDocument document;
    document.path = path;
    document.file = read_file(
        path, extension == ".glb" ? limits::max_binary_file_bytes : limits::max_text_file_bytes);
    const bool is_binary =
        document.file.size() >= sizeof glb_magic && load_word(document.file, 0) == glb_magic;
    if (extension == ".glb" && !is_binary)
        throw input_error(path.string(), "does not start with 'glTF', expected binary glTF");
    if (is_binary) {
        const Chunks chunks = split_chunks(path, document.file);
        document.json = std::make_shared<nlohmann::json>(parse(path, as_text(chunks.json)));
        document.binary_chunk = chunks.binary;
    } else {
        document.json = std::make_shared<nlohmann::json>(parse(path, as_text(document.file)));
        document.file = {};
    }
    check_version(document.root());
    return document;
}

}  // namespace weft
