// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/interleaved_irradiance.h"
#include "components/soft_shadows.h"
#include "frame/view_media.h"
#include "frame/virtual_lights.h"

namespace weft {
namespace {

constexpr const char* name = "direct";

bool called_for(const FramePlan& plan) {
    return plan.has_sampled_direct() || plan.has_exact_direct();
}

/// Looks at every sample on area lights: near ones are known in closed form where each light has
/// samples of its own.
KernelId area_light_kernel(const FramePlan& plan) {
    return plan.samples_per_light > 0 ? KernelId::area_lights : KernelId::vpl_gather;
}

ComponentNeeds needs(const FramePlan& plan) {
    const bool adapts = plan.adapts_direct();
    ComponentNeeds needs;
    if (plan.has_sampled_direct()) {
        needs = needs_of_interleaved(false);
        needs.features |= FEATURE_SAMPLED_DIRECT;
    }
    if (plan.has_exact_direct()) {
        needs.all_receivers = true;
        needs.features |= FEATURE_EXACT_DIRECT;
    }
    if (plan.directional_lights > 0) needs.features |= FEATURE_DIRECTIONAL_LIGHTS;
    std::vector<KernelId>& list = needs.kernels;
    if (plan.light_sample_count() > 0) list.push_back(KernelId::light_samples);
    if (plan.samples_per_set > 0 && !adapts) list.push_back(area_light_kernel(plan));
    if (plan.punctual_lights > 0) list.push_back(KernelId::vpl_gather);
    if (adapts)
        list.insert(list.end(),
                    {KernelId::shadow_probes, KernelId::shadow_edges, KernelId::soft_shadows});
    if (plan.has_distant()) list.push_back(KernelId::distant_light);
    return needs;
}

/// A list of lights that all receivers gather: of set k, `length` samples from first + k stride on.
struct GatheredLights {
    KernelId kernel;
    Stage stage;
    std::uint32_t first, stride, length;
};

/// Light that comes straight from area, point, spot and distant lights.
class Direct : public Component {
  public:
    explicit Direct(const ComponentInputs& inputs);

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext& frame) override;

    void hand_over(ComposedIrradiance& composed) const override {
        composed.direct = filtered_.get();
        composed.exact_direct = exact_irradiance_.get();
    }
    [[nodiscard]] std::optional<SlotIrradiance> slot_irradiance() const override {
        if (!irradiance_) return {};
        return all_slots(LightPart::direct, *irradiance_, shared_);
    }
    [[nodiscard]] const SamplingDecision* decision() const override { return soft_shadows_.get(); }

  private:
    void gather(FrameContext& frame, const GatheredLights& lights, Buffer* irradiance);
    void sample_distant(FrameContext& frame);
    void clear(FrameContext& frame, Buffer& irradiance);

    const FrameBuffers& shared_;
    std::unique_ptr<Buffer> irradiance_;         ///< by slot, and
    std::unique_ptr<Buffer> filtered_;           ///< by pixel; null without light that is filtered
    std::unique_ptr<Buffer> exact_irradiance_;   ///< by slot; null without such lights
    std::unique_ptr<SoftShadows> soft_shadows_;  ///< where area lights adapt
};

Direct::Direct(const ComponentInputs& inputs) : shared_(inputs.buffers) {
    Executor& executor = inputs.executor;
    const FramePlan& plan = inputs.plan;
    if (plan.adapts_direct()) soft_shadows_ = std::make_unique<SoftShadows>(inputs);
    if (plan.has_sampled_direct()) {
        irradiance_ = dark_irradiance(executor, shared_.slots, "direct irradiance");
        filtered_ = executor.allocate(inputs.pixels() * sizeof(shared::float4),
                                      "filtered direct irradiance");
    }
    if (plan.has_exact_direct())
        exact_irradiance_ = dark_irradiance(executor, shared_.slots, "exact direct irradiance");
}

void Direct::gather(FrameContext& frame, const GatheredLights& lights, Buffer* irradiance) {
    frame.params.list_first = lights.first;
    frame.params.list_stride = lights.stride;
    frame.params.list_length = lights.length;
    const std::vector<Buffer*> buffers{shared_.receivers.get(), shared_.block_set.get(),
                                       shared_.light_samples.get(), irradiance,
                                       shared_.counters.get()};
    const bool lamps = lights.kernel == KernelId::area_lights;
    frame.run(lights.kernel, lights.stage, name, true,
              lamps ? with_lamps(frame, buffers) : with_media(shared_, buffers),
              shared_.slots / frame.executor.lanes(),
              gather_items_per_launch(frame.executor, lights.length));
}

void Direct::sample_distant(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    frame.params.list_first = plan.area_samples() + plan.punctual_lights;
    frame.params.list_stride = plan.environment_samples;
    frame.run(KernelId::distant_light, Stage::distant_light, name, true,
              with_media(shared_, {shared_.receivers.get(), shared_.block_set.get(),
                                   frame.scene_buffers.lights.get(),
                                   shared_.or_nothing(shared_.light_samples),
                                   shared_.or_nothing(irradiance_),
                                   shared_.or_nothing(exact_irradiance_), shared_.counters.get()}),
              shared_.slots);
}

void Direct::clear(FrameContext& frame, Buffer& irradiance) {
    const std::vector<float> zero(std::size_t{3} * shared_.slots, 0.0F);
    write_buffer<float>(frame.executor, irradiance, zero);
}

void Direct::sample(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    make_light_samples(frame, name);
    // What no gather writes, the distant lights add to.
    if (irradiance_ && plan.samples_per_set == 0) clear(frame, *irradiance_);
    if (exact_irradiance_ && plan.punctual_lights == 0) clear(frame, *exact_irradiance_);
    if (soft_shadows_) {
        soft_shadows_->sample(frame, *shared_.light_samples, *irradiance_);
    } else if (plan.samples_per_set > 0) {
        gather(frame,
               {area_light_kernel(plan), Stage::area_lights, 0, plan.samples_per_set,
                plan.gather_sets == 1 ? plan.area_samples() : plan.samples_per_set},
               irradiance_.get());
    }
    if (plan.punctual_lights > 0)
        gather(frame,
               {KernelId::vpl_gather, Stage::punctual_lights, plan.area_samples(), 0,
                plan.punctual_lights},
               exact_irradiance_.get());
    if (plan.has_distant()) sample_distant(frame);
}

void Direct::reconstruct(FrameContext& frame) {
    if (irradiance_) reconstruct_all(frame, name, shared_.gbuffer, *irradiance_, *filtered_);
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<Direct>(inputs);
}

}  // namespace

ComponentKind direct_component() {
    return {name, Choice::by_default, called_for, needs, make};
}

}  // namespace weft
