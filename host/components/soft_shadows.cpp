// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/soft_shadows.h"

#include <algorithm>
#include <utility>

#include "adaptive/brightness.h"
#include "base/stopwatch.h"
#include "pipeline/virtual_lights.h"

namespace weft {
namespace {

constexpr const char* name = "direct";

// Threshold, in just noticeable differences, below which a light gets no further shadow rays: a
// share of the threshold for interpolation, but at most largest_step.
constexpr double step_share = 0.2;
constexpr double largest_step = 2.0;

}  // namespace

SoftShadows::SoftShadows(const ComponentInputs& inputs)
    : executor_(inputs.executor),
      shared_(inputs.buffers),
      grid_{inputs.width, inputs.height},
      words_(shared::visibility_mask_words(inputs.scene.area_lights)) {
    const std::size_t plane = shared::shadow_plane(grid_.width, grid_.height);
    const std::vector<std::uint32_t> nothing(2 * words_ * plane, 0);
    pixel_shadows_ = upload<kinds::PixelShadows>(executor_, nothing, "shadows of pixels");
    slopes_ = upload<kinds::BrightnessSlopes>(
        executor_, BrightnessSlope(inputs.plan.luminance_scale).table(), "brightness slopes");
    const std::vector<std::uint32_t> none(words_ * inputs.pixels(), 0);
    shadow_edges_ = upload<kinds::ShadowEdges>(executor_, none, "shadow edges");
}

void SoftShadows::sample(FrameContext& frame, BufferRef<kinds::VirtualLights> samples,
                         BufferRef<kinds::SlotLight> irradiance) {
    probe(frame, samples, irradiance);
    edges_ = {};
    if (!frame.ended_early()) frame.add_host_stage(Stage::scheduling, name, find_edges());
    refine(frame, samples, irradiance);
}

void SoftShadows::probe(FrameContext& frame, BufferRef<kinds::VirtualLights> samples,
                        BufferRef<kinds::SlotLight> irradiance) {
    const std::uint32_t lanes = executor_.lanes();
    frame.run(Stage::shadow_probes, name,
              kernels::shadow_probes{.scene = frame.scene_buffers.seen_by_light(),
                                     .media_tables = shared_.media(),
                                     .area_lights = frame.scene_buffers.area_lights(),
                                     .slots = shared_.slots,
                                     .receiver_planes = shared_.receivers,
                                     .block_set = shared_.block_set,
                                     .slot_pixel = shared_.slot_pixel,
                                     .samples = samples,
                                     .irradiance = irradiance,
                                     .pixel_shadows = pixel_shadows_,
                                     .counters = shared_.counters},
              {.count = shared_.slots / lanes,
               .per_launch = gather_items_per_launch(executor_, frame.plan.samples_per_set)});
    const std::uint32_t runs = (grid_.width + lanes - 1) / lanes * grid_.height;
    frame.run(Stage::shadow_edges, name,
              kernels::shadow_edges{.pixel_shadows = pixel_shadows_, .shadow_edges = shadow_edges_},
              {runs * words_});
}

double SoftShadows::find_edges() {
    double milliseconds = 0.0;
    executor_.with_mapped(*shadow_edges_, Access::read, [&](std::span<std::byte> bytes) {
        const Stopwatch watch;  // times the search alone: mapping waits for the device
        edges_ = find_shadow_edges(grid_, {reinterpret_cast<const std::uint32_t*>(bytes.data()),
                                           bytes.size() / sizeof(std::uint32_t)});
        milliseconds = watch.total();
    });
    return milliseconds;
}

void SoftShadows::refine(FrameContext& frame, BufferRef<kinds::VirtualLights> samples,
                         BufferRef<kinds::SlotLight> irradiance) {
    const double gain = frame.budget != nullptr ? frame.budget->gain(name) : 1.0;
    step_ = std::min(largest_step, step_share * gain * frame.plan.threshold);
    const std::uint32_t edge = shared::shadow_cell(executor_.lanes(), frame.plan.interleave);
    const std::uint32_t cells =
        ((grid_.width + edge - 1) / edge) * ((grid_.height + edge - 1) / edge);
    // A full cell has as many packets as a packet has lanes; usually a quarter of it is at edges.
    const std::uint32_t packets = std::max(1U, executor_.lanes() / 4);
    frame.run(
        Stage::area_lights, name,
        kernels::soft_shadows{.scene = frame.scene_buffers.seen_by_light(),
                              .media_tables = shared_.media(),
                              .area_lights = frame.scene_buffers.area_lights(),
                              .shadow_step = static_cast<float>(step_),
                              .slots = shared_.slots,
                              .receiver_planes = shared_.receivers,
                              .pixel_slot = shared_.pixel_slot,
                              .samples = samples,
                              .pixel_shadows = pixel_shadows_,
                              .shadow_edges = shadow_edges_,
                              .slopes = slopes_,
                              .gb_albedo = shared_.gbuffer.gb_albedo,
                              .irradiance = irradiance,
                              .counters = shared_.counters},
        {.count = cells * frame.plan.interleave * frame.plan.interleave,
         .per_launch = gather_items_per_launch(executor_, frame.plan.samples_per_set * packets)});
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
    const std::size_t pixels = std::size_t{grid_.width} * grid_.height;
    const auto words = read_buffer(executor_, shadow_edges_, words_ * pixels);
    Layer level{component + ".level", "Y", std::vector<float>(pixels)};
    Layer samples{component + ".samples", "Y", std::vector<float>(pixels)};
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const Level found = shadow_level(words, pixels, pixel);
        level.values[pixel] = static_cast<float>(found);
        samples.values[pixel] = found == Level::full ? 1.0F : 0.0F;
    }
    image.layers.push_back(std::move(level));
    image.layers.push_back(std::move(samples));
}

}  // namespace weft
