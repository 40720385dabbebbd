// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_COMPONENTS_COMPONENT_H
#define WEFT_COMPONENTS_COMPONENT_H

#include <span>
#include <vector>

#include "frame/frame_context.h"

namespace weft {

/// A part of the light that is computed and reconstructed on its own. One exists per name in the
/// list `components()`; a frame whose plan does not call for it neither builds nor runs it.
struct Component {
    const char* name;
    bool (*called_for)(const FramePlan& plan);
    std::vector<KernelId> (*kernels)(const FramePlan& plan);
    /// Everything that a frame can leave out when it must end early.
    void (*sample)(FrameContext& frame);
    /// Cheap: irradiance by slot to irradiance by pixel.
    void (*reconstruct)(FrameContext& frame);
};

/// All components, in the order in which a frame runs them.
[[nodiscard]] std::span<const Component> components();

/// direct.cpp: light that comes straight from area, point, spot and distant lights.
[[nodiscard]] Component direct_component();
/// indirect.cpp: diffuse interreflection from virtual point lights.
[[nodiscard]] Component indirect_component();
/// vpl_residual.cpp: what both leave out, added to their irradiance.
[[nodiscard]] Component vpl_residual_component();

/// Work-items of a gather launch that keeps it short whatever the list's length: about a million
/// rays.
[[nodiscard]] std::uint32_t gather_items_per_launch(const Executor& executor,
                                                    std::uint32_t list_length);

}  // namespace weft

#endif
