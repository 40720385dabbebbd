// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_FLAT_MEDIA_H
#define WEFT_SCENE_FLAT_MEDIA_H

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/flat_grids.h"
#include "scene/scene.h"
#include "shared/shared_types.h"

namespace weft {

struct KernelUnits;
struct Scene;

/// Participating media as kernels read them (kernels/media/medium_walk.h), in kernel units. Empty
/// where no medium of the scene absorbs, scatters or emits light.
struct FlatMedia {
    std::vector<shared::MediumRecord> records;
    /// The media inside and outside of boundaries; the renderer sets `around_camera`.
    shared::MediaRecord space{};
    std::vector<shared::float4> positions;    ///< of the boundaries
    std::vector<shared::Triangle> triangles;  ///< `instance` is the number of the boundary
    std::vector<shared::float4> normals;      ///< by triangle, outwards; w: the number, as bits
    FlatGrids grids;                          ///< to which records refer
    /// A boundary that is a surface too, glass around a medium for instance.
    struct SurfaceBoundary {
        std::uint32_t instance = 0;
        std::uint32_t number = 0;  ///< of the boundary
        bool inwards = false;      ///< the normals of the mesh, as it is placed, point inwards
    };
    std::vector<SurfaceBoundary> surfaces;
    /// Approximate radiance of the brightest medium along a line through the scene; 0 where none
    /// emits.
    double radiance = 0.0;

    /// Some have an albedo, or a colour of extinction, that varies, which path tracing alone knows.
    bool coloured = false;

    [[nodiscard]] bool present() const noexcept { return !records.empty(); }
    /// Whether any medium scatters light.
    [[nodiscard]] bool scatters() const;
    /// FEATURE_* that the media need.
    [[nodiscard]] std::uint32_t features() const;
};

/// Flattens the media of a validated scene. Boundaries are numbered by the volume that they
/// enclose, the smallest first: where they overlap, the smaller one counts. A boundary whose
/// normals point inwards encloses its exterior medium. Throws Error (exit code 2) for more
/// boundaries than kernels can tell apart, and for a medium without end, grid or extinction that
/// emits.
[[nodiscard]] FlatMedia flatten_media(const Scene& scene, const KernelUnits& units);

/// Removes the boundaries of media that are surfaces too, and remembers that there were some:
/// previews show nothing of what such surfaces enclose.
void empty_surfaces(Scene& scene);

/// The boundaries that enclose a point (kernel units), a bit each: those about which their
/// triangles wind by more than half.
[[nodiscard]] std::uint32_t boundaries_around(const FlatMedia& media, const glm::dvec3& point);

}  // namespace weft

#endif
