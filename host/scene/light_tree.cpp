// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>

namespace weft {
namespace {

using shared::LightNode;
using shared::LightRecord;

glm::dvec3 xyz(const shared::float4& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The smallest float that is not below `x`.
float rounded_up(double x) {
    const auto nearest = static_cast<float>(x);
    return static_cast<double>(nearest) < x
               ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
               : nearest;
}

bool is_distant(const LightNode& node) {
    return node.shape == LIGHT_DISTANT || node.shape == LIGHT_ALL_DISTANT ||
           node.shape == LIGHT_ALL_AROUND;
}

LightNode leaf(const LightRecord& light, float intensity) {
    LightNode node{};
    node.position = light.position;
    node.axis = light.axis;
    node.intensity = intensity;
    const bool flat = xyz(light.axis) != glm::dvec3(0.0);
    switch (light.kind) {
        case EMITTER_AREA:
            node.shape = LIGHT_BALL;
            if (flat) node.shape = light.both_sides != 0 ? LIGHT_TWO_SIDED_PANEL : LIGHT_PANEL;
            // Corners of a panel are in one plane but for rounding.
            node.axis.w = node.position.w * 0x1p-20F;
            break;
        case EMITTER_DIRECTIONAL:
            node.shape = LIGHT_DISTANT;
            break;
        case EMITTER_ENVIRONMENT:
            node.shape = LIGHT_ALL_AROUND;
            break;
        case EMITTER_SPOT:
            node.shape = LIGHT_SPOT;
            // The same edge in another order of operations.
            node.axis.w = light.cos_outer - 0x1p-20F;
            break;
        default:
            node.shape = LIGHT_BALL;
            break;
    }
    if (light.kind != EMITTER_AREA) node.position.w = 0.0F;
    return node;
}

/// A node that stands for all of these, of which all are distant or none is; but for the root,
/// whose own bounds are never asked for.
LightNode enclosing(std::span<const LightNode> nodes) {
    LightNode all{};
    double intensity = 0.0;
    for (const LightNode& node : nodes) intensity += static_cast<double>(node.intensity);
    all.intensity = static_cast<float>(intensity);
    if (is_distant(nodes.front())) {
        all.shape = LIGHT_ALL_DISTANT;
        return all;
    }
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    bool same_axis = true;
    for (const LightNode& node : nodes) {
        low = glm::min(low, xyz(node.position));
        high = glm::max(high, xyz(node.position));
        same_axis =
            same_axis && node.shape == LIGHT_PANEL && xyz(node.axis) == xyz(nodes.front().axis);
    }
    const auto middle = glm::vec3(0.5 * (low + high));
    all.position = {middle.x, middle.y, middle.z, 0.0F};
    all.shape = same_axis ? LIGHT_PANEL : LIGHT_BALL;
    if (same_axis) all.axis = nodes.front().axis;
    double radius = 0.0;
    double height = 0.0;
    for (const LightNode& node : nodes) {
        const glm::dvec3 away = xyz(node.position) - glm::dvec3(middle);
        radius = std::max(radius, glm::length(away) + static_cast<double>(node.position.w));
        height = std::max(height, glm::dot(away, xyz(all.axis)) + static_cast<double>(node.axis.w));
    }
    all.position.w = rounded_up(radius);
    all.axis.w = same_axis ? rounded_up(height) : 0.0F;
    return all;
}

/// Builds the nodes below some leaves.
class Builder {
  public:
    Builder(std::span<LightRecord> lights, std::span<const LightNode> leaves)
        : lights_(lights), leaves_(leaves) {
        nodes_.emplace_back();
    }

    /// Fills node `at` so that it stands for these lights.
    void fill(std::size_t at, std::span<std::uint32_t> of) {
        const std::uint32_t parent = nodes_[at].parent;
        if (of.size() == 1) {
            nodes_[at] = leaves_[of[0]];
            nodes_[at].first = of[0];
            lights_[of[0]].node = static_cast<std::uint32_t>(at);
        } else {
            const std::size_t first = nodes_.size();
            const std::vector<std::span<std::uint32_t>> groups = split(of);
            nodes_.resize(first + groups.size());
            for (std::size_t i = 0; i < groups.size(); ++i) {
                nodes_[first + i].parent = static_cast<std::uint32_t>(at);
                fill(first + i, groups[i]);
            }
            nodes_[at] = enclosing(std::span(nodes_).subspan(first, groups.size()));
            nodes_[at].first = static_cast<std::uint32_t>(first);
            nodes_[at].count = static_cast<std::uint32_t>(groups.size());
        }
        nodes_[at].parent = parent;
    }

    [[nodiscard]] std::vector<LightNode> take() { return std::move(nodes_); }

  private:
    /// Cuts lights into up to LIGHT_CHILDREN groups: the widest one in half, again and again.
    std::vector<std::span<std::uint32_t>> split(std::span<std::uint32_t> of) const {
        std::vector<std::span<std::uint32_t>> groups{of};
        while (groups.size() < LIGHT_CHILDREN) {
            const auto largest = std::max_element(
                groups.begin(), groups.end(), [](auto a, auto b) { return a.size() < b.size(); });
            if (largest->size() < 2) break;
            const std::span<std::uint32_t> group = *largest;
            const std::size_t half = cut(group);
            *largest = group.first(half);
            groups.insert(largest + 1, group.subspan(half));
        }
        return groups;
    }

    /// Orders lights so that the first ones, whose number is returned, are apart from the others.
    std::size_t cut(std::span<std::uint32_t> group) const {
        const auto distant = std::stable_partition(group.begin(), group.end(),
                                                   [&](auto i) { return !is_distant(leaves_[i]); });
        if (distant != group.begin() && distant != group.end())
            return static_cast<std::size_t>(distant - group.begin());
        glm::dvec3 low(std::numeric_limits<double>::infinity());
        glm::dvec3 high = -low;
        for (const std::uint32_t i : group) {
            low = glm::min(low, xyz(leaves_[i].position));
            high = glm::max(high, xyz(leaves_[i].position));
        }
        const glm::dvec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        std::stable_sort(group.begin(), group.end(), [&](std::uint32_t a, std::uint32_t b) {
            return xyz(leaves_[a].position)[axis] < xyz(leaves_[b].position)[axis];
        });
        return group.size() / 2;
    }

    std::span<LightRecord> lights_;
    std::span<const LightNode> leaves_;
    std::vector<LightNode> nodes_;
};

}  // namespace

std::vector<LightNode> build_light_tree(std::span<LightRecord> lights,
                                        std::span<const double> intensities) {
    // Relative to the brightest one, so that sums and squares of distances fit a float.
    double most = 0.0;
    for (const double intensity : intensities) most = std::max(most, intensity);
    std::vector<LightNode> leaves;
    std::vector<std::uint32_t> order(lights.size());
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = 0; i < lights.size(); ++i)
        leaves.push_back(
            leaf(lights[i], most > 0.0 ? static_cast<float>(intensities[i] / most) : 1.0F));
    Builder builder(lights, leaves);
    builder.fill(0, order);
    return builder.take();
}

}  // namespace weft
