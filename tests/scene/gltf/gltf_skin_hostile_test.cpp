// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/base64.h"
#include "tests/testing/gltf_limb.h"

// Skins of files that mean harm, or are badly made.
namespace weft::gltf_skin_hostile_test {
namespace {

using test::Limb;
using Json = nlohmann::json;

TEST(GltfSkinHostile, RefusesMoreWorkThanFilesMayAskFor) {
    // Few bytes, but 16384 targets with weights for each of 2048 nodes with skins of their own.
    Limb limb;
    const std::size_t targets = 16384;
    const std::size_t nodes = 2048;
    Json listed = Json::array();
    for (std::size_t i = 0; i < targets; ++i)
        listed.push_back(Json({{"POSITION", std::size_t{Limb::positions}}}));
    limb.primitive()["targets"] = listed;
    limb.json["meshes"][0]["weights"] = std::vector<double>(targets, 1.0);
    limb.animate(Limb::root, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    for (std::size_t i = 0; i < nodes; ++i) {
        limb.json["skins"].push_back(limb.json["skins"][0]);
        limb.json["scenes"][0]["nodes"].push_back(limb.json["nodes"].size());
        limb.json["nodes"].push_back({{"mesh", 0}, {"skin", i + 1}});
    }
    EXPECT_NE(limb.error().find("brings the file above the limit of 2147483648 displacements"),
              std::string::npos);
}

TEST(GltfSkinHostile, EveryValueOfAnotherTypeIsReadOrRefused) {
    Limb limb;
    limb.animate(Limb::tip, "scale", {0, 1}, {1, 1, 1, 2, 2, 2});
    limb.json["buffers"] = {{{"byteLength", limb.binary.size()},
                             {"uri", "data:;base64," + encode_base64(limb.binary)}}};
    const std::vector<Json> values = {nullptr, true, -1, 0, 1e308, Json::array(), 4294967295U};
    for (const char* part : {"skins", "nodes", "meshes", "accessors"}) {
        const Json flat = limb.json[part].flatten();
        for (const auto& [pointer, original] : flat.items())
            for (const Json& value : values) {
                Limb changed = limb;
                changed.json[part][Json::json_pointer(pointer)] = value;
                EXPECT_NE(changed.error(), "wrong exit code") << part << pointer << ' ' << value;
            }
    }
}

}  // namespace
}  // namespace weft::gltf_skin_hostile_test
