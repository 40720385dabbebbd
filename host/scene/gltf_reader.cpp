// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_reader.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/limits.h"
#include "scene/gltf_animation.h"
#include "scene/gltf_data.h"
#include "scene/gltf_document.h"
#include "scene/gltf_extensions.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_medium.h"
#include "scene/gltf_mesh.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_report.h"
#include "scene/gltf_textures.h"

namespace weft {
namespace {

/// Fills a Scene from the nodes of a document.
class GltfReader {
  public:
    GltfReader(const GltfDocument& document, Diagnostics& diagnostics)
        : document_(document),
          root_(document.root()),
          report_(diagnostics),
          data_(document),
          textures_(document, data_, report_, scene_.textures),
          densities_(document.path, scene_.grids, diagnostics),
          materials_(document, textures_, report_, densities_, scene_.materials, scene_.media) {}

    GltfReader(const GltfReader&) = delete;
    GltfReader& operator=(const GltfReader&) = delete;

    Scene read() {
        scene_.source = document_.path.string();
        check_gltf_extensions(document_, report_);
        Animation& animation = scene_.animation;
        const GltfAnimatedNodes animated =
            read_gltf_animations(document_, data_, report_, animation.tracks);
        for (const GltfNode& node : read_gltf_nodes(document_, animated, animation, report_))
            add_node(node);
        if (std::optional<Medium> fog = read_gltf_outer_medium(root_, densities_)) {
            scene_.outer_medium = static_cast<int>(scene_.media.size());
            scene_.media.push_back(*std::move(fog));
        }
        report_.flush();
        return std::move(scene_);
    }

  private:
    /// A primitive that has become a mesh of the scene.
    struct Part {
        std::uint32_t mesh;
        std::uint32_t material;
        int medium;  ///< where not -1, it is a boundary of that
    };

    void add_node(const GltfNode& node) {
        const std::optional<GltfValue> mesh = node.value.find("mesh");
        const bool has_light = node.value.extension("KHR_lights_punctual").has_value();
        if (!mesh && !has_light && !node.value.find("camera")) return;
        if (node.value.extension("EXT_mesh_gpu_instancing"))
            report_.once(node.value.place(),
                         "instancing by attributes is not simulated, one instance is rendered "
                         "instead");
        if (!usable_transform(node, report_)) return;
        if (mesh) add_instances(node, *mesh);
        if (auto light = read_gltf_light(root_, node, report_)) {
            light->motion = node.motion;
            scene_.lights.push_back(*std::move(light));
        }
        if (auto camera = read_gltf_camera(root_, node, scene_.cameras.size(), report_)) {
            if (node.motion.moves()) camera->motion = node.motion;
            scene_.cameras.push_back(*std::move(camera));
        }
    }

    void add_instances(const GltfNode& node, const GltfValue& reference) {
        if (node.value.find("skin"))
            report_.once(node.value.place(),
                         "skins are not simulated, the mesh is rendered unskinned instead");
        const std::size_t index = reference.as_index(root_.size_of("meshes"), "meshes");
        const std::vector<Part>& parts = mesh_parts(index);
        if (parts.size() >
            limits::max_instances - scene_.instances.size() - scene_.medium_boundaries.size())
            throw node.value.error("brings the file above the limit of " +
                                   std::to_string(limits::max_instances) + " placed meshes");
        for (const Part& part : parts) {
            if (part.medium >= 0) {
                if (node.motion.moves())
                    report_.once(node.value.place(),
                                 "animations of media are not simulated, their pose at rest is "
                                 "rendered instead");
                scene_.medium_boundaries.push_back({part.mesh, node.to_world, part.medium, -1});
                continue;
            }
            Instance instance;
            instance.name = node.name.empty() ? scene_.meshes[part.mesh].name : node.name;
            instance.mesh = part.mesh;
            instance.material = part.material;
            instance.to_world = node.to_world;
            instance.motion = node.motion;
            instance.may_move = node.motion.moves();
            scene_.instances.push_back(std::move(instance));
        }
    }

    const std::vector<Part>& mesh_parts(std::size_t index) {
        if (const auto known = parts_.find(index); known != parts_.end()) return known->second;
        const GltfValue value = root_.at("meshes").element(index);
        const GltfValue primitives = value.at("primitives");
        const std::string name = value.name_or("mesh " + std::to_string(index));
        std::vector<Part> parts;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            const GltfValue primitive = primitives.element(i);
            const GltfSurface& surface = materials_.surface(primitive.find("material"));
            std::optional<Mesh> mesh =
                read_gltf_primitive(data_, primitive, surface, report_, triangles_read_);
            if (!mesh) continue;
            mesh->name = primitives.size() == 1 ? name : name + " part " + std::to_string(i);
            parts.push_back({static_cast<std::uint32_t>(scene_.meshes.size()), surface.material,
                             surface.medium});
            scene_.meshes.push_back(*std::move(mesh));
        }
        return parts_[index] = std::move(parts);
    }

    const GltfDocument& document_;
    GltfValue root_;
    Scene scene_;
    GltfReport report_;
    GltfData data_;
    GltfTextures textures_;
    GltfDensities densities_;
    GltfMaterials materials_;
    std::size_t triangles_read_ = 0;
    std::map<std::size_t, std::vector<Part>> parts_;
};

}  // namespace

Scene read_gltf(const std::filesystem::path& path, Diagnostics& diagnostics) {
    const GltfDocument document = read_gltf_document(path);
    return GltfReader(document, diagnostics).read();
}

}  // namespace weft
