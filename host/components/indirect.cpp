// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "components/interleaved_irradiance.h"
#include "frame/view_media.h"
#include "frame/virtual_lights.h"

namespace weft {
namespace {

constexpr const char* name = "indirect";

bool called_for(const FramePlan& plan) {
    return plan.gathers_vpls() && !plan.cached;
}

ComponentNeeds needs(const FramePlan& plan) {
    ComponentNeeds needs = needs_of_interleaved(plan.adaptive);
    needs.kernels.push_back(KernelId::vpl_walk);
    needs.kernels.push_back(KernelId::vpl_gather);
    needs.features = FEATURE_INDIRECT;
    return needs;
}

/// Diffuse interreflection from virtual point lights.
class Indirect : public Component {
  public:
    explicit Indirect(const ComponentInputs& inputs)
        : irradiance_(inputs, name, inputs.buffers.gbuffer, inputs.buffers.tiles.get()) {}

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext& frame) override { irradiance_.reconstruct(frame); }

    void hand_over(ComposedIrradiance& composed) const override {
        composed.indirect = &irradiance_.filtered();
    }
    [[nodiscard]] std::optional<SlotIrradiance> slot_irradiance() const override {
        return irradiance_.slots_of(LightPart::indirect);
    }
    [[nodiscard]] const SamplingDecision* decision() const override {
        return irradiance_.adaptive();
    }

  private:
    void gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots);

    InterleavedIrradiance irradiance_;
};

void Indirect::gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots) {
    const FramePlan& plan = frame.plan;
    const std::uint32_t lanes = frame.executor.lanes();
    frame.params.list_first = 0;
    frame.params.list_stride = plan.vpls_per_set;
    frame.params.list_length = plan.vpls_per_set * (plan.gather_sets == 1 ? plan.sets : 1);
    const float roulette_before =
        std::exchange(frame.params.roulette, static_cast<float>(plan.roulette));
    frame.run(
        KernelId::vpl_gather, Stage::vpl_gather, name, true,
        with_media(frame.buffers, {&slots.receivers, &slots.block_set, frame.buffers.vpls.get(),
                                   &slots.irradiance, frame.buffers.counters.get()}),
        slots.count / lanes, gather_items_per_launch(frame.executor, frame.params.list_length),
        slots.first / lanes);
    frame.params.roulette = roulette_before;
}

void Indirect::sample(FrameContext& frame) {
    walk_vpls(frame, name);
    irradiance_.sample(frame,
                       [&](const InterleavedIrradiance::Slots& slots) { gather(frame, slots); });
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<Indirect>(inputs);
}

}  // namespace

ComponentKind indirect_component() {
    return {name, Choice::by_default, called_for, needs, make};
}

}  // namespace weft
