// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/view_chains.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "pipeline/view_media.h"
#include "pipeline/virtual_lights.h"

namespace weft {
namespace {

std::uint32_t feature_of(ViewWay way) {
    switch (way) {
        case ViewWay::reflection:
            return FEATURE_REFLECTION;
        case ViewWay::glossy:
            return FEATURE_GLOSSY;
        case ViewWay::refraction:
            break;
    }
    return FEATURE_REFRACTION;
}

/// Whether neighbouring pixels see different facets, over which what they show is averaged.
bool sees_rough_facets(const FramePlan& plan, ViewWay way) {
    return way == ViewWay::glossy || (way == ViewWay::refraction && plan.rough_glass);
}

/// Whether the ends get indirect light.
bool gathers_vpls(const FramePlan& plan) {
    return plan.indirect && plan.has_vpls();
}

/// The component of direct light of the image's surfaces, or null.
const Component* direct_of(std::span<const ActiveComponent> earlier) {
    for (const ActiveComponent& other : earlier) {
        const auto slots = other.component->slot_irradiance();
        if (slots && slots->part == LightPart::direct && !slots->undersampled)
            return other.component.get();
    }
    return nullptr;
}

}  // namespace

ComponentRequirements requirements_of_view_chains(const FramePlan& plan, ViewWay way) {
    ComponentRequirements requirements = requirements_of_interleaved(plan.adaptive);
    requirements.features = feature_of(way);
    if (sees_rough_facets(plan, way)) requirements.kernels.push_back(KernelId::filter_chains);
    // Its tiles are its own: those of the ends.
    requirements.own_tiles = std::exchange(requirements.tiles, false);
    requirements.kernels.insert(
        requirements.kernels.end(),
        {KernelId::view_chains, KernelId::vpl_gather, KernelId::chain_radiance});
    if (plan.has_direct()) requirements.kernels.push_back(KernelId::light_samples);
    if (plan.direct && plan.has_distant()) {
        requirements.kernels.push_back(KernelId::distant_light);
        if (plan.directional_lights > 0) requirements.features |= FEATURE_DIRECTIONAL_LIGHTS;
    }
    if (gathers_vpls(plan))
        std::ranges::copy(vpl_kernels(plan), std::back_inserter(requirements.kernels));
    return requirements;
}

ViewChains::ViewChains(const ComponentInputs& inputs, const char* name, ViewWay way)
    : name_(name),
      way_(way),
      direct_(direct_of(inputs.earlier)),
      ends_(allocate_gbuffer(inputs.executor, inputs.pixels(), "ends of view rays")),
      tiles_(inputs.plan.adaptive
                 ? std::make_unique<TileGeometry>(inputs.executor, inputs.width, inputs.height)
                 : nullptr),
      irradiance_(inputs, name, ends_, tiles_.get()) {
    if (!tiles_)
        receivers_ = allocate<kinds::ReceiverPlanes>(
            inputs.executor, receiver_planes(inputs.features) * inputs.buffers.slots,
            "ends of view rays");
    if (!sees_rough_facets(inputs.plan, way)) return;
    shares_ = allocate<kinds::ViewShares>(inputs.executor, inputs.pixels(), "glossy light");
    shown_ = allocate<kinds::ReconstructedLight>(inputs.executor, inputs.pixels(), "glossy light");
}

void ViewChains::trace(FrameContext& frame) {
    const GBuffer& seen = frame.buffers.gbuffer;
    frame.run(Stage::view_chains, name_,
              kernels::view_chains{
                  .scene = *frame.scene_buffers.traced,
                  .geometry = view(frame.scene_buffers.geometry),
                  .surfaces = view(frame.scene_buffers.surfaces),
                  .light_table = view(frame.scene_buffers.light_table),
                  .light_nodes = frame.scene_buffers.light_nodes,
                  .environment = view(frame.scene_buffers.environment),
                  .way_number = static_cast<std::uint32_t>(way_),
                  .samples_lights = way_ == ViewWay::glossy && frame.plan.direct ? 1U : 0U,
                  .keeps_shares = shares_ ? 1U : 0U,
                  .gb_ids = seen.gb_ids,
                  .gb_position = seen.gb_position,
                  .end_ids = ends_.gb_ids,
                  .end_position = ends_.gb_position,
                  .end_normal = ends_.gb_normal,
                  .end_shading = ends_.gb_shading,
                  .end_albedo = ends_.gb_albedo,
                  .end_emission = ends_.gb_emission,
                  .view_shares = shares_,
                  .counters = frame.buffers.counters},
              {frame.pixels()});
    if (tiles_) {
        tiles_->examine(frame, ends_, name_);
        return;
    }
    frame.run(Stage::receivers, name_,
              kernels::receivers{.surfaces = view(ends_),
                                 .slots = frame.buffers.slots,
                                 .slot_pixel = frame.buffers.slot_pixel,
                                 .view_enclosing_media = frame.buffers.view_enclosing_media(),
                                 .receiver_planes = receivers_,
                                 .pixel_slot = frame.buffers.pixel_slot},
              {frame.buffers.slots});
}

void ViewChains::gather_list(FrameContext& frame, const InterleavedIrradiance::Slots& slots,
                             Stage stage, BufferRef<kinds::VirtualLights> lights,
                             const shared::SetList& list, bool adds) {
    const std::uint32_t lanes = frame.executor.lanes();
    const bool vpls = stage == Stage::vpl_gather;
    frame.run(
        stage, name_,
        kernels::vpl_gather{
            .scene = frame.scene_buffers.seen_by_light(),
            .media_tables = frame.buffers.media(),
            .list = list,
            .by_chance =
                vpls ? std::bit_cast<std::uint32_t>(static_cast<float>(frame.plan.roulette)) : 0,
            .adds = adds ? 1U : 0U,
            .slots = slots.stride,
            .receiver_planes =
                receivers_ ? BufferRef<kinds::ReceiverPlanes>(receivers_) : slots.receivers,
            .block_set = slots.block_set,
            .vpls = lights,
            .survival = BufferRef<kinds::VplSurvival>(),
            .irradiance = slots.irradiance,
            .counters = frame.buffers.counters},
        {.count = slots.count / lanes,
         .per_launch = gather_items_per_launch(frame.executor, list.length),
         .first = slots.first / lanes});
}

void ViewChains::gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots) {
    const FramePlan& plan = frame.plan;
    const FrameBuffers& buffers = frame.buffers;
    const std::uint32_t sets = plan.gather_sets == 1 ? plan.sets : 1;
    // The first list, which may be empty, replaces what is there.
    const std::uint32_t area = plan.direct ? plan.samples_per_set : 0;
    gather_list(frame, slots, Stage::area_lights, buffers.light_samples,
                {.first = 0, .stride = area, .length = area * sets}, false);
    if (plan.direct && plan.punctual_lights > 0)
        gather_list(frame, slots, Stage::punctual_lights, buffers.light_samples,
                    {.first = plan.area_samples(), .stride = 0, .length = plan.punctual_lights},
                    true);
    if (gathers_vpls(plan))
        gather_list(frame, slots, Stage::vpl_gather, buffers.vpls,
                    {.first = 0, .stride = plan.vpls_per_set, .length = plan.vpls_per_set * sets},
                    true);
    if (!plan.direct || !plan.has_distant()) return;
    frame.run(Stage::distant_light, name_,
              kernels::distant_light{
                  .scene = frame.scene_buffers.seen_by_light(),
                  .media_tables = buffers.media(),
                  .list = shared::SetList{.first = plan.area_samples() + plan.punctual_lights,
                                          .stride = plan.environment_samples,
                                          .length = plan.environment_samples},
                  .slots = slots.stride,
                  .receiver_planes =
                      receivers_ ? BufferRef<kinds::ReceiverPlanes>(receivers_) : slots.receivers,
                  .block_set = slots.block_set,
                  .lights = frame.scene_buffers.light_table.lights,
                  .environment_record = frame.scene_buffers.environment.environment_record,
                  .environment_irradiance = frame.scene_buffers.environment_irradiance,
                  .samples = buffers.light_samples,
                  .sampled_irradiance = slots.irradiance,
                  .exact_irradiance = slots.irradiance,
                  .counters = buffers.counters},
              {.count = slots.count, .first = slots.first});
}

LightBeneath ViewChains::light_beneath(const FrameContext& frame) const {
    if (direct_ == nullptr) return {};
    const SlotIrradiance direct = *direct_->slot_irradiance();
    return {.albedo = frame.buffers.gbuffer.gb_albedo,
            .emission = frame.buffers.gbuffer.gb_emission,
            .pixel_slot = frame.buffers.pixel_slot,
            .irradiance = direct.irradiance,
            .slots = direct.stride};
}

void ViewChains::sample(FrameContext& frame) {
    frame.run_whole([&] { trace(frame); });
    irradiance_.sample(
        frame, [&](const InterleavedIrradiance::Slots& slots) { gather(frame, slots); }, {},
        light_beneath(frame));
}

void ViewChains::reconstruct(FrameContext& frame) {
    irradiance_.reconstruct(frame);
    frame.run(Stage::reconstruction, name_,
              kernels::chain_radiance{.end_albedo = ends_.gb_albedo,
                                      .end_emission = ends_.gb_emission,
                                      .light = irradiance_.filtered()},
              {frame.pixels()});
    if (!shown_) return;
    frame.run(Stage::reconstruction, name_,
              kernels::filter_chains{.surfaces = view(frame.buffers.gbuffer),
                                     .view_shares = shares_,
                                     .radiance = irradiance_.filtered(),
                                     .shown = shown_},
              {frame.pixels()});
}

void ViewChains::bind_outputs(ComposedIrradiance& composed) const {
    const BufferRef<kinds::ReconstructedLight> light =
        shown_ ? BufferRef<kinds::ReconstructedLight>(shown_) : irradiance_.filtered();
    switch (way_) {
        case ViewWay::reflection:
            composed.reflection = light;
            break;
        case ViewWay::glossy:
            composed.glossy = light;
            break;
        case ViewWay::refraction:
            composed.refraction = light;
            break;
    }
}

}  // namespace weft
