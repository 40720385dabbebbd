// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/deformation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

#include "scene/scene.h"

namespace weft {
namespace {

struct Vertex {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};
    glm::dvec3 tangent{0.0};
};

/// A target whose weight is not 0.
struct ActiveTarget {
    const MorphTarget* target;
    double weight;
};

std::vector<ActiveTarget> active_targets(const MeshShape& shape, std::span<const double> weights) {
    std::vector<ActiveTarget> active;
    for (std::size_t t = 0; t < shape.targets.size(); ++t)
        if (weights[t] != 0.0) active.push_back({&shape.targets[t], weights[t]});
    return active;
}

Vertex morphed(const MeshShape& shape, std::span<const ActiveTarget> active, std::size_t index) {
    Vertex vertex{glm::dvec3(shape.positions[index]), {}};
    const bool has_normals = !shape.normals.empty();
    if (has_normals) vertex.normal = glm::dvec3(shape.normals[index]);
    if (!shape.tangents.empty()) vertex.tangent = glm::dvec3(shape.tangents[index]);
    for (const auto& [target, weight] : active) {
        if (!target->positions.empty())
            vertex.position += weight * glm::dvec3(target->positions[index]);
        if (has_normals && !target->normals.empty())
            vertex.normal += weight * glm::dvec3(target->normals[index]);
    }
    return vertex;
}

glm::dmat4 mean_matrix(const JointInfluences& influences, std::span<const glm::dmat4> joints,
                       std::size_t vertex) {
    glm::dmat4 mean(0.0);
    for (std::uint32_t i = 0; i < influences.width; ++i) {
        const std::size_t at = vertex * influences.width + i;
        // The index of a joint without weight may be invalid.
        if (influences.weights[at] != 0.0F)
            mean += static_cast<double>(influences.weights[at]) * joints[influences.joints[at]];
    }
    return mean;
}

/// Carries a vertex, and returns on which side of 0 the determinant lies.
int carry(const glm::dmat4& matrix, Vertex& vertex) {
    // The last component is the sum of the weights, which is 1 up to their rounding.
    const glm::dvec4 moved = matrix * glm::dvec4(vertex.position, 1.0);
    vertex.position = glm::dvec3(moved) / moved.w;
    // Cofactors are the inverse transpose up to a factor, and exist for singular matrices, too.
    const glm::dmat3 linear(matrix);
    const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                               glm::cross(linear[0], linear[1]));
    vertex.normal = cofactors * vertex.normal;
    vertex.tangent = linear * vertex.tangent;
    const double determinant = glm::dot(linear[0], cofactors[0]);
    return determinant > 0.0 ? 1 : (determinant < 0.0 ? -1 : 0);
}

/// Unit vector of any `v`, or 0.
glm::vec3 direction_of(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0) || !std::isfinite(glm::dot(v / largest, v / largest)))
        return glm::vec3(0.0F);
    return glm::vec3(glm::normalize(v / largest));
}

}  // namespace

std::vector<glm::dmat4> joint_matrices(const Skin& skin,
                                       std::span<const glm::dmat4> nodes_to_world) {
    const auto to_world = [&](const Attachment& attachment) {
        if (!attachment.moves()) return attachment.to_node;
        return nodes_to_world[static_cast<std::size_t>(attachment.node)] * attachment.to_node;
    };
    const glm::dmat4 to_frame = glm::inverse(to_world(skin.frame));
    std::vector<glm::dmat4> matrices;
    matrices.reserve(skin.joints.size());
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
        matrices.push_back(to_frame * to_world(skin.joints[j]) * skin.inverse_bind[j]);
    return matrices;
}

bool deform(const MeshShape& shape, std::span<const double> weights,
            std::span<const glm::dmat4> joints, Mesh& mesh) {
    const std::vector<ActiveTarget> active = active_targets(shape, weights);
    const bool is_carried = shape.influences.width > 0;
    mesh.positions.resize(shape.positions.size());
    mesh.normals.resize(shape.normals.size());
    mesh.tangents.resize(shape.tangents.size());
    std::atomic<std::ptrdiff_t> sides{0};
    constexpr std::size_t grain = 1024;
    const tbb::blocked_range<std::size_t> all(0, mesh.positions.size(), grain);
    tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
        std::ptrdiff_t sides_here = 0;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            Vertex vertex = morphed(shape, active, i);
            if (is_carried) sides_here += carry(mean_matrix(shape.influences, joints, i), vertex);
            mesh.positions[i] = glm::vec3(vertex.position);
            if (!mesh.normals.empty()) mesh.normals[i] = direction_of(vertex.normal);
            // A mirrored vertex has faces and normals that are flipped, and so its bitangent.
            if (!mesh.tangents.empty())
                mesh.tangents[i] = glm::vec4(direction_of(vertex.tangent), shape.tangents[i].w);
        }
        sides += sides_here;
    });
    return sides < 0;
}

}  // namespace weft
