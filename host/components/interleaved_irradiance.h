// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_COMPONENTS_INTERLEAVED_IRRADIANCE_H
#define WEFT_COMPONENTS_INTERLEAVED_IRRADIANCE_H

#include <cstdint>
#include <functional>
#include <memory>

#include "adaptive/adaptive_sampling.h"
#include "components/component.h"

namespace weft {

/// Irradiance that each pixel estimates with its own sample set, and that is then reconstructed
/// from pixels of all sets about it: where the plan adapts, from samples where its levels want
/// them, else from samples of every pixel.
class InterleavedIrradiance {
  public:
    /// Slots whose irradiance a component is to make: [first, first + count), both multiples of
    /// PACKET_BLOCK.
    struct Slots {
        BufferRef<kinds::ReceiverPlanes> receivers;
        BufferRef<kinds::SlotPixels> slot_pixel;
        BufferRef<kinds::BlockSets> block_set;
        BufferRef<kinds::SlotLight> irradiance;
        std::uint32_t stride;  ///< of the planes by slot
        std::uint32_t first;
        std::uint32_t count;
    };
    using Gather = std::function<void(const Slots& slots)>;

    /// `component` names the stages. `gbuffer` holds the surfaces that are sampled, `tiles` is
    /// their tiles where the plan adapts. All outlive this. `threshold_share` is the share of the
    /// plan's threshold that errors may reach.
    InterleavedIrradiance(const ComponentInputs& inputs, const char* component,
                          const GBuffer& gbuffer, TileGeometry* tiles,
                          double threshold_share = 1.0);

    /// Calls `gather` for all samples of a frame. `least_levels`, a component's own heuristic, is
    /// AdaptiveSampling::Steps::least_levels; nothing asks for it where every pixel is sampled.
    void sample(FrameContext& frame, const Gather& gather,
                const std::function<std::vector<Level>()>& least_levels = {});
    /// Irradiance by slot to irradiance of every pixel.
    void reconstruct(FrameContext& frame);

    /// Four floats a pixel: red, green, blue, and the weight of samples, 0 where there are none.
    [[nodiscard]] BufferRef<kinds::ReconstructedLight> filtered() const { return filtered_; }
    [[nodiscard]] SlotIrradiance slots_of(LightPart part) const;
    /// Null where every pixel is sampled.
    [[nodiscard]] const AdaptiveSampling* adaptive() const { return adaptive_.get(); }

  private:
    const char* component_;
    const FrameBuffers& shared_;
    const GBuffer& gbuffer_;
    TileGeometry* tiles_;
    std::unique_ptr<AdaptiveSampling> adaptive_;
    DeviceBuffer<kinds::SlotLight> irradiance_;
    DeviceBuffer<kinds::ReconstructedLight> filtered_;
};

/// What such irradiance needs of the frames, besides what gathers it.
[[nodiscard]] ComponentNeeds needs_of_interleaved(bool adapts);

/// The discontinuity buffer of irradiance that every pixel has: reconstruct.cl as a stage.
void reconstruct_all(FrameContext& frame, const char* component, const GBuffer& gbuffer,
                     BufferRef<kinds::SlotLight> irradiance,
                     BufferRef<kinds::ReconstructedLight> filtered);

/// Of irradiance that every pixel has.
[[nodiscard]] SlotIrradiance all_slots(LightPart part, BufferRef<kinds::SlotLight> irradiance,
                                       const FrameBuffers& shared);
/// Of irradiance that `sampling` has samples of.
[[nodiscard]] SlotIrradiance adaptive_slots(LightPart part, BufferRef<kinds::SlotLight> irradiance,
                                            const AdaptiveSampling& sampling);

}  // namespace weft

#endif
