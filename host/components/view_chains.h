// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_COMPONENTS_VIEW_CHAINS_H
#define WEFT_COMPONENTS_VIEW_CHAINS_H

#include <memory>

#include "components/interleaved_irradiance.h"

namespace weft {

/// On which way of the first surface rays of the camera are followed: WAY_* of
/// kernels/bsdf/seen_lobes.h.
enum class ViewWay : std::uint32_t { reflection = 0, glossy = 1, refraction = 2 };

/// What pixels show in mirrors, on glossy surfaces, or through glass and gaps: light of the
/// surfaces at the ends of rays that are followed there. It is sampled and filtered as irradiance
/// is, on those surfaces, with tiles and levels of their own, by points on lights, distant light
/// and VPLs alike.
class ViewChains : public Component {
  public:
    /// `name` is the component's, and outlives this.
    ViewChains(const ComponentInputs& inputs, const char* name, ViewWay way);

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext& frame) override;
    void bind_outputs(ComposedIrradiance& composed) const override;
    [[nodiscard]] const SamplingDecision* decision() const override {
        return irradiance_.adaptive();
    }

  private:
    void trace(FrameContext& frame);
    /// The light of the image's own surfaces, as far as all of its pixels have samples.
    [[nodiscard]] LightBeneath light_beneath(const FrameContext& frame) const;
    void gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots);
    /// Adds what a list of virtual lights sends to the ends.
    void gather_list(FrameContext& frame, const InterleavedIrradiance::Slots& slots, Stage stage,
                     BufferRef<kinds::VirtualLights> lights, const shared::SetList& list,
                     bool adds);

    const char* name_;
    ViewWay way_;
    const Component* direct_;  ///< null without
    GBuffer ends_;
    std::unique_ptr<TileGeometry> tiles_;            ///< where the plan adapts
    DeviceBuffer<kinds::ReceiverPlanes> receivers_;  ///< the ends, where it does not
    InterleavedIrradiance irradiance_;
    DeviceBuffer<kinds::ViewShares> shares_;         ///< null where no facets are rough
    DeviceBuffer<kinds::ReconstructedLight> shown_;  ///< radiance by pixel, likewise
};

/// What a component of that way needs.
[[nodiscard]] ComponentRequirements requirements_of_view_chains(const FramePlan& plan, ViewWay way);

}  // namespace weft

#endif
