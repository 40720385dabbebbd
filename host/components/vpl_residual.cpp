// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "components/interleaved_irradiance.h"

namespace weft {
namespace {

bool is_enabled(const FramePlan& plan) {
    return plan.compensation;
}

ComponentRequirements requirements(const FramePlan& plan) {
    ComponentRequirements requirements;
    requirements.kernels = {KernelId::vpl_residual};
    if (plan.near_residual) requirements.kernels.push_back(KernelId::widen_residual);
    if (plan.undersamples() || plan.near_residual) {
        requirements.kernels.push_back(KernelId::filter_residual);
        requirements.all_receivers = true;
    }
    return requirements;
}

/// Places that a near residual is averaged over lie this many pixels apart, as wide as the filter
/// of all residuals.
constexpr std::uint32_t widening = 3;

/// How many times the other light of a pixel a path may count for; see widen_residual.cl. A path
/// then makes it brighter by 5 % at most.
constexpr float most_of_a_path = 4.0F;

/// The bit of a part to which a launch adds; see vpl_residual.cl.
std::uint32_t bit_of(LightPart part) {
    return part == LightPart::direct ? 1 : 2;
}

/// The area of the largest area light whose bound no closed form makes up for
/// (kernels/light/analytic_area_light_limit.h), kernel units squared; 0 where there is none.
float largest_bounded_area(const FlatScene& scene, const FramePlan& plan) {
    float largest = 0.0F;
    for (std::uint32_t i = 0; i < scene.area_lights; ++i) {
        const shared::LightRecord& light = scene.lights[i];
        const bool flat = light.axis.x != 0.0F || light.axis.y != 0.0F || light.axis.z != 0.0F;
        if (flat && plan.samples_per_light > 0) continue;
        largest = std::max(largest, light.area);
    }
    return largest;
}

/// Irradiance of the same receivers, to which the same paths are added.
struct Receivers {
    std::uint32_t parts = 0;
    SlotIrradiance slots;
    BufferRef<kinds::SlotLight> direct;
    BufferRef<kinds::SlotLight> indirect;
};

/// The residual: light that virtual lights and light samples leave out, by one path a pixel. Where
/// a component samples every pixel, the paths are added to its samples. Where it does not, a path
/// at a sample would stand for many pixels and show as a speck of their size: there every pixel has
/// a path of its own, which is filtered apart. So it is with a near residual, which is filtered
/// over more pixels than other light.
class VplResidual : public Component {
  public:
    explicit VplResidual(const ComponentInputs& inputs);

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext& frame) override;

  private:
    /// Residual by slot of all pixels, for a part that does not sample every pixel.
    struct Apart {
        LightPart part;
        DeviceBuffer<kinds::SlotLight> irradiance;
    };

    [[nodiscard]] bool is_apart(const SlotIrradiance& slots) const {
        return slots.undersampled || widens_;
    }
    [[nodiscard]] SlotIrradiance target(const SlotIrradiance& slots) const;
    [[nodiscard]] std::vector<Receivers> receivers() const;

    const FrameBuffers& shared_;
    std::vector<const Component*> others_;
    std::vector<Apart> apart_;
    bool widens_;
    DeviceBuffer<kinds::SlotLight> widened_;
};

VplResidual::VplResidual(const ComponentInputs& inputs)
    : shared_(inputs.buffers), widens_(inputs.plan.near_residual) {
    if (widens_) widened_ = dark_irradiance(inputs.executor, shared_.slots, "VPL residual");
    for (const ActiveComponent& earlier : inputs.earlier) {
        others_.push_back(earlier.component.get());
        const std::optional<SlotIrradiance> slots = earlier.component->slot_irradiance();
        if (slots && is_apart(*slots))
            apart_.push_back(
                {slots->part, dark_irradiance(inputs.executor, shared_.slots, "VPL residual")});
    }
}

/// The irradiance to which paths for these samples are added.
SlotIrradiance VplResidual::target(const SlotIrradiance& slots) const {
    if (!is_apart(slots)) return slots;
    const auto own = std::find_if(apart_.begin(), apart_.end(),
                                  [&](const Apart& apart) { return apart.part == slots.part; });
    return all_slots(slots.part, own->irradiance, shared_);
}

std::vector<Receivers> VplResidual::receivers() const {
    std::vector<Receivers> all;
    for (const Component* other : others_) {
        const std::optional<SlotIrradiance> samples = other->slot_irradiance();
        if (!samples) continue;
        const SlotIrradiance slots = target(*samples);
        auto same = std::find_if(all.begin(), all.end(), [&](const Receivers& known) {
            return known.slots.receivers == slots.receivers;
        });
        if (same == all.end()) same = all.insert(all.end(), {0, slots, {}, {}});
        same->parts |= bit_of(slots.part);
        (slots.part == LightPart::direct ? same->direct : same->indirect) = slots.irradiance;
    }
    return all;
}

void VplResidual::sample(FrameContext& frame) {
    const std::vector<float> zero(std::size_t{3} * shared_.slots, 0.0F);
    for (const Apart& apart : apart_) write_buffer(frame.executor, apart.irradiance, zero);
    for (const Receivers& to : receivers()) {
        frame.run(
            Stage::vpl_residual, "",
            kernels::vpl_residual{.scene = frame.scene_buffers.seen_by_light(),
                                  .geometry = view(frame.scene_buffers.geometry),
                                  .light_table = view(frame.scene_buffers.light_table),
                                  .light_nodes = frame.scene_buffers.light_nodes,
                                  .environment = view(frame.scene_buffers.environment),
                                  .slots = to.slots.stride,
                                  .receiver_planes = to.slots.receivers,
                                  .slot_pixel = to.slots.slot_pixel,
                                  .parts = to.parts,
                                  .near_area = frame.plan.near_residual
                                                   ? largest_bounded_area(frame.scene, frame.plan)
                                                   : -1.0F,
                                  .direct = to.direct,
                                  .indirect = to.indirect,
                                  .counters = frame.buffers.counters},
            {to.slots.slots});
    }
}

void VplResidual::reconstruct(FrameContext& frame) {
    const ComposedIrradiance& composed = shared_.irradiance;
    for (const Apart& apart : apart_) {
        if (widens_)
            frame.run(Stage::reconstruction, "",
                      kernels::widen_residual{.surfaces = view(shared_.gbuffer),
                                              .spacing = widening,
                                              .most = most_of_a_path,
                                              .slots = shared_.slots,
                                              .pixel_slot = shared_.pixel_slot,
                                              .irradiance = apart.irradiance,
                                              .direct = composed.direct,
                                              .indirect = composed.indirect,
                                              .widened = widened_},
                      {frame.pixels()});
        frame.run(
            Stage::reconstruction, "",
            kernels::filter_residual{
                .surfaces = view(shared_.gbuffer),
                .slots = shared_.slots,
                .pixel_slot = shared_.pixel_slot,
                .irradiance = widens_ ? widened_ : apart.irradiance,
                .filtered = apart.part == LightPart::direct ? composed.direct : composed.indirect},
            {frame.pixels()});
    }
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<VplResidual>(inputs);
}

}  // namespace

ComponentKind vpl_residual_component() {
    return {"VPL residual", Choice::unnamed, is_enabled, requirements, make};
}

}  // namespace weft
