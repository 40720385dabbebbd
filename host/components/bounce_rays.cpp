// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/interleaved_irradiance.h"

namespace weft {
namespace {

constexpr const char* name = "indirect";
constexpr std::uint32_t indirect_part = 2;  // of vpl_residual.cl

bool is_enabled(const FramePlan& plan) {
    return plan.bounce_rays && plan.has_indirect();
}

ComponentRequirements requirements(const FramePlan&) {
    ComponentRequirements requirements = requirements_of_interleaved(false);
    requirements.kernels.push_back(KernelId::vpl_residual);
    requirements.features = FEATURE_INDIRECT;
    return requirements;
}

/// Diffuse interreflection by one path through each pixel, where light paths meet too few surfaces
/// to leave virtual lights: where there are none, the residual is all of the indirect light. Pixels
/// share their paths with those about them in the discontinuity buffer.
class BounceRays : public Component {
  public:
    explicit BounceRays(const ComponentInputs& inputs)
        : shared_(inputs.buffers),
          irradiance_(dark_irradiance(inputs.executor, shared_.slots, "irradiance")),
          filtered_(allocate<kinds::ReconstructedLight>(inputs.executor, inputs.pixels(),
                                                        "filtered irradiance")) {}

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext& frame) override {
        reconstruct_all(frame, name, shared_.gbuffer, irradiance_, filtered_);
    }
    void bind_outputs(ComposedIrradiance& composed) const override {
        composed.indirect = filtered_;
    }

  private:
    const FrameBuffers& shared_;
    DeviceBuffer<kinds::SlotLight> irradiance_;
    DeviceBuffer<kinds::ReconstructedLight> filtered_;
};

void BounceRays::sample(FrameContext& frame) {
    const std::vector<float> dark(std::size_t{3} * shared_.slots, 0.0F);
    write_buffer(frame.executor, irradiance_, dark);
    frame.run(Stage::bounce_rays, name,
              kernels::vpl_residual{.scene = frame.scene_buffers.seen_by_light(),
                                    .geometry = view(frame.scene_buffers.geometry),
                                    .light_table = view(frame.scene_buffers.light_table),
                                    .light_nodes = frame.scene_buffers.light_nodes,
                                    .environment = view(frame.scene_buffers.environment),
                                    .slots = shared_.slots,
                                    .receiver_planes = shared_.receivers,
                                    .slot_pixel = shared_.slot_pixel,
                                    .parts = indirect_part,
                                    .near_area = -1.0F,
                                    .direct = BufferRef<kinds::SlotLight>(),
                                    .indirect = irradiance_,
                                    .counters = frame.buffers.counters},
              {shared_.slots});
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<BounceRays>(inputs);
}

}  // namespace

ComponentKind bounce_rays_component() {
    return {"bounce_rays", Choice::unnamed, is_enabled, requirements, make};
}

}  // namespace weft
