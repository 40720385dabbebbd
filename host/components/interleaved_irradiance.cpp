// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/interleaved_irradiance.h"

namespace weft {

InterleavedIrradiance::InterleavedIrradiance(const ComponentInputs& inputs, const char* component,
                                             const GBuffer& gbuffer, TileGeometry* tiles,
                                             double threshold_share)
    : component_(component),
      shared_(inputs.buffers),
      gbuffer_(gbuffer),
      tiles_(tiles),
      filtered_(allocate<kinds::ReconstructedLight>(inputs.executor, inputs.pixels(),
                                                    "filtered irradiance")) {
    if (inputs.plan.adaptive) {
        LevelSettings levels = inputs.levels();
        levels.threshold *= threshold_share;
        adaptive_ = std::make_unique<AdaptiveSampling>(inputs.executor, tiles_->grid(), levels,
                                                       inputs.features);
    }
    irradiance_ = dark_irradiance(inputs.executor, adaptive_ ? adaptive_->slots() : shared_.slots,
                                  "irradiance");
}

void InterleavedIrradiance::sample(FrameContext& frame, const Gather& gather,
                                   const std::function<std::vector<Level>()>& least_levels,
                                   const LightBeneath& beneath) {
    if (!adaptive_) {
        gather({shared_.receivers, shared_.slot_pixel, shared_.block_set, irradiance_,
                shared_.slots, 0, shared_.slots});
        return;
    }
    adaptive_->sample(
        frame, component_, gbuffer_, *tiles_, irradiance_,
        {[&](std::uint32_t first, std::uint32_t count) {
             gather({adaptive_->receivers(), adaptive_->slot_pixel(), adaptive_->block_set(),
                     irradiance_, adaptive_->slots(), first, count});
         },
         least_levels, beneath});
}

void InterleavedIrradiance::reconstruct(FrameContext& frame) {
    if (adaptive_)
        adaptive_->reconstruct(frame, component_, gbuffer_, *tiles_, irradiance_, filtered_);
    else
        reconstruct_all(frame, component_, gbuffer_, irradiance_, filtered_);
}

SlotIrradiance InterleavedIrradiance::slots_of(LightPart part) const {
    return adaptive_ ? adaptive_slots(part, irradiance_, *adaptive_)
                     : all_slots(part, irradiance_, shared_);
}

ComponentRequirements requirements_of_interleaved(bool adapts) {
    ComponentRequirements requirements;
    requirements.tiles = adapts;
    requirements.all_receivers = !adapts;
    if (adapts)
        requirements.kernels = {KernelId::lattice_signal, KernelId::reconstruct_tiles};
    else
        requirements.kernels = {KernelId::reconstruct};
    return requirements;
}

void reconstruct_all(FrameContext& frame, const char* component, const GBuffer& gbuffer,
                     BufferRef<kinds::SlotLight> irradiance,
                     BufferRef<kinds::ReconstructedLight> filtered) {
    const shared::CameraParams& camera = frame.params.camera;
    frame.run(Stage::reconstruction, component,
              kernels::reconstruct{.surfaces = view(gbuffer),
                                   .slots = frame.buffers.slots,
                                   .pixel_slot = frame.buffers.pixel_slot,
                                   .irradiance = irradiance,
                                   .filtered = filtered},
              {TileGrid{camera.width, camera.height}.tiles()});
}

SlotIrradiance all_slots(LightPart part, BufferRef<kinds::SlotLight> irradiance,
                         const FrameBuffers& shared) {
    return {part,         irradiance, shared.receivers, shared.slot_pixel, shared.slots,
            shared.slots, false};
}

SlotIrradiance adaptive_slots(LightPart part, BufferRef<kinds::SlotLight> irradiance,
                              const AdaptiveSampling& sampling) {
    return {part,
            irradiance,
            sampling.receivers(),
            sampling.slot_pixel(),
            sampling.slots_used(),
            sampling.slots(),
            sampling.undersamples()};
}

}  // namespace weft
