// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/soft_shadows.h"

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "frame/virtual_lights.h"
#include "schedule/brightness.h"

namespace weft {
namespace {

constexpr const char* name = "direct";

// What one look at a light may mean to the eye, in just noticeable differences, for its others to
// be left out: a share of the threshold for interpolation, and at most so much.
constexpr double step_share = 0.2;
constexpr double largest_step = 2.0;

}  // namespace

SoftShadows::SoftShadows(const ComponentInputs& inputs)
    : executor_(inputs.executor),
      shared_(inputs.buffers),
      grid_{inputs.width, inputs.height},
      groups_(std::min(inputs.scene.area_lights, SHADOW_GROUPS)),
      pixel_block_(pixel_blocks(inputs.work, inputs.pixels())) {
    const std::vector<std::uint32_t> nothing(
        std::size_t{shared::shadow_pitch(grid_.width)} * (grid_.height + 2 * SHADOW_REACH), 0);
    pixel_shadows_ = upload<std::uint32_t>(executor_, nothing, "shadows of pixels");
    slopes_ = upload<float>(executor_, BrightnessSlope(inputs.plan.luminance_scale).table(),
                            "brightness slopes");
    const std::vector<std::uint32_t> none(inputs.pixels(), 0);
    shadow_edges_ = upload<std::uint32_t>(executor_, none, "shadow edges");
    shadow_blocks_ = executor_.allocate(shared_.slots / PACKET_BLOCK * sizeof(std::uint32_t),
                                        "blocks of shadow edges");
}

void SoftShadows::sample(FrameContext& frame, Buffer& samples, Buffer& irradiance) {
    frame.params.shadow_groups = groups_;
    look(frame, samples, irradiance);
    edges_ = {};
    if (frame.ended_early()) return;
    const Stopwatch watch;
    edges_ = find_edges();
    write_buffer<std::uint32_t>(executor_, *shadow_blocks_, edges_.blocks);
    frame.add_host_stage("scheduling", name, watch.total());
    look_again(frame, samples, irradiance);
}

void SoftShadows::look(FrameContext& frame, Buffer& samples, Buffer& irradiance) {
    frame.run(KernelId::shadow_probes, "shadow probes", name, true,
              with_lamps(frame, {shared_.receivers.get(), shared_.block_set.get(),
                                 shared_.slot_pixel.get(), &samples, &irradiance,
                                 pixel_shadows_.get(), shared_.counters.get()}),
              shared_.slots / executor_.lanes(),
              gather_items_per_launch(executor_, frame.plan.samples_per_set));
    const std::uint32_t runs = (grid_.width + SHADOW_RUN - 1) / SHADOW_RUN * grid_.height;
    frame.run(KernelId::shadow_edges, "shadow edges", name, false,
              {pixel_shadows_.get(), shadow_edges_.get()}, runs);
}

ShadowEdges SoftShadows::find_edges() {
    ShadowEdges found;
    executor_.with_mapped(*shadow_edges_, Access::read, [&](std::span<std::byte> bytes) {
        const std::span edges(reinterpret_cast<const std::uint32_t*>(bytes.data()),
                              pixel_block_.size());
        found = find_shadow_edges(grid_, edges, pixel_block_, shared_.slots / PACKET_BLOCK);
    });
    return found;
}

void SoftShadows::look_again(FrameContext& frame, Buffer& samples, Buffer& irradiance) {
    const double gain = frame.budget != nullptr ? frame.budget->gain(name) : 1.0;
    step_ = std::min(largest_step, step_share * gain * frame.plan.threshold);
    frame.params.shadow_step = static_cast<float>(step_);
    const auto blocks = static_cast<std::uint32_t>(edges_.blocks.size());
    frame.run(KernelId::soft_shadows, "area lights", name, true,
              with_lamps(frame, {shared_.receivers.get(), shared_.block_set.get(),
                                 shared_.slot_pixel.get(), shadow_blocks_.get(), &samples,
                                 pixel_shadows_.get(), shadow_edges_.get(), slopes_.get(),
                                 shared_.gbuffer[gbuffer_albedo].get(), &irradiance,
                                 shared_.counters.get()}),
              blocks * (PACKET_BLOCK / executor_.lanes()),
              gather_items_per_launch(executor_, frame.plan.samples_per_set));
}

bool SoftShadows::can_save() const {
    return edges_.pixels > 0 && step_ < largest_step;
}

LevelCounts SoftShadows::counts() const {
    LevelCounts counts;
    for (const Level level : edges_.levels) ++counts.tiles[static_cast<std::size_t>(level)];
    counts.samples = edges_.pixels;
    return counts;
}

void SoftShadows::add_layers(const std::string& component, Image& image) const {
    const auto edges = read_buffer<std::uint32_t>(executor_, *shadow_edges_, pixel_block_.size());
    Layer level{component + ".level", "Y", std::vector<float>(edges.size())};
    Layer samples{component + ".samples", "Y", std::vector<float>(edges.size())};
    const std::uint32_t all = (1U << groups_) - 1U;
    for (std::size_t pixel = 0; pixel < edges.size(); ++pixel) {
        level.values[pixel] = edges[pixel] == 0 ? 0.0F : edges[pixel] == all ? 2.0F : 1.0F;
        samples.values[pixel] = edges[pixel] == 0 ? 0.0F : 1.0F;
    }
    image.layers.push_back(std::move(level));
    image.layers.push_back(std::move(samples));
}

}  // namespace weft
