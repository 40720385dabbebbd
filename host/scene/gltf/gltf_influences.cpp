// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_influences.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

#include "base/limits.h"
#include "scene/gltf/gltf_attribute.h"

namespace weft {
namespace {

/// One of JOINTS_n and WEIGHTS_n.
struct JointSet {
    const GltfAccessor* joints;
    const GltfAccessor* weights;
};

bool is_of_bytes_or_shorts(const GltfAccessor& accessor) {
    return accessor.component() == GltfComponent::uint8 ||
           accessor.component() == GltfComponent::uint16;
}

std::vector<JointSet> find_sets(GltfData& data, const JsonValue& attributes,
                                std::size_t vertex_count, WarningCollector& report) {
    std::vector<JointSet> sets;
    for (std::size_t s = 0; s <= limits::max_joint_sets; ++s) {
        const std::string joints_name = "JOINTS_" + std::to_string(s);
        const std::string weights_name = "WEIGHTS_" + std::to_string(s);
        if (!attributes.find(joints_name.c_str()) || !attributes.find(weights_name.c_str())) break;
        if (s == limits::max_joint_sets) {
            report.count(attributes.place(), {"mesh", "meshes"},
                         "more than " + std::to_string(4 * limits::max_joint_sets) +
                             " joints of a vertex are not simulated, the others are ignored");
            break;
        }
        const GltfAccessor* const joints =
            find_gltf_attribute(data, attributes, joints_name, vertex_count, 4, 4);
        const GltfAccessor* const weights =
            find_gltf_attribute(data, attributes, weights_name, vertex_count, 4, 4);
        if (joints->normalized() || !is_of_bytes_or_shorts(*joints))
            throw attributes.at(joints_name.c_str())
                .error("chooses an accessor that holds no joints, expected VEC4 of 5121 or 5123");
        if (weights->component() != GltfComponent::float32 &&
            !(weights->normalized() && is_of_bytes_or_shorts(*weights)))
            throw attributes.at(weights_name.c_str())
                .error(
                    "chooses an accessor that holds no weights, expected VEC4 of 5126 or of "
                    "normalized 5121 or 5123");
        sets.push_back({joints, weights});
    }
    return sets;
}

/// Numbers of flaws in weights.
struct WeightFlaws {
    std::size_t broken = 0;   ///< weights
    std::size_t unequal = 0;  ///< vertices, as `orphaned`
    std::size_t orphaned = 0;
};

/// Normalises the weights of one vertex to a sum of 1.
void normalise(std::span<std::uint16_t> joints, std::span<float> weights, WeightFlaws& flaws) {
    // Larger than the error of weights that were rounded to integers.
    constexpr double tolerance = 0.05;
    double sum = 0.0;
    for (float& weight : weights) {
        const bool good = weight >= 0.0F && std::isfinite(weight);
        flaws.broken += good ? 0 : 1;
        if (!good) weight = 0.0F;
        sum += static_cast<double>(weight);
    }
    if (sum > 0.0) {
        flaws.unequal += std::abs(sum - 1.0) > tolerance ? 1 : 0;
        for (float& weight : weights)
            weight = static_cast<float>(static_cast<double>(weight) / sum);
    } else {
        ++flaws.orphaned;
        weights[0] = 1.0F;
    }
    // Joints without weight may have any index in files.
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (weights[i] == 0.0F) joints[i] = 0;
}

void report_flaws(const WeightFlaws& flaws, const std::string& place, WarningCollector& report) {
    constexpr WarningUnit unit{"vertex", "vertices"};
    report.count(place, {"joint weight", "joint weights"},
                 "negative or not finite, zero is used instead", flaws.broken);
    report.count(place, unit, "joint weights have a sum that is not 1, they are normalised",
                 flaws.unequal);
    report.count(place, unit, "joint weights are missing, the first joint is followed",
                 flaws.orphaned);
}

}  // namespace

bool is_skinnable(const JsonValue& mesh) {
    const JsonValue primitives = mesh.at("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const JsonValue primitive = primitives.element(i);
        if (primitive.integer_or("mode", 4) < 4) continue;
        const JsonValue attributes = primitive.at("attributes");
        if (!attributes.find("JOINTS_0") || !attributes.find("WEIGHTS_0")) return false;
    }
    return true;
}

JointInfluences read_gltf_influences(GltfData& data, const JsonValue& attributes,
                                     std::size_t vertex_count,
                                     const std::vector<std::uint32_t>& vertices,
                                     WarningCollector& report, std::size_t& influences_read) {
    const std::vector<JointSet> sets = find_sets(data, attributes, vertex_count, report);
    JointInfluences influences;
    influences.width = static_cast<std::uint32_t>(4 * sets.size());
    const std::size_t count = vertices.size() * influences.width;
    if (count > limits::max_joint_influences - influences_read)
        throw attributes.error("brings the file above the limit of " +
                               std::to_string(limits::max_joint_influences) +
                               " joint weights of vertices");
    influences_read += count;
    influences.joints.resize(count);
    influences.weights.resize(influences.joints.size());
    WeightFlaws flaws;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        const std::size_t first = v * influences.width;
        for (std::size_t s = 0; s < sets.size(); ++s) {
            std::array<float, 4> joints{};
            sets[s].joints->read(vertices[v], joints);
            sets[s].weights->read(vertices[v],
                                  std::span(&influences.weights[first + 4 * s], std::size_t{4}));
            for (std::size_t i = 0; i < 4; ++i)
                influences.joints[first + 4 * s + i] = static_cast<std::uint16_t>(joints[i]);
        }
        normalise(std::span(&influences.joints[first], influences.width),
                  std::span(&influences.weights[first], influences.width), flaws);
    }
    report_flaws(flaws, attributes.place(), report);
    return influences;
}

}  // namespace weft
