// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

#include "components/interleaved_irradiance.h"
#include "pipeline/view_media.h"
#include "pipeline/virtual_lights.h"
#include "scene/light_exponent.h"

namespace weft {
namespace {

constexpr const char* name = "indirect";

// Receivers that share a list: neighbours, but for where a tile of the work list ends.
constexpr std::uint32_t region_slots = 1024;

constexpr std::uint32_t regions(std::uint32_t slots) {
    return (slots + region_slots - 1) / region_slots;
}

bool is_enabled(const FramePlan& plan) {
    return plan.gathers_vpls() && !plan.cached;
}

/// Whether receivers decide in blocks which VPLs they trace. In sequences, whose VPLs are not
/// chosen for each image, blocks would flicker.
bool decides_by_block(const FramePlan& plan) {
    return plan.roulette > 0.0 && plan.choices == 0 && plan.selects_vpls();
}

ComponentRequirements requirements(const FramePlan& plan) {
    ComponentRequirements requirements = requirements_of_interleaved(plan.adaptive);
    std::ranges::copy(vpl_kernels(plan), std::back_inserter(requirements.kernels));
    if (plan.choices > 0)
        requirements.kernels.insert(requirements.kernels.end(),
                                    {KernelId::vpl_shortlist, KernelId::vpl_choice});
    else
        requirements.kernels.push_back(KernelId::vpl_gather);
    if (decides_by_block(plan)) requirements.kernels.push_back(KernelId::vpl_roulette);
    requirements.features = FEATURE_INDIRECT;
    return requirements;
}

/// The VPLs that a pixel gathers.
shared::SetList list_of(const FramePlan& plan) {
    const std::uint32_t sets = plan.gather_sets == 1 ? plan.sets : 1;
    return {.first = 0, .stride = plan.vpls_per_set, .length = plan.vpls_per_set * sets};
}

/// Where more than this many words, 256 MiB, would tell what roulette decides, each receiver does.
constexpr std::size_t most_survival_words = std::size_t{1} << 26;

std::size_t survival_words(std::uint32_t slots, const FramePlan& plan) {
    return std::size_t{slots / PACKET_BLOCK} * SURVIVAL_WORDS(list_of(plan).length);
}

/// Diffuse interreflection from virtual point lights.
class Indirect : public Component {
  public:
    explicit Indirect(const ComponentInputs& inputs)
        : irradiance_(inputs, name, inputs.buffers.gbuffer, inputs.buffers.tiles.get()),
          light_scale_(std::ldexp(1.0F, -light_exponent(inputs.scene))) {
        if (inputs.plan.choices > 0)
            shortlists_ = allocate<kinds::VirtualLights>(
                inputs.executor, std::size_t{regions(inputs.buffers.slots)} * inputs.plan.shortlist,
                "short lists of VPLs");
        const std::size_t words = survival_words(irradiance_.slots(), inputs.plan);
        if (decides_by_block(inputs.plan) && words <= most_survival_words)
            survival_ = allocate<kinds::VplSurvival>(inputs.executor, words, "survival of VPLs");
    }

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext& frame) override { irradiance_.reconstruct(frame); }

    void bind_outputs(ComposedIrradiance& composed) const override {
        composed.indirect = irradiance_.filtered();
    }
    [[nodiscard]] std::optional<SlotIrradiance> slot_irradiance() const override {
        return irradiance_.slots_of(LightPart::indirect);
    }
    [[nodiscard]] const SamplingDecision* decision() const override {
        return irradiance_.adaptive();
    }

  private:
    void gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots);
    void choose(FrameContext& frame, const InterleavedIrradiance::Slots& slots);

    InterleavedIrradiance irradiance_;
    float light_scale_;
    DeviceBuffer<kinds::VplSurvival>
        survival_;  ///< by block of receivers; null where blocks do not decide
    DeviceBuffer<kinds::VirtualLights> shortlists_;
};

void Indirect::gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots) {
    const FramePlan& plan = frame.plan;
    const std::uint32_t lanes = frame.executor.lanes();
    const shared::SetList list = list_of(plan);
    const std::uint32_t by_block = 1;
    const std::uint32_t by_receiver =
        std::bit_cast<std::uint32_t>(static_cast<float>(plan.roulette));
    if (survival_)
        frame.run(Stage::vpl_roulette, name,
                  kernels::vpl_roulette{.list = list,
                                        .roulette = static_cast<float>(plan.roulette),
                                        .scale = light_scale_,
                                        .slots = slots.stride,
                                        .receiver_planes = slots.receivers,
                                        .block_set = slots.block_set,
                                        .vpls = frame.buffers.vpls,
                                        .survival = survival_},
                  {.count = slots.count / PACKET_BLOCK, .first = slots.first / PACKET_BLOCK});
    frame.run(Stage::vpl_gather, name,
              kernels::vpl_gather{.scene = frame.scene_buffers.seen_by_light(),
                                  .media_tables = frame.buffers.media(),
                                  .list = list,
                                  .by_chance = survival_ ? by_block : by_receiver,
                                  .adds = 0,
                                  .slots = slots.stride,
                                  .receiver_planes = slots.receivers,
                                  .block_set = slots.block_set,
                                  .vpls = frame.buffers.vpls,
                                  .survival = survival_,
                                  .irradiance = slots.irradiance,
                                  .counters = frame.buffers.counters},
              {.count = slots.count / lanes,
               .per_launch = gather_items_per_launch(frame.executor, list.length),
               .first = slots.first / lanes});
}

void Indirect::choose(FrameContext& frame, const InterleavedIrradiance::Slots& slots) {
    const FramePlan& plan = frame.plan;
    frame.run(Stage::vpl_shortlist, name,
              kernels::vpl_shortlist{.vpl_count = plan.sets * plan.vpls_per_set,
                                     .region_slots = region_slots,
                                     .list_length = plan.shortlist,
                                     .scale = light_scale_,
                                     .slots = slots.stride,
                                     .receiver_planes = slots.receivers,
                                     .vpls = frame.buffers.vpls,
                                     .shortlists = shortlists_},
              {regions(slots.count)});
    frame.run(Stage::vpl_gather, name,
              kernels::vpl_choice{.scene = frame.scene_buffers.seen_by_light(),
                                  .region_slots = region_slots,
                                  .list_length = plan.shortlist,
                                  .choices = plan.choices,
                                  .scale = light_scale_,
                                  .slots = slots.stride,
                                  .receiver_planes = slots.receivers,
                                  .shortlists = shortlists_,
                                  .irradiance = slots.irradiance,
                                  .counters = frame.buffers.counters},
              {.count = slots.count / PACKET_BLOCK,
               .per_launch = gather_items_per_launch(frame.executor, plan.choices * PACKET_BLOCK),
               .first = slots.first / PACKET_BLOCK});
}

void Indirect::sample(FrameContext& frame) {
    walk_vpls(frame, name);
    irradiance_.sample(frame, [&](const InterleavedIrradiance::Slots& slots) {
        frame.plan.choices > 0 ? choose(frame, slots) : gather(frame, slots);
    });
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<Indirect>(inputs);
}

}  // namespace

ComponentKind indirect_component() {
    return {name, Choice::by_default, is_enabled, requirements, make};
}

}  // namespace weft
