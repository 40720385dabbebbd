// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_PARTS_H
#define WEFT_SCENE_GLTF_GLTF_PARTS_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "base/warning_collector.h"
#include "scene/gltf/gltf_data.h"
#include "scene/gltf/gltf_materials.h"
#include "scene/gltf/gltf_mesh.h"
#include "scene/gltf/gltf_nodes.h"
#include "scene/gltf/gltf_skin.h"
#include "scene/scene.h"

namespace weft {

/// A primitive that has become a mesh of the scene, in the form that it has at rest.
struct GltfPart {
    std::uint32_t mesh = 0;
    std::uint32_t material = 0;
    int medium = -1;        ///< medium of which it is a boundary, or -1
    bool mirrored = false;  ///< by its joints: see deform
    bool deforms = false;   ///< over time
    int deformation = -1;   ///< index into Scene::deformations; -1 also for boundaries that deform
};

/// The meshes of a document as nodes use them. One that nodes use in the same way becomes part of
/// the scene once; where skins or weights differ, there is one for each.
class GltfParts {
  public:
    /// Meshes and deformations are appended to those of `scene`.
    GltfParts(const GltfDocument& document, GltfData& data, GltfMaterials& materials,
              WarningCollector& report, Scene& scene);

    /// The mesh whose index `reference` holds, for a node that applies `skin` to it, or none where
    /// that is null. The result stays valid. Throws Error (exit code 2).
    [[nodiscard]] const std::vector<GltfPart>& of(const GltfNode& node, const JsonValue& reference,
                                                  const GltfSkin* skin);

  private:
    /// The morph targets of a mesh, which are known before its primitives are read.
    struct Morphs {
        std::size_t targets = 0;
        std::vector<double> weights;  ///< without a node's own
        bool morphed = false;         ///< whether these weights morph it
    };
    /// A primitive before any deformation.
    struct Primitive {
        Mesh mesh;                               ///< empty where it has become `part` itself
        std::shared_ptr<const MeshShape> shape;  ///< null where it has become `part` itself
        std::uint16_t joint = 0;                 ///< the largest that it refers to
        GltfPart part;
    };
    /// How a node changes the form of a mesh.
    struct Form {
        const GltfSkin* skin = nullptr;
        int track = -1;
        std::span<const double> weights;
        bool morphed = false;
    };

    [[nodiscard]] const Morphs& morphs(std::size_t mesh);
    [[nodiscard]] std::vector<Primitive>& primitives(std::size_t mesh, const Form& form);
    [[nodiscard]] std::vector<Primitive> read(const JsonValue& mesh, std::size_t number,
                                              const Form& form);
    [[nodiscard]] GltfPart deformed(const Primitive& primitive, const Form& form,
                                    const GltfNode& node);
    /// Counts a deformed mesh against the limits of a file.
    void count_deformed(const Mesh& mesh, const Form& form, const GltfNode& node);
    [[nodiscard]] int index_of(const GltfSkin& skin);

    JsonValue root_;
    GltfData& data_;
    GltfMaterials& materials_;
    WarningCollector& report_;
    Scene& scene_;
    GltfCounts read_;
    std::size_t deformed_vertices_ = 0;
    std::size_t deformed_triangles_ = 0;
    std::size_t deformation_work_ = 0;
    std::map<std::size_t, Morphs> morphs_;
    std::map<std::size_t, int> skins_;  ///< by number in the file, index into Scene::skins
    std::map<std::tuple<std::size_t, bool, bool>, std::vector<Primitive>> primitives_;
    std::map<std::tuple<std::size_t, std::size_t, int, bool, std::size_t>, std::vector<GltfPart>>
        parts_;
};

}  // namespace weft

#endif
