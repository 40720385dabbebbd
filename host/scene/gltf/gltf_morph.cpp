// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_morph.h"

#include <cmath>
#include <string>

#include "base/finite.h"
#include "base/limits.h"
#include "scene/gltf/gltf_attribute.h"

namespace weft {
namespace {

std::vector<glm::vec3> read_deltas(GltfData& data, const JsonValue& target, const char* name,
                                   std::size_t vertex_count,
                                   const std::vector<std::uint32_t>& vertices,
                                   WarningCollector& report, std::size_t& deltas_read) {
    const GltfAccessor* const accessor =
        find_gltf_attribute(data, target, name, vertex_count, 3, 3);
    if (accessor == nullptr) return {};
    if (vertices.size() > limits::max_morph_deltas - deltas_read)
        throw target.error("brings the file above the limit of " +
                           std::to_string(limits::max_morph_deltas) +
                           " displacements by morph targets");
    deltas_read += vertices.size();
    std::vector<glm::vec3> deltas;
    deltas.reserve(vertices.size());
    std::size_t broken = 0;
    for (const std::uint32_t vertex : vertices) {
        const glm::vec3 delta = read_gltf_vector(*accessor, vertex);
        deltas.push_back(is_finite(delta) ? delta : glm::vec3(0.0F));
        broken += is_finite(delta) ? 0 : 1;
    }
    report.count(target.place(),
                 {"displacement by a morph target", "displacements by morph targets"},
                 "not finite, zero is used instead", broken);
    return deltas;
}

}  // namespace

std::size_t count_gltf_targets(const JsonValue& mesh) {
    const JsonValue primitives = mesh.at("primitives");
    if (primitives.size() == 0) return 0;
    const JsonValue first = primitives.element(0);
    const std::size_t count = first.size_of("targets");
    if (count > limits::max_morph_targets)
        throw first.at("targets").error("has " + std::to_string(count) +
                                        " elements, expected at most " +
                                        std::to_string(limits::max_morph_targets));
    return count;
}

std::optional<std::vector<double>> read_gltf_weights(const JsonValue& value, std::size_t targets) {
    const std::optional<JsonValue> listed = value.find("weights");
    if (!listed) return std::nullopt;
    if (listed->size() != targets)
        throw listed->error("has " + std::to_string(listed->size()) +
                            " elements, expected as many as morph targets, " +
                            std::to_string(targets));
    std::vector<double> weights(targets);
    for (std::size_t i = 0; i < targets; ++i) weights[i] = listed->element(i).as_number();
    return weights;
}

std::vector<MorphTarget> read_gltf_targets(GltfData& data, const JsonValue& primitive,
                                           std::size_t vertex_count,
                                           const std::vector<std::uint32_t>& vertices,
                                           bool with_normals, WarningCollector& report,
                                           std::size_t& deltas_read) {
    const JsonValue listed = primitive.at("targets");
    std::vector<MorphTarget> targets(listed.size());
    for (std::size_t t = 0; t < targets.size(); ++t) {
        const JsonValue target = listed.element(t);
        const auto read = [&](const char* name) {
            return read_deltas(data, target, name, vertex_count, vertices, report, deltas_read);
        };
        if (target.find("COLOR_0") || target.find("TEXCOORD_0") || target.find("TEXCOORD_1"))
            report.count(target.place(), {"morph target", "morph targets"},
                         "displaced colours and texture coordinates are not simulated");
        targets[t].positions = read("POSITION");
        if (with_normals) targets[t].normals = read("NORMAL");
    }
    return targets;
}

}  // namespace weft
