// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_GLTF_BUILDER_H
#define WEFT_TESTS_TESTING_GLTF_BUILDER_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/error.h"
#include "scene/gltf/gltf_reader.h"
#include "scene/validate_scene.h"
#include "tests/testing/temporary_folder.h"

namespace weft {

inline std::string encode_base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits =
                bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63U];
    }
    return text;
}

/// Builds small glTF files, right or wrong. `json` may be changed at will before reading.
class GltfBuilder {
  public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::string binary;
    std::map<std::string, std::string> files;  ///< beside the scene, for read()

    /// Appends numbers as a new bufferView with a new accessor, and returns the accessor's index.
    template <typename T>
    std::size_t add_accessor(const std::vector<T>& numbers, int component_type, const char* type,
                             std::size_t count) {
        json["accessors"].push_back({{"bufferView", add_view(numbers)},
                                     {"componentType", component_type},
                                     {"type", type},
                                     {"count", count}});
        return json["accessors"].size() - 1;
    }

    std::size_t add_floats(const std::vector<float>& numbers, const char* type, std::size_t width) {
        return add_accessor(numbers, 5126, type, numbers.size() / width);
    }

    /// Appends numbers as a new bufferView, and returns its index.
    template <typename T>
    std::size_t add_view(const std::vector<T>& numbers) {
        binary.resize((binary.size() + 3) / 4 * 4);
        const std::size_t offset = binary.size();
        const std::size_t length = numbers.size() * sizeof(T);
        binary.resize(offset + length);
        std::memcpy(binary.data() + offset, numbers.data(), length);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
        return json["bufferViews"].size() - 1;
    }

    /// One mesh of one triangle (0,0,0) (1,0,0) (0,1,0), in one node of one scene.
    static GltfBuilder triangle() {
        GltfBuilder builder;
        builder.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
        builder.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
        builder.json["nodes"] = {{{"mesh", 0}}};
        builder.json["scenes"] = {{{"nodes", {0}}}};
        builder.json["scene"] = 0;
        return builder;
    }

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

    [[nodiscard]] std::string text() const {
        nlohmann::json complete = json;
        if (!complete.contains("buffers") && !binary.empty())
            complete["buffers"] = {
                {{"byteLength", binary.size()},
                 {"uri", "data:application/octet-stream;base64," + encode_base64(binary)}}};
        return complete.dump();
    }

    /// Reads and validates what was built; warnings go to `diagnostics`.
    Scene read(MaterialDetail detail = MaterialDetail::full) {
        const TemporaryFolder folder;
        for (const auto& [name, content] : files) folder.write(name, content);
        diagnostics = {};
        Scene scene = read_gltf(folder.write("scene.gltf", text()), diagnostics, detail);
        validate_scene(scene);
        return scene;
    }

    /// The error that reading gives, from the `#` of its place on, or "no error".
    std::string error() { return error_of("scene.gltf", text()); }

    static std::string error_of(const std::string& name, std::string_view content) {
        const TemporaryFolder folder;
        Diagnostics ignored;
        try {
            validate_scene(read_gltf(folder.write(name, content), ignored));
        } catch (const Error& error) {
            if (error.code() != ExitCode::bad_input) return "wrong exit code";
            const std::string path = (folder.path() / name).string();
            const std::string message = error.what();
            return message.rfind(path, 0) == 0 ? message.substr(path.size()) : message;
        }
        return "no error";
    }

    /// Whether some warning of the last read() holds `text`.
    [[nodiscard]] bool warned(std::string_view text) const {
        for (const std::string& warning : diagnostics.warnings())
            if (warning.find(text) != std::string::npos) return true;
        return false;
    }

    /// Whether some warning of the last read() is `message`, first at the place that ends so.
    [[nodiscard]] bool warned_at(std::string_view place, std::string_view message) const {
        const std::vector<Warning>& list = diagnostics.list();
        return std::any_of(list.begin(), list.end(), [&](const Warning& warning) {
            return warning.message == message && warning.places.front().text.ends_with(place);
        });
    }

    Diagnostics diagnostics;
};

}  // namespace weft

#endif
