// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/interleaved_irradiance.h"
#include "components/soft_shadows.h"
#include "pipeline/view_media.h"
#include "pipeline/virtual_lights.h"

namespace weft {
namespace {

constexpr const char* name = "direct";

bool is_enabled(const FramePlan& plan) {
    return plan.has_sampled_direct() || plan.has_exact_direct();
}

/// Whether area lights near a receiver are computed in closed form: where each light has samples of
/// its own.
bool knows_near_lights(const FramePlan& plan) {
    return plan.samples_per_light > 0;
}

/// The kernel that connects receivers to every sample on area lights.
KernelId area_light_kernel(const FramePlan& plan) {
    return knows_near_lights(plan) ? KernelId::area_lights : KernelId::vpl_gather;
}

ComponentRequirements requirements(const FramePlan& plan) {
    const bool adapts = plan.adapts_direct();
    ComponentRequirements requirements;
    if (plan.has_sampled_direct()) {
        requirements = requirements_of_interleaved(false);
        requirements.features |= FEATURE_SAMPLED_DIRECT;
    }
    if (plan.has_exact_direct()) {
        requirements.all_receivers = true;
        requirements.features |= FEATURE_EXACT_DIRECT;
    }
    if (plan.directional_lights > 0) requirements.features |= FEATURE_DIRECTIONAL_LIGHTS;
    std::vector<KernelId>& list = requirements.kernels;
    if (plan.light_sample_count() > 0) list.push_back(KernelId::light_samples);
    if (plan.samples_per_set > 0 && !adapts) list.push_back(area_light_kernel(plan));
    if (plan.punctual_lights > 0) list.push_back(KernelId::vpl_gather);
    if (adapts)
        list.insert(list.end(),
                    {KernelId::shadow_probes, KernelId::shadow_edges, KernelId::soft_shadows});
    if (plan.has_distant()) list.push_back(KernelId::distant_light);
    return requirements;
}

/// Direct light from area, point, spot and distant lights.
class Direct : public Component {
  public:
    explicit Direct(const ComponentInputs& inputs);

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext& frame) override;

    void bind_outputs(ComposedIrradiance& composed) const override {
        composed.direct = filtered_;
        composed.exact_direct = exact_irradiance_;
    }
    [[nodiscard]] std::optional<SlotIrradiance> slot_irradiance() const override {
        if (!irradiance_) return {};
        return all_slots(LightPart::direct, irradiance_, shared_);
    }
    [[nodiscard]] const SamplingDecision* decision() const override { return soft_shadows_.get(); }

  private:
    void sample_area_lights(FrameContext& frame);
    /// Gathers a list of light samples into `irradiance`.
    void gather(FrameContext& frame, Stage stage, const shared::SetList& list,
                BufferRef<kinds::SlotLight> irradiance);
    void sample_distant(FrameContext& frame);
    void clear(FrameContext& frame, const DeviceBuffer<kinds::SlotLight>& irradiance);

    const FrameBuffers& shared_;
    DeviceBuffer<kinds::SlotLight> irradiance_;         ///< null without light that is filtered
    DeviceBuffer<kinds::ReconstructedLight> filtered_;  ///< null without light that is filtered
    DeviceBuffer<kinds::SlotLight> exact_irradiance_;   ///< null without light that is not filtered
    std::unique_ptr<SoftShadows> soft_shadows_;         ///< null where area lights do not adapt
};

Direct::Direct(const ComponentInputs& inputs) : shared_(inputs.buffers) {
    Executor& executor = inputs.executor;
    const FramePlan& plan = inputs.plan;
    if (plan.adapts_direct()) soft_shadows_ = std::make_unique<SoftShadows>(inputs);
    if (plan.has_sampled_direct()) {
        irradiance_ = dark_irradiance(executor, shared_.slots, "direct irradiance");
        filtered_ = allocate<kinds::ReconstructedLight>(executor, inputs.pixels(),
                                                        "filtered direct irradiance");
    }
    if (plan.has_exact_direct())
        exact_irradiance_ = dark_irradiance(executor, shared_.slots, "exact direct irradiance");
}

void Direct::sample_area_lights(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    const std::uint32_t length = plan.gather_sets == 1 ? plan.area_samples() : plan.samples_per_set;
    if (!knows_near_lights(plan)) {
        gather(frame, Stage::area_lights,
               {.first = 0, .stride = plan.samples_per_set, .length = length}, irradiance_);
        return;
    }
    frame.run(Stage::area_lights, name,
              kernels::area_lights{.scene = frame.scene_buffers.seen_by_light(),
                                   .media_tables = shared_.media(),
                                   .area_lights = frame.scene_buffers.area_lights(),
                                   .slots = shared_.slots,
                                   .receiver_planes = shared_.receivers,
                                   .block_set = shared_.block_set,
                                   .samples = shared_.light_samples,
                                   .irradiance = irradiance_,
                                   .counters = shared_.counters},
              {.count = shared_.slots / frame.executor.lanes(),
               .per_launch = gather_items_per_launch(frame.executor, length)});
}

void Direct::gather(FrameContext& frame, Stage stage, const shared::SetList& list,
                    BufferRef<kinds::SlotLight> irradiance) {
    frame.run(stage, name,
              kernels::vpl_gather{.scene = frame.scene_buffers.seen_by_light(),
                                  .media_tables = shared_.media(),
                                  .list = list,
                                  .by_chance = 0,
                                  .adds = 0,
                                  .slots = shared_.slots,
                                  .receiver_planes = shared_.receivers,
                                  .block_set = shared_.block_set,
                                  .vpls = shared_.light_samples,
                                  .survival = BufferRef<kinds::VplSurvival>(),
                                  .irradiance = irradiance,
                                  .counters = shared_.counters},
              {.count = shared_.slots / frame.executor.lanes(),
               .per_launch = gather_items_per_launch(frame.executor, list.length)});
}

void Direct::sample_distant(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    const shared::SetList list{.first = plan.area_samples() + plan.punctual_lights,
                               .stride = plan.environment_samples,
                               .length = plan.environment_samples};
    frame.run(Stage::distant_light, name,
              kernels::distant_light{
                  .scene = frame.scene_buffers.seen_by_light(),
                  .media_tables = shared_.media(),
                  .list = list,
                  .slots = shared_.slots,
                  .receiver_planes = shared_.receivers,
                  .block_set = shared_.block_set,
                  .lights = frame.scene_buffers.light_table.lights,
                  .environment_record = frame.scene_buffers.environment.environment_record,
                  .environment_irradiance = frame.scene_buffers.environment_irradiance,
                  .samples = shared_.light_samples,
                  .sampled_irradiance = irradiance_,
                  .exact_irradiance = exact_irradiance_,
                  .counters = shared_.counters},
              {shared_.slots});
}

void Direct::clear(FrameContext& frame, const DeviceBuffer<kinds::SlotLight>& irradiance) {
    const std::vector<float> zero(std::size_t{3} * shared_.slots, 0.0F);
    write_buffer(frame.executor, irradiance, zero);
}

void Direct::sample(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    make_light_samples(frame, name);
    // Distant lights add to these, so what no gather writes must be 0.
    if (irradiance_ && plan.samples_per_set == 0) clear(frame, irradiance_);
    if (exact_irradiance_ && plan.punctual_lights == 0) clear(frame, exact_irradiance_);
    if (soft_shadows_) {
        soft_shadows_->sample(frame, shared_.light_samples, irradiance_);
    } else if (plan.samples_per_set > 0) {
        sample_area_lights(frame);
    }
    if (plan.punctual_lights > 0)
        gather(frame, Stage::punctual_lights,
               {.first = plan.area_samples(), .stride = 0, .length = plan.punctual_lights},
               exact_irradiance_);
    if (plan.has_distant()) sample_distant(frame);
}

void Direct::reconstruct(FrameContext& frame) {
    if (irradiance_) reconstruct_all(frame, name, shared_.gbuffer, irradiance_, filtered_);
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<Direct>(inputs);
}

}  // namespace

ComponentKind direct_component() {
    return {name, Choice::by_default, is_enabled, requirements, make};
}

}  // namespace weft
