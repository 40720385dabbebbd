// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_GLTF_LIMB_H
#define WEFT_TESTS_TESTING_GLTF_LIMB_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/testing/gltf_builder.h"

namespace weft::test {

/// A strip in the plane z = 0 from y = 0 to 2, two vertices at each of y = 0, 1 and 2, x = 0 and 1.
/// Its lower end belongs to the joint "root" at y = 0, its upper end to the joint "tip" at y = 1,
/// and its middle half to each. The skeleton stands in the node "stand" at (0, 0, 5), and the node
/// of the mesh, "limb", elsewhere.
class Limb : public GltfBuilder {
  public:
    enum Accessors : std::size_t { positions, normals, joints, weights, matrices, indices };
    enum Nodes : std::size_t { limb, stand, root, tip };

    Limb() {
        add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0}, "VEC3", 3);
        add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
        add_accessor<std::uint8_t>(
            {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5121, "VEC4",
            6);
        add_floats(
            {1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
            "VEC4", 4);
        add_floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                    1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
                   "MAT4", 16);
        add_accessor<std::uint16_t>({0, 1, 3, 0, 3, 2, 2, 3, 5, 2, 5, 4}, 5123, "SCALAR", 12);
        json["meshes"] = {{{"primitives",
                            {{{"attributes",
                               {{"POSITION", positions},
                                {"NORMAL", normals},
                                {"JOINTS_0", joints},
                                {"WEIGHTS_0", weights}}},
                              {"indices", indices}}}}}};
        json["skins"] = {{{"joints", {root, tip}}, {"inverseBindMatrices", matrices}}};
        json["nodes"] = {{{"name", "limb"}, {"mesh", 0}, {"skin", 0}, {"translation", {7, 7, 7}}},
                         {{"name", "stand"}, {"children", {root}}, {"translation", {0, 0, 5}}},
                         {{"name", "root"}, {"children", {tip}}},
                         {{"name", "tip"}, {"translation", {0, 1, 0}}}};
        json["scenes"] = {{{"nodes", {limb, stand}}}};
        json["scene"] = 0;
    }

    /// Animates a property of a node, with values of `width` numbers.
    void animate(std::size_t node, const char* path, const std::vector<float>& times,
                 const std::vector<float>& values, const char* interpolation = "LINEAR") {
        const std::string name(path);
        const char* const type =
            name == "weights" ? "SCALAR" : (name == "rotation" ? "VEC4" : "VEC3");
        const std::size_t width = name == "weights" ? 1 : (name == "rotation" ? 4 : 3);
        const std::size_t input = add_floats(times, "SCALAR", 1);
        const std::size_t output = add_floats(values, type, width);
        nlohmann::json& animation = json["animations"][0];
        animation["samplers"].push_back(
            {{"input", input}, {"output", output}, {"interpolation", interpolation}});
        animation["channels"].push_back({{"sampler", animation["samplers"].size() - 1},
                                         {"target", {{"node", node}, {"path", path}}}});
    }
};

}  // namespace weft::test

#endif
