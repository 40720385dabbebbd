// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/validate_deformation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/finite.h"
#include "base/quote.h"
#include "scene/transform.h"

namespace weft {
namespace {

/// Whether `index` is -1 or below `count`.
bool is_none_or_below(int index, std::size_t count) {
    return index >= -1 && (index < 0 || static_cast<std::size_t>(index) < count);
}

/// Throws at the first error.
class DeformationValidator {
  public:
    explicit DeformationValidator(const Scene& scene) : scene_(scene) {}

    void run() {
        for (const Skin& skin : scene_.skins) check(skin);
        for (const Deformation& deformation : scene_.deformations) check(deformation);
        for (const Instance& instance : scene_.instances) check(instance);
    }

  private:
    void require(bool holds, const std::string& object, const char* message) const {
        if (!holds) throw input_error(scene_.source, object + " " + message);
    }

    void check(const Attachment& attachment) const {
        require(is_none_or_below(attachment.node, scene_.animation.nodes.size()), "skin",
                "moves with a node that does not exist");
        require(is_finite(attachment.to_node), "skin", "has a transform that is not finite");
    }

    void check(const Skin& skin) const {
        require(!skin.joints.empty() && skin.joints.size() == skin.inverse_bind.size(), "skin",
                "has the wrong number of matrices");
        check(skin.frame);
        for (const Attachment& joint : skin.joints) check(joint);
        require(all_finite(skin.inverse_bind), "skin", "has a matrix that is not finite");
    }

    void check(const Deformation& deformation) {
        require(deformation.mesh < scene_.meshes.size() && deformation.shape != nullptr,
                "deformation", "lacks its mesh");
        const Mesh& mesh = scene_.meshes[deformation.mesh];
        const MeshShape& shape = *deformation.shape;
        const std::string object = "deformation of mesh " + quote(mesh.name);
        require(shape.positions.size() == mesh.positions.size() &&
                    shape.normals.size() == mesh.normals.size(),
                object, "has the wrong number of vertices");
        check(shape, object);
        check_weights(deformation, object);
        require(is_none_or_below(deformation.skin, scene_.skins.size()), object,
                "refers to a skin that does not exist");
        if (shape.influences.width == 0) return;
        require(deformation.skin >= 0, object, "lacks a skin");
        check(shape.influences, shape.positions.size(),
              scene_.skins[static_cast<std::size_t>(deformation.skin)].joints.size(), object);
    }

    /// Deformations share their shapes.
    void check(const MeshShape& shape, const std::string& object) {
        if (!checked_.insert(&shape).second) return;
        require(all_finite(shape.positions) && all_finite(shape.normals), object,
                "has a vertex that is not finite");
        for (const MorphTarget& target : shape.targets) check(target, shape, object);
    }

    void check(const MorphTarget& target, const MeshShape& shape, const std::string& object) const {
        require((target.positions.empty() || target.positions.size() == shape.positions.size()) &&
                    (target.normals.empty() || target.normals.size() == shape.normals.size()),
                object, "has a target with the wrong number of vertices");
        require(all_finite(target.positions) && all_finite(target.normals), object,
                "has a target that is not finite");
    }

    void check_weights(const Deformation& deformation, const std::string& object) const {
        const std::vector<KeyTrack>& tracks = scene_.animation.tracks;
        const int index = deformation.weights_track;
        require(is_none_or_below(index, tracks.size()), object,
                "refers to a track that does not exist");
        const std::size_t count =
            index < 0 ? deformation.weights.size() : tracks[static_cast<std::size_t>(index)].width;
        require(count == deformation.shape->targets.size(), object,
                "has the wrong number of weights");
        require(std::all_of(deformation.weights.begin(), deformation.weights.end(),
                            [](double weight) { return std::isfinite(weight); }),
                object, "has a weight that is not finite");
    }

    void check(const JointInfluences& influences, std::size_t vertices, std::size_t joints,
               const std::string& object) const {
        require(influences.joints.size() == vertices * influences.width &&
                    influences.weights.size() == vertices * influences.width,
                object, "has the wrong number of joint weights");
        require(std::all_of(influences.joints.begin(), influences.joints.end(),
                            [&](std::uint16_t joint) { return joint < joints; }),
                object, "refers to a joint that does not exist");
        for (std::size_t v = 0; v < vertices; ++v) {
            double sum = 0.0;
            for (std::uint32_t i = 0; i < influences.width; ++i) {
                const float weight = influences.weights[v * influences.width + i];
                require(weight >= 0.0F, object, "has a joint weight that is negative or no number");
                sum += static_cast<double>(weight);
            }
            require(std::abs(sum - 1.0) < 1e-4, object, "has joint weights without a sum of 1");
        }
    }

    void check(const Instance& instance) const {
        const std::string object = "instance " + quote(instance.name);
        require(is_none_or_below(instance.deformation, scene_.deformations.size()), object,
                "refers to a deformation that does not exist");
        if (instance.deformation < 0) return;
        const auto index = static_cast<std::size_t>(instance.deformation);
        require(scene_.deformations[index].mesh == instance.mesh, object,
                "has a deformation of another mesh");
    }

    const Scene& scene_;
    std::set<const MeshShape*> checked_;
};

}  // namespace

void validate_deformations(const Scene& scene) {
    DeformationValidator(scene).run();
}

}  // namespace weft
