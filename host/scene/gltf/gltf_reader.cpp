// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_reader.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/limits.h"
#include "base/warning_collector.h"
#include "scene/gltf/gltf_animation.h"
#include "scene/gltf/gltf_data.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_extensions.h"
#include "scene/gltf/gltf_image_light.h"
#include "scene/gltf/gltf_influences.h"
#include "scene/gltf/gltf_lights.h"
#include "scene/gltf/gltf_materials.h"
#include "scene/gltf/gltf_medium.h"
#include "scene/gltf/gltf_nodes.h"
#include "scene/gltf/gltf_parts.h"
#include "scene/gltf/gltf_skin.h"
#include "scene/gltf/gltf_textures.h"

namespace weft {
namespace {

constexpr WarningUnit node_unit{"node", "nodes"};

/// Fills a Scene from the nodes of a document.
class GltfReader {
  public:
    GltfReader(const GltfDocument& document, Diagnostics& diagnostics, MaterialDetail detail)
        : document_(document),
          root_(document.root()),
          report_(diagnostics),
          data_(document),
          textures_(document, data_, report_, scene_.textures),
          densities_(document.path, scene_.grids, diagnostics),
          materials_(document, textures_, report_, densities_, detail, scene_.materials,
                     scene_.media),
          skins_(document, data_, nodes_),
          parts_(document, data_, materials_, report_, scene_) {}

    GltfReader(const GltfReader&) = delete;
    GltfReader& operator=(const GltfReader&) = delete;

    Scene read() {
        scene_.source = document_.path.string();
        check_gltf_extensions(document_, report_);
        Animation& animation = scene_.animation;
        const GltfAnimatedNodes animated =
            read_gltf_animations(document_, data_, report_, animation);
        nodes_ = read_gltf_nodes(document_, animated, animation, report_);
        for (const GltfNode& node : nodes_) add_node(node);
        if (std::optional<Medium> fog = read_gltf_outer_medium(root_, densities_)) {
            scene_.outer_medium = static_cast<int>(scene_.media.size());
            scene_.media.push_back(*std::move(fog));
        }
        scene_.environment = read_gltf_image_light(root_, textures_);
        return std::move(scene_);
    }

  private:
    void add_node(const GltfNode& node) {
        const std::optional<JsonValue> mesh = node.value.find("mesh");
        const bool has_light = node.value.extension("KHR_lights_punctual").has_value();
        const bool has_camera = node.value.find("camera").has_value();
        if (!mesh && !has_light && !has_camera) return;
        if (node.value.extension("EXT_mesh_gpu_instancing"))
            report_.count(node.value.place(), node_unit,
                          "instancing by attributes is not simulated, one instance is rendered");
        if (mesh) add_mesh(node, *mesh);
        if ((!has_light && !has_camera) || !usable_transform(node.to_world, node.value, report_))
            return;
        if (auto light = read_gltf_light(root_, node, report_)) {
            light->motion = node.motion;
            scene_.lights.push_back(*std::move(light));
        }
        if (auto camera = read_gltf_camera(root_, node, scene_.cameras.size())) {
            if (node.motion.moves()) camera->motion = node.motion;
            scene_.cameras.push_back(*std::move(camera));
        }
    }

    /// The skin that a node applies to its mesh, or null.
    const GltfSkin* skin_of(const GltfNode& node, const JsonValue& mesh) {
        const std::optional<JsonValue> skin = node.value.find("skin");
        if (!skin) return nullptr;
        const std::size_t index = mesh.as_index(root_.size_of("meshes"), "meshes");
        const GltfSkin& found = skins_.skin(*skin);
        const auto [skinnable, is_new] = skinnable_.try_emplace(index, false);
        if (is_new) skinnable->second = is_skinnable(root_.at("meshes").element(index));
        if (skinnable->second) return &found;
        report_.count(node.value.place(), node_unit,
                      "the skin needs JOINTS_0 and WEIGHTS_0 of the mesh, it is left out");
        return nullptr;
    }

    /// Adds the instances of a node's mesh. A mesh that joints carry is placed by its skeleton, not
    /// by its node.
    void add_mesh(const GltfNode& node, const JsonValue& reference) {
        const GltfSkin* const skin = skin_of(node, reference);
        const glm::dmat4& to_world = skin != nullptr ? skin->to_world : node.to_world;
        if (!usable_transform(to_world, node.value, report_)) return;
        const Attachment& motion = skin != nullptr ? skin->motion : node.motion;
        const std::vector<GltfPart>& parts = parts_.of(node, reference, skin);
        if (parts.size() >
            limits::max_instances - scene_.instances.size() - scene_.medium_boundaries.size())
            throw node.value.error("brings the file above the limit of " +
                                   std::to_string(limits::max_instances) + " placed meshes");
        for (const GltfPart& part : parts) {
            const bool moves = motion.moves() || part.deforms;
            if (part.medium >= 0) {
                if (moves)
                    report_.count(node.value.place(), node_unit,
                                  "a moving medium is not simulated, its pose at rest is rendered");
                // A mirrored mesh has its faces turned inwards.
                const int inside = part.mirrored ? -1 : part.medium;
                const int outside = part.mirrored ? part.medium : -1;
                scene_.medium_boundaries.push_back({part.mesh, to_world, inside, outside, -1});
                continue;
            }
            Instance instance;
            instance.name = node.name.empty() ? scene_.meshes[part.mesh].name : node.name;
            instance.mesh = part.mesh;
            instance.material = part.material;
            instance.to_world = to_world;
            instance.flip_normals = part.mirrored;
            instance.motion = motion;
            instance.may_move = moves;
            instance.deformation = part.deformation;
            scene_.instances.push_back(std::move(instance));
        }
    }

    const GltfDocument& document_;
    JsonValue root_;
    Scene scene_;
    WarningCollector report_;
    GltfData data_;
    GltfTextures textures_;
    GltfDensities densities_;
    GltfMaterials materials_;
    std::vector<GltfNode> nodes_;
    GltfSkins skins_;
    GltfParts parts_;
    std::map<std::size_t, bool> skinnable_;  ///< by mesh of the file
};

}  // namespace

Scene read_gltf(const std::filesystem::path& path, Diagnostics& diagnostics,
                MaterialDetail detail) {
    const GltfDocument document = read_gltf_document(path);
    return GltfReader(document, diagnostics, detail).read();
}

}  // namespace weft
