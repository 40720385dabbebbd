// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_skin.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/finite.h"
#include "base/limits.h"
#include "scene/transform.h"

namespace weft {
namespace {

glm::dmat4 read_matrix(const JsonValue& reference, const GltfAccessor& accessor,
                       std::size_t index) {
    constexpr double tolerance = 1e-4;
    std::array<float, 16> values{};
    accessor.read(index, values);
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            matrix[column][row] =
                static_cast<double>(values[static_cast<std::size_t>(4 * column + row)]);
    const std::string name = "matrix " + std::to_string(index);
    if (!is_finite(matrix)) throw reference.error(name + " is not finite");
    for (int column = 0; column < 4; ++column) {
        const double expected = column == 3 ? 1.0 : 0.0;
        if (std::abs(matrix[column][3] - expected) > tolerance)
            throw reference.error(name + " is not affine, expected 0, 0, 0, 1 as its last row");
        matrix[column][3] = expected;
    }
    return matrix;
}

std::vector<glm::dmat4> read_inverse_bind(GltfData& data, const JsonValue& skin,
                                          std::size_t joints) {
    const std::optional<JsonValue> reference = skin.find("inverseBindMatrices");
    if (!reference) return std::vector<glm::dmat4>(joints, glm::dmat4(1.0));
    const GltfAccessor& accessor = data.accessor(*reference);
    if (accessor.width() != 16 || accessor.component() != GltfComponent::float32)
        throw reference->error("chooses an accessor that holds no matrices, expected MAT4 of 5126");
    if (accessor.count() < joints)
        throw reference->error("chooses " + std::to_string(accessor.count()) +
                               " matrices, expected one for each of " + std::to_string(joints) +
                               " joints");
    std::vector<glm::dmat4> matrices;
    matrices.reserve(joints);
    for (std::size_t i = 0; i < joints; ++i)
        matrices.push_back(read_matrix(*reference, accessor, i));
    return matrices;
}

}  // namespace

GltfSkins::GltfSkins(const GltfDocument& document, GltfData& data,
                     const std::vector<GltfNode>& nodes)
    : root_(document.root()), data_(data), nodes_(nodes) {}

const GltfSkin& GltfSkins::skin(const JsonValue& reference) {
    const std::size_t index = reference.as_index(root_.size_of("skins"), "skins");
    if (const auto known = known_.find(index); known != known_.end()) return known->second;
    return known_[index] = read(root_.at("skins").element(index), index);
}

std::vector<std::size_t> GltfSkins::read_joints(const JsonValue& value) {
    const std::size_t node_count = root_.size_of("nodes");
    if (positions_.empty()) {
        positions_.assign(node_count, GltfNode::none);
        for (std::size_t i = 0; i < nodes_.size(); ++i) positions_[nodes_[i].number] = i;
    }
    const JsonValue listed = value.at("joints");
    constexpr std::size_t most = std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1;
    if (listed.size() == 0 || listed.size() > most)
        throw listed.error("has " + std::to_string(listed.size()) + " elements, expected 1 to " +
                           std::to_string(most));
    if (listed.size() > limits::max_skin_joints - joints_read_)
        throw listed.error("brings the file above the limit of " +
                           std::to_string(limits::max_skin_joints) + " joints of skins");
    joints_read_ += listed.size();
    std::vector<std::size_t> joints;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const JsonValue reference = listed.element(i);
        const std::size_t node = reference.as_index(node_count, "nodes");
        const std::size_t position = positions_[node];
        if (position == GltfNode::none)
            throw reference.error("node " + std::to_string(node) +
                                  " is not part of the scene that is rendered");
        if (!is_finite(nodes_[position].to_world))
            throw reference.error("the transform of node " + std::to_string(node) +
                                  " to world space is not finite");
        joints.push_back(position);
    }
    if (const std::optional<JsonValue> skeleton = value.find("skeleton"))
        (void)skeleton->as_index(node_count, "nodes");
    return joints;
}

std::size_t GltfSkins::frame_of(const std::vector<std::size_t>& joints) const {
    const auto is_above = [&](std::size_t ancestor, std::size_t node) {
        while (node != GltfNode::none && node != ancestor) node = nodes_[node].parent;
        return node == ancestor;
    };
    std::size_t frame = nodes_[joints.front()].parent;
    for (const std::size_t joint : joints)
        while (frame != GltfNode::none && !is_above(frame, nodes_[joint].parent))
            frame = nodes_[frame].parent;
    return frame;
}

GltfSkin GltfSkins::read(const JsonValue& value, std::size_t number) {
    const std::vector<std::size_t> joints = read_joints(value);
    GltfSkin made;
    made.number = number;
    if (const std::size_t frame = frame_of(joints); frame != GltfNode::none) {
        made.to_world = nodes_[frame].to_world;
        made.motion = nodes_[frame].motion;
    }
    Skin& skin = made.skin;
    skin.frame = made.motion;
    skin.inverse_bind = read_inverse_bind(data_, value, joints.size());
    const glm::dmat4 to_frame = glm::inverse(made.to_world);
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const GltfNode& node = nodes_[joints[j]];
        made.at_rest.push_back(to_frame * node.to_world * skin.inverse_bind[j]);
        skin.joints.push_back(node.motion);
        made.moves = made.moves || node.motion.node != made.motion.node;
    }
    return made;
}

}  // namespace weft
