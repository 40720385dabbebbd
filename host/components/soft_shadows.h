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

/// Light of area lights at every pixel, with rays where they tell something: one to each light
/// first, the others where the pixels about have found different things.
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
    void look(FrameContext& frame, BufferRef<kinds::VirtualLights> samples,
              BufferRef<kinds::SlotLight> irradiance);
    /// Sets edges_; returns the milliseconds that the search took.
    [[nodiscard]] double find_edges();
    void look_again(FrameContext& frame, BufferRef<kinds::VirtualLights> samples,
                    BufferRef<kinds::SlotLight> irradiance);

    Executor& executor_;
    const FrameBuffers& shared_;
    TileGrid grid_;
    double step_ = 0.0;    ///< of the last frame: see soft_shadows.cl
    std::uint32_t words_;  ///< of a pixel, for a bit a light
    DeviceBuffer<kinds::PixelShadows> pixel_shadows_;
    DeviceBuffer<kinds::ShadowEdges> shadow_edges_;
    DeviceBuffer<kinds::BrightnessSlopes> slopes_;
    ShadowEdges edges_;
};

}  // namespace weft

#endif
