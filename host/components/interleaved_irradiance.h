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

/// Irradiance by interleaved sampling: each pixel estimates it with its own sample set, and
/// reconstruction then averages over the pixels of all sets about it. Where the plan adapts, its
/// levels decide which pixels have samples; elsewhere all pixels have.
class InterleavedIrradiance {
  public:
    /// Slots whose irradiance a component computes: [first, first + count), both multiples of
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

    /// `component` names the stages. `gbuffer` holds the surfaces that are sampled, `tiles` their
    /// tiles where the plan adapts. All outlive this. `threshold_share` is the share of the plan's
    /// threshold that errors may reach.
    InterleavedIrradiance(const ComponentInputs& inputs, const char* component,
                          const GBuffer& gbuffer, TileGeometry* tiles,
                          double threshold_share = 1.0);

    /// Calls `gather` for all samples of a frame. `least_levels`, a component's own heuristic, is
    /// AdaptiveSampling::Steps::least_levels; it is not called where every pixel is sampled.
    /// `beneath` is the light that this one is seen on top of.
    void sample(FrameContext& frame, const Gather& gather,
                const std::function<std::vector<Level>()>& least_levels = {},
                const LightBeneath& beneath = {});
    /// Reconstructs the irradiance of every pixel from that of the slots.
    void reconstruct(FrameContext& frame);

    /// Four floats a pixel: red, green, blue, and the weight of samples, 0 where there are none.
    [[nodiscard]] BufferRef<kinds::ReconstructedLight> filtered() const { return filtered_; }
    [[nodiscard]] SlotIrradiance slots_of(LightPart part) const;
    /// The most slots that a frame may use.
    [[nodiscard]] std::uint32_t slots() const {
        return adaptive_ ? adaptive_->slots() : shared_.slots;
    }
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

/// What InterleavedIrradiance needs of the frames, besides the kernels that gather it.
[[nodiscard]] ComponentRequirements requirements_of_interleaved(bool adapts);

/// Filters the irradiance of all pixels with the discontinuity buffer: reconstruct.cl as a stage.
void reconstruct_all(FrameContext& frame, const char* component, const GBuffer& gbuffer,
                     BufferRef<kinds::SlotLight> irradiance,
                     BufferRef<kinds::ReconstructedLight> filtered);

/// The SlotIrradiance of a component that samples every pixel.
[[nodiscard]] SlotIrradiance all_slots(LightPart part, BufferRef<kinds::SlotLight> irradiance,
                                       const FrameBuffers& shared);
/// The SlotIrradiance of a component that `sampling` samples.
[[nodiscard]] SlotIrradiance adaptive_slots(LightPart part, BufferRef<kinds::SlotLight> irradiance,
                                            const AdaptiveSampling& sampling);

}  // namespace weft

#endif
