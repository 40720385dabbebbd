// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/stopwatch.h"
#include "components/interleaved_irradiance.h"
#include "plan/halton.h"

namespace weft {
namespace {

constexpr const char* name = "occlusion";

bool is_enabled(const FramePlan& plan) {
    return plan.requests(name);
}

ComponentRequirements requirements(const FramePlan& plan) {
    ComponentRequirements requirements = requirements_of_interleaved(plan.adaptive);
    requirements.kernels.push_back(KernelId::ambient_occlusion);
    return requirements;
}

/// Least levels that sample tiles with creases in full: occlusion is strongest within a few pixels
/// of where surfaces meet, which a lattice may miss.
std::vector<Level> levels_at_creases(std::span<const shared::TileRecord> tiles) {
    std::vector<Level> least;
    for (const shared::TileRecord& tile : tiles) {
        const bool crease = (tile.fine[0] | tile.fine[1] | tile.middle[0] | tile.middle[1]) != 0;
        least.push_back(crease ? Level::full : Level::coarse);
    }
    return least;
}

/// Ambient occlusion: the share, weighted by the cosine, of the hemisphere over each pixel's
/// surface that is open. It is sampled as irradiance, that of a white sky of radiance 1 that begins
/// at the reach, over pi: so its error is judged, like that of light, as it looks on the surface.
class AmbientOcclusion : public Component {
  public:
    explicit AmbientOcclusion(const ComponentInputs& inputs)
        : reach_(occlusion_reach * static_cast<double>(inputs.scene.radius)),
          directions_(allocate<kinds::OcclusionDirections>(
              inputs.executor, std::size_t{inputs.plan.sets} * occlusion_directions_per_set,
              "occlusion directions")),
          irradiance_(inputs, name, inputs.buffers.gbuffer, inputs.buffers.tiles.get()),
          sums_(inputs.pixels(), 0.0) {}

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext& frame) override;
    [[nodiscard]] const SamplingDecision* decision() const override {
        return irradiance_.adaptive();
    }
    void add_layers(Image& image) const override;

  private:
    void gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots);
    void add_frame(Executor& executor);

    double reach_;  ///< kernel units
    DeviceBuffer<kinds::OcclusionDirections> directions_;
    InterleavedIrradiance irradiance_;
    std::vector<double> sums_;  ///< of openness, by pixel, over the frames of the image
    std::uint32_t frames_ = 0;
};

void AmbientOcclusion::sample(FrameContext& frame) {
    const shared::SamplingParams& sampling = frame.params.sampling;
    const std::vector<shared::float4> directions =
        occlusion_directions(frame.plan.sets, sampling.sample, sampling.seed, reach_);
    write_buffer(frame.executor, directions_, directions);
    irradiance_.sample(
        frame, [&](const InterleavedIrradiance::Slots& slots) { gather(frame, slots); },
        [&] { return levels_at_creases(frame.buffers.tiles->records()); });
}

void AmbientOcclusion::gather(FrameContext& frame, const InterleavedIrradiance::Slots& slots) {
    const bool all = frame.plan.gather_sets == 1;
    const shared::SetList list{
        .first = 0,
        .stride = occlusion_directions_per_set,
        .length = occlusion_directions_per_set * (all ? frame.plan.sets : 1)};
    frame.run(Stage::occlusion_rays, name,
              kernels::ambient_occlusion{.scene = *frame.scene_buffers.traced,
                                         .list = list,
                                         .slots = slots.stride,
                                         .receiver_planes = slots.receivers,
                                         .block_set = slots.block_set,
                                         .directions = directions_,
                                         .irradiance = slots.irradiance,
                                         .counters = frame.buffers.counters},
              {.count = slots.count, .first = slots.first});
}

void AmbientOcclusion::reconstruct(FrameContext& frame) {
    irradiance_.reconstruct(frame);
    frame.wait();
    const Stopwatch watch;
    if (frame.params.sampling.sample == 0) {
        std::fill(sums_.begin(), sums_.end(), 0.0);
        frames_ = 0;
    }
    add_frame(frame.executor);
    frame.add_host_stage(Stage::occlusion_layer, name, watch.total());
}

void AmbientOcclusion::add_frame(Executor& executor) {
    constexpr auto over_pi = static_cast<float>(std::numbers::inv_pi);
    ++frames_;
    executor.with_mapped(
        *irradiance_.filtered(), Access::read, [&](std::span<const std::byte> bytes) {
            const auto* const filtered = reinterpret_cast<const shared::float4*>(bytes.data());
            for (std::size_t pixel = 0; pixel < sums_.size(); ++pixel) {
                const shared::float4& value = filtered[pixel];
                // Nothing occludes a pixel without a surface.
                const float open =
                    value.w > 0.0F ? std::clamp(value.x * over_pi, 0.0F, 1.0F) : 1.0F;
                sums_[pixel] += static_cast<double>(open);
            }
        });
}

void AmbientOcclusion::add_layers(Image& image) const {
    const double share = 1.0 / std::max(1U, frames_);
    Layer layer{name, "Y", {}};
    for (const double sum : sums_) layer.values.push_back(static_cast<float>(sum * share));
    image.layers.push_back(std::move(layer));
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<AmbientOcclusion>(inputs);
}

}  // namespace

std::vector<shared::float4> occlusion_directions(std::uint32_t sets, std::uint32_t frame,
                                                 std::uint32_t seed, double reach) {
    // The shifts must differ from those of the sample positions within pixels.
    const std::uint32_t key = seed ^ 0x6C078965U;
    const double shift_u = shift_of(key, 0);
    const double shift_v = shift_of(key, 1);
    const std::uint32_t count = sets * occlusion_directions_per_set;
    std::vector<shared::float4> directions;
    directions.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t index = frame * count + i;
        const double u = shifted_halton(2, index, shift_u);
        const double angle = 2.0 * std::numbers::pi * shifted_halton(3, index, shift_v);
        const double radius = std::sqrt(u);
        directions.push_back({static_cast<float>(radius * std::cos(angle)),
                              static_cast<float>(radius * std::sin(angle)),
                              static_cast<float>(std::sqrt(1.0 - u)), static_cast<float>(reach)});
    }
    return directions;
}

ComponentKind ambient_occlusion_component() {
    return {name, Choice::on_request, is_enabled, requirements, make};
}

}  // namespace weft
