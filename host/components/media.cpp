// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>
#include <utility>

#include "components/interleaved_irradiance.h"
#include "pipeline/view_media.h"
#include "pipeline/virtual_lights.h"

namespace weft {
namespace {

constexpr const char* name = "media";

// Share of the threshold that the error of scattered light may reach. This light is smooth but for
// shafts, whose faint edges are long and lie over everything; the stricter threshold costs little,
// since few pixels have to be sampled.
constexpr double threshold_share = 0.25;

bool is_enabled(const FramePlan& plan) {
    return plan.media_light;
}

ComponentRequirements requirements(const FramePlan& plan) {
    ComponentRequirements requirements = requirements_of_interleaved(plan.adaptive);
    requirements.features = FEATURE_AIRLIGHT;
    // Its tiles are its own: those of the ends of view rays.
    requirements.own_tiles = std::exchange(requirements.tiles, false);
    requirements.kernels.push_back(KernelId::media_gather);
    if (plan.light_sample_count() > 0) requirements.kernels.push_back(KernelId::light_samples);
    if (plan.has_vpls())
        std::ranges::copy(vpl_kernels(plan), std::back_inserter(requirements.kernels));
    if (plan.has_distant()) {
        requirements.kernels.push_back(KernelId::media_distant);
        if (plan.directional_lights > 0) requirements.features |= FEATURE_DIRECTIONAL_LIGHTS;
    }
    return requirements;
}

shared::SetList list_of(std::uint32_t first, std::uint32_t stride, std::uint32_t length) {
    return {.first = first, .stride = stride, .length = length};
}

/// Light from lights and VPLs that participating media scatter to the camera. It is sampled and
/// filtered as irradiance is, on surfaces that are the ends of view rays.
class Media : public Component {
  public:
    explicit Media(const ComponentInputs& inputs);

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext& frame) override { radiance_.reconstruct(frame); }

    void bind_outputs(ComposedIrradiance& composed) const override {
        composed.media = radiance_.filtered();
    }
    [[nodiscard]] const SamplingDecision* decision() const override { return radiance_.adaptive(); }

  private:
    /// A list of virtual lights that slots gather; see media_gather.cl.
    struct Lights {
        Stage stage;
        BufferRef<kinds::VirtualLights> buffer;
        shared::SetList list;
        std::uint32_t steps;
        double roulette;
    };

    void gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots);
    void gather_lights(FrameContext& frame, const InterleavedIrradiance::Slots& slots,
                       const Lights& lights, bool adds);
    void gather_distant(FrameContext& frame, const InterleavedIrradiance::Slots& slots);

    std::unique_ptr<TileGeometry> tiles_;
    DeviceBuffer<kinds::VirtualLights>
        samples_;  ///< on area lights, of all sets; null without such lights
    InterleavedIrradiance radiance_;
};

Media::Media(const ComponentInputs& inputs)
    : tiles_(inputs.plan.adaptive
                 ? std::make_unique<TileGeometry>(inputs.executor, inputs.width, inputs.height)
                 : nullptr),
      radiance_(inputs, name, inputs.buffers.view_media->ends(), tiles_.get(), threshold_share) {
    const FramePlan& plan = inputs.plan;
    if (plan.media_samples_per_set > 0)
        samples_ = allocate<kinds::VirtualLights>(
            inputs.executor, std::size_t{plan.sets} * plan.media_samples_per_set,
            "light samples of media");
}

void Media::gather_lights(FrameContext& frame, const InterleavedIrradiance::Slots& slots,
                          const Lights& lights, bool adds) {
    const std::uint32_t lanes = frame.executor.lanes();
    const GBuffer& ends = frame.buffers.view_media->ends();
    frame.run(
        lights.stage, name,
        kernels::media_gather{.scene = frame.scene_buffers.seen_by_light(),
                              .media_tables = frame.buffers.media(),
                              .list = lights.list,
                              .roulette = static_cast<float>(lights.roulette),
                              .steps = lights.steps,
                              .adds = adds ? 1U : 0U,
                              .slots = slots.stride,
                              .end_position = ends.gb_position,
                              .end_albedo = ends.gb_albedo,
                              .slot_pixel = slots.slot_pixel,
                              .block_set = slots.block_set,
                              .vpls = lights.buffer,
                              .radiance = slots.irradiance,
                              .counters = frame.buffers.counters},
        {.count = slots.count / lanes,
         .per_launch = gather_items_per_launch(frame.executor, lights.list.length * lights.steps),
         .first = slots.first / lanes});
}

void Media::gather_distant(FrameContext& frame, const InterleavedIrradiance::Slots& slots) {
    const GBuffer& ends = frame.buffers.view_media->ends();
    frame.run(Stage::media_distant_light, name,
              kernels::media_distant{.scene = frame.scene_buffers.seen_by_light(),
                                     .media_tables = frame.buffers.media(),
                                     .environment = view(frame.scene_buffers.environment),
                                     .steps = frame.plan.media_steps,
                                     .slots = slots.stride,
                                     .lights = frame.scene_buffers.light_table.lights,
                                     .end_position = ends.gb_position,
                                     .end_albedo = ends.gb_albedo,
                                     .slot_pixel = slots.slot_pixel,
                                     .block_set = slots.block_set,
                                     .radiance = slots.irradiance,
                                     .counters = frame.buffers.counters},
              {.count = slots.count, .first = slots.first});
}

void Media::gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots) {
    const FramePlan& plan = frame.plan;
    const FrameBuffers& buffers = frame.buffers;
    const std::uint32_t sets = plan.gather_sets == 1 ? plan.sets : 1;
    std::vector<Lights> lists;
    if (samples_)
        lists.push_back({Stage::media_area_lights, samples_,
                         list_of(0, plan.media_samples_per_set, plan.media_samples_per_set * sets),
                         1, 0.0});
    if (plan.punctual_lights > 0)
        lists.push_back({Stage::media_punctual_lights, buffers.light_samples,
                         list_of(plan.area_samples(), 0, plan.punctual_lights), plan.media_steps,
                         0.0});
    if (plan.has_vpls())
        lists.push_back({Stage::media_vpls, buffers.vpls,
                         list_of(0, plan.vpls_per_set, plan.vpls_per_set * sets), 1,
                         plan.roulette});
    // Gathering an empty list sets the radiance to 0.
    if (lists.empty()) lists.push_back({Stage::media_clear, {}, list_of(0, 0, 0), 1, 0.0});
    bool adds = false;
    for (const Lights& lights : lists)
        gather_lights(frame, slots, lights, std::exchange(adds, true));
    if (plan.has_distant()) gather_distant(frame, slots);
}

void Media::sample(FrameContext& frame) {
    const FramePlan& plan = frame.plan;
    if (!plan.has_direct()) make_light_samples(frame, name);
    if (samples_) make_media_samples(frame, name, samples_);
    if (!plan.gathers_vpls() && plan.has_vpls()) walk_vpls(frame, name);
    if (tiles_)
        frame.run_whole([&] { tiles_->examine(frame, frame.buffers.view_media->ends(), name); });
    radiance_.sample(frame,
                     [&](const InterleavedIrradiance::Slots& slots) { gather(frame, slots); });
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<Media>(inputs);
}

}  // namespace

ComponentKind media_component() {
    return {name, Choice::by_default, is_enabled, requirements, make};
}

}  // namespace weft
