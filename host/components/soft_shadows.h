// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_COMPONENTS_SOFT_SHADOWS_H
#define WEFT_COMPONENTS_SOFT_SHADOWS_H

#include <cstdint>
#include <memory>
#include <vector>

#include "adaptive/sampling_decision.h"
#include "adaptive/shadow_edges.h"
#include "components/component.h"

namespace weft {

/// Direct light from area lights at every pixel, with shadow rays where they are needed: first the
/// probe, one ray to each light, then the others where the probes of neighbouring pixels disagree.
class SoftShadows : public SamplingDecision {
  public:
    explicit SoftShadows(const ComponentInputs& inputs);

    /// Fills `irradiance`, by slot of all receivers, from the lights' `samples`.
    void sample(FrameContext& frame, BufferRef<kinds::VirtualLights> samples,
                BufferRef<kinds::SlotLight> irradiance);

    [[nodiscard]] LevelCounts counts() const override;
    [[nodiscard]] bool can_save() const override;
    [[nodiscard]] bool can_spend() const override { return edges_.pixels > 0; }
    void add_layers(const std::string& component, Image& image) const override;

  private:
    void probe(FrameContext& frame, BufferRef<kinds::VirtualLights> samples,
               BufferRef<kinds::SlotLight> irradiance);
    /// Sets edges_; returns the milliseconds that the search took.
    [[nodiscard]] double find_edges();
    void refine(FrameContext& frame, BufferRef<kinds::VirtualLights> samples,
                BufferRef<kinds::SlotLight> irradiance);

    Executor& executor_;
    const FrameBuffers& shared_;
    TileGrid grid_;
    double step_ = 0.0;    ///< shadow_step of the last frame: see soft_shadows.cl
    std::uint32_t words_;  ///< words per pixel that hold one bit per light
    DeviceBuffer<kinds::PixelShadows> pixel_shadows_;
    DeviceBuffer<kinds::ShadowEdges> shadow_edges_;
    DeviceBuffer<kinds::BrightnessSlopes> slopes_;
    ShadowEdges edges_;
};

}  // namespace weft

#endif
