// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_parts.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "base/limits.h"
#include "scene/closed_mesh.h"
#include "scene/gltf/gltf_morph.h"

namespace weft {
namespace {

bool any_counts(const std::vector<double>& weights) {
    return std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0.0; });
}

}  // namespace

GltfParts::GltfParts(const GltfDocument& document, GltfData& data, GltfMaterials& materials,
                     WarningCollector& report, Scene& scene)
    : root_(document.root()), data_(data), materials_(materials), report_(report), scene_(scene) {}

const std::vector<GltfPart>& GltfParts::of(const GltfNode& node, const JsonValue& reference,
                                           const GltfSkin* skin) {
    const std::size_t mesh = reference.as_index(root_.size_of("meshes"), "meshes");
    const Morphs& known = morphs(mesh);
    Form form;
    form.skin = skin;
    const std::optional<std::vector<double>> own = read_gltf_weights(node.value, known.targets);
    if (known.targets > 0) form.track = node.weights_track;
    form.weights = own ? *own : known.weights;
    form.morphed = form.track >= 0 || (own ? any_counts(*own) : known.morphed);
    const auto key = std::tuple(mesh, skin != nullptr ? skin->number : GltfNode::none, form.track,
                                form.morphed, own && form.morphed ? node.number : GltfNode::none);
    if (const auto found = parts_.find(key); found != parts_.end()) return found->second;
    std::vector<GltfPart> parts;
    for (const Primitive& primitive : primitives(mesh, form))
        parts.push_back(primitive.shape ? deformed(primitive, form, node) : primitive.part);
    return parts_[key] = std::move(parts);
}

const GltfParts::Morphs& GltfParts::morphs(std::size_t mesh) {
    if (const auto known = morphs_.find(mesh); known != morphs_.end()) return known->second;
    const JsonValue value = root_.at("meshes").element(mesh);
    Morphs made;
    made.targets = count_gltf_targets(value);
    made.weights =
        read_gltf_weights(value, made.targets).value_or(std::vector<double>(made.targets, 0.0));
    made.morphed = any_counts(made.weights);
    return morphs_[mesh] = std::move(made);
}

std::vector<GltfParts::Primitive>& GltfParts::primitives(std::size_t mesh, const Form& form) {
    const auto key = std::tuple(mesh, form.skin != nullptr, form.morphed);
    if (const auto known = primitives_.find(key); known != primitives_.end()) return known->second;
    return primitives_[key] = read(root_.at("meshes").element(mesh), mesh, form);
}

std::vector<GltfParts::Primitive> GltfParts::read(const JsonValue& mesh, std::size_t number,
                                                  const Form& form) {
    const JsonValue listed = mesh.at("primitives");
    const std::string name = mesh.name_or("mesh " + std::to_string(number));
    const std::size_t targets = morphs(number).targets;
    std::vector<Primitive> all;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const JsonValue value = listed.element(i);
        if (form.morphed && value.size_of("targets") != targets)
            throw value.error("has " + std::to_string(value.size_of("targets")) +
                              " morph targets, expected as many as the first primitive, " +
                              std::to_string(targets));
        const GltfSurface& surface = materials_.surface(value.find("material"));
        std::optional<GltfPrimitive> found = read_gltf_primitive(
            data_, value, surface, {form.skin != nullptr, form.morphed}, report_, read_);
        if (!found) continue;
        Primitive primitive;
        primitive.mesh = std::move(found->mesh);
        primitive.mesh.name = listed.size() == 1 ? name : name + " part " + std::to_string(i);
        primitive.part.material = surface.material;
        primitive.part.medium = surface.medium;
        if (surface.is_solid && !is_closed(primitive.mesh)) {
            report_.count(value.place(), {"primitive", "primitives"},
                          "glass with a volume on a mesh that is not closed, it is taken as thin");
            primitive.part.material = materials_.thin(surface.material);
        } else if (surface.is_wall && is_closed(primitive.mesh)) {
            report_.count(value.place(), {"primitive", "primitives"},
                          "glass without a volume on a closed mesh, it is taken as thin walls and "
                          "does not refract");
        }
        if (found->shape) {
            for (const std::uint16_t joint : found->shape->influences.joints)
                primitive.joint = std::max(primitive.joint, joint);
            primitive.shape = std::make_shared<const MeshShape>(*std::move(found->shape));
        } else {
            primitive.part.mesh = static_cast<std::uint32_t>(scene_.meshes.size());
            scene_.meshes.push_back(std::exchange(primitive.mesh, {}));
        }
        all.push_back(std::move(primitive));
    }
    return all;
}

void GltfParts::count_deformed(const Mesh& mesh, const Form& form, const GltfNode& node) {
    const std::size_t vertices = mesh.positions.size();
    const std::size_t triangles = mesh.triangles.size();
    if (vertices > limits::max_vertices - deformed_vertices_ ||
        triangles > limits::max_triangles - deformed_triangles_)
        throw node.value.error("brings the file above the limit of " +
                               std::to_string(limits::max_vertices) + " vertices or " +
                               std::to_string(limits::max_triangles) +
                               " triangles of deformed meshes");
    deformed_vertices_ += vertices;
    deformed_triangles_ += triangles;
    const auto active = static_cast<std::size_t>(
        std::count_if(form.weights.begin(), form.weights.end(),
                      [&](double weight) { return form.track >= 0 || weight != 0.0; }));
    // Weights are kept for each mesh that is made, so their memory counts, too.
    const std::size_t work = vertices * std::max<std::size_t>(1, active) + 64 * form.weights.size();
    if (work > limits::max_deformation_work - deformation_work_)
        throw node.value.error("brings the file above the limit of " +
                               std::to_string(limits::max_deformation_work) +
                               " displacements by morph targets in a pose");
    deformation_work_ += work;
}

GltfPart GltfParts::deformed(const Primitive& primitive, const Form& form, const GltfNode& node) {
    count_deformed(primitive.mesh, form, node);
    std::span<const glm::dmat4> joints;
    if (form.skin != nullptr) {
        joints = form.skin->at_rest;
        if (primitive.joint >= joints.size())
            throw node.value.at("skin").error("chooses a skin of " + std::to_string(joints.size()) +
                                              " joints, but the mesh refers to joint " +
                                              std::to_string(primitive.joint));
    }
    Mesh mesh = primitive.mesh;
    GltfPart part = primitive.part;
    part.mirrored = deform(*primitive.shape, form.weights, joints, mesh);
    part.mesh = static_cast<std::uint32_t>(scene_.meshes.size());
    scene_.meshes.push_back(std::move(mesh));
    part.deforms = form.track >= 0 || (form.skin != nullptr && form.skin->moves);
    if (!part.deforms || part.medium >= 0) return part;
    part.deformation = static_cast<int>(scene_.deformations.size());
    Deformation deformation;
    deformation.mesh = part.mesh;
    deformation.shape = primitive.shape;
    if (form.skin != nullptr) deformation.skin = index_of(*form.skin);
    deformation.weights_track = form.track;
    if (form.track < 0 && form.morphed)
        deformation.weights.assign(form.weights.begin(), form.weights.end());
    scene_.deformations.push_back(std::move(deformation));
    return part;
}

int GltfParts::index_of(const GltfSkin& skin) {
    const auto [known, is_new] =
        skins_.try_emplace(skin.number, static_cast<int>(scene_.skins.size()));
    if (is_new) scene_.skins.push_back(skin.skin);
    return known->second;
}

}  // namespace weft
