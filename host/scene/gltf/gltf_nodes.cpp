// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_nodes.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/finite.h"
#include "base/limits.h"
#include "scene/pose_json.h"
#include "scene/transform.h"

namespace weft {
namespace {

constexpr std::size_t no_parent = GltfNode::none;

/// Parent of every node. With at most one parent each, the nodes form trees and perhaps rings;
/// a ring is a part that no root leads to.
std::vector<std::size_t> find_parents(const JsonValue& root, std::size_t count) {
    std::vector<std::size_t> parents(count, no_parent);
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<JsonValue> children = root.at("nodes").element(i).find("children");
        for (std::size_t c = 0; children && c < children->size(); ++c) {
            const JsonValue reference = children->element(c);
            const std::size_t child = reference.as_index(count, "nodes");
            if (child == i)
                throw reference.error("node " + std::to_string(i) +
                                      " is its own child, expected no cycles");
            if (parents[child] != no_parent)
                throw reference.error("node " + std::to_string(child) + " is already a child of " +
                                      "node " + std::to_string(parents[child]) +
                                      ", expected one parent");
            parents[child] = i;
        }
    }
    return parents;
}

void refuse_rings(const JsonValue& root, const std::vector<std::size_t>& parents) {
    enum class Mark : unsigned char { fresh, on_path, done };
    std::vector<Mark> marks(parents.size(), Mark::fresh);
    for (std::size_t start = 0; start < parents.size(); ++start) {
        std::size_t node = start;
        while (node != no_parent && marks[node] == Mark::fresh) {
            marks[node] = Mark::on_path;
            node = parents[node];
        }
        if (node != no_parent && marks[node] == Mark::on_path)
            throw root.at("nodes").element(node).error(
                "node is its own ancestor, expected no cycles");
        for (node = start; node != no_parent && marks[node] == Mark::on_path; node = parents[node])
            marks[node] = Mark::done;
    }
}

std::vector<std::size_t> find_roots(const JsonValue& root, const std::vector<std::size_t>& parents,
                                    WarningCollector& report) {
    std::vector<std::size_t> roots;
    const std::size_t scene_count = root.size_of("scenes");
    const std::optional<JsonValue> chosen = root.find("scene");
    if (!chosen && scene_count == 0) {
        if (!parents.empty())
            report.once(root.place(), "file holds no scenes, all root nodes are rendered");
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] == no_parent) roots.push_back(i);
        return roots;
    }
    if (!chosen && scene_count > 1)
        report.once(root.place(), "file names no default scene, the first is rendered");
    const std::size_t scene = chosen ? chosen->as_index(scene_count, "scenes") : 0;
    const std::optional<JsonValue> listed = root.at("scenes").element(scene).find("nodes");
    std::vector<bool> seen(parents.size(), false);
    for (std::size_t i = 0; listed && i < listed->size(); ++i) {
        const JsonValue reference = listed->element(i);
        const std::size_t node = reference.as_index(parents.size(), "nodes");
        if (parents[node] != no_parent)
            throw reference.error("node " + std::to_string(node) + " is a child of node " +
                                  std::to_string(parents[node]) + ", expected a root node");
        if (seen[node]) throw reference.error("node " + std::to_string(node) + " is listed twice");
        seen[node] = true;
        roots.push_back(node);
    }
    return roots;
}

glm::dmat4 read_local_transform(const JsonValue& node) {
    if (!node.find("matrix")) return matrix_of(read_pose(node));
    for (const char* key : {"translation", "rotation", "scale"})
        if (node.find(key))
            throw node.error(std::string("has both 'matrix' and '") + key +
                             "', expected one of them");
    return read_matrix(node);
}

/// The attachment of the children of a node that is itself attached to `parent`. An animated node
/// becomes a moving node of its own.
Attachment attach(const JsonValue& node, const glm::dmat4& local, const Attachment& parent,
                  const GltfChannels& channels, Animation& animation) {
    if (!channels.move_node()) return {parent.node, parent.to_node * local};
    MovingNode moving;
    moving.parent = parent.node;
    moving.to_parent = parent.to_node;
    moving.rest = read_pose(node);
    moving.translation = channels.translation;
    moving.rotation = channels.rotation;
    moving.scale = channels.scale;
    animation.nodes.push_back(moving);
    return {static_cast<int>(animation.nodes.size() - 1), glm::dmat4(1.0)};
}

}  // namespace

std::vector<GltfNode> read_gltf_nodes(const GltfDocument& document,
                                      const GltfAnimatedNodes& animated, Animation& animation,
                                      WarningCollector& report) {
    const JsonValue root = document.root();
    const std::size_t count = root.size_of("nodes");
    if (count > limits::max_nodes)
        throw root.at("nodes").error("has " + std::to_string(count) +
                                     " elements, expected at most " +
                                     std::to_string(limits::max_nodes));
    const std::vector<std::size_t> parents = find_parents(root, count);
    refuse_rings(root, parents);
    const std::vector<std::size_t> roots = find_roots(root, parents, report);

    struct Pending {
        std::size_t node;
        std::size_t parent;  // index among the nodes that are done
        int depth;
    };
    std::vector<Pending> stack;
    for (auto node = roots.rbegin(); node != roots.rend(); ++node)
        stack.push_back({*node, GltfNode::none, 1});
    std::vector<GltfNode> nodes;
    while (!stack.empty()) {
        const Pending next = stack.back();
        stack.pop_back();
        GltfNode node{root.at("nodes").element(next.node), next.node, next.parent};
        if (next.depth > limits::max_nesting)
            throw node.value.error("node is nested deeper than " +
                                   std::to_string(limits::max_nesting) + " levels");
        node.name = node.value.name_or("");
        const bool is_root = next.parent == GltfNode::none;
        const glm::dmat4 local = read_local_transform(node.value);
        node.to_world = (is_root ? glm::dmat4(1.0) : nodes[next.parent].to_world) * local;
        const auto found = animated.find(next.node);
        const GltfChannels channels = found == animated.end() ? GltfChannels{} : found->second;
        node.motion = attach(node.value, local, is_root ? Attachment{} : nodes[next.parent].motion,
                             channels, animation);
        node.weights_track = channels.weights;
        const std::optional<JsonValue> children = node.value.find("children");
        for (std::size_t c = children ? children->size() : 0; c > 0; --c)
            stack.push_back(
                {children->element(c - 1).as_index(count, "nodes"), nodes.size(), next.depth + 1});
        nodes.push_back(std::move(node));
    }
    return nodes;
}

bool usable_transform(const glm::dmat4& to_world, const JsonValue& node, WarningCollector& report) {
    if (!is_finite(to_world)) throw node.error("the transform to world space is not finite");
    if (!is_singular(to_world)) return true;
    report.count(node.place(), {"node", "nodes"},
                 "the transform is singular (a scale of zero), the object is left out");
    return false;
}

}  // namespace weft
