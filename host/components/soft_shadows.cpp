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
      words_(shared::shadow_words(inputs.scene.area_lights)) {
    const std::size_t plane = shared::shadow_plane(grid_.width, grid_.height);
    const std::vector<std::uint32_t> nothing(2 * words_ * plane, 0);
    pixel_shadows_ = upload<std::uint32_t>(executor_, nothing, "shadows of pixels");
    slopes_ = upload<float>(executor_, BrightnessSlope(inputs.plan.luminance_scale).table(),
                            "brightness slopes");
    const std::vector<std::uint32_t> none(words_ * inputs.pixels(), 0);
    shadow_edges_ = upload<std::uint32_t>(executor_, none, "shadow edges");
}

void SoftShadows::sample(FrameContext& frame, Buffer& samples, Buffer& irradiance) {
    look(frame, samples, irradiance);
    edges_ = {};
    if (frame.ended_early()) return;
    frame.add_host_stage(Stage::scheduling, name, find_edges());
    look_again(frame, samples, irradiance);
}

void SoftShadows::look(FrameContext& frame, Buffer& samples, Buffer& irradiance) {
    frame.run(KernelId::shadow_probes, Stage::shadow_probes, name, true,
              with_lamps(frame, {shared_.receivers.get(), shared_.block_set.get(),
                                 shared_.slot_pixel.get(), &samples, &irradiance,
                                 pixel_shadows_.get(), shared_.counters.get()}),
              shared_.slots / executor_.lanes(),
              gather_items_per_launch(executor_, frame.plan.samples_per_set));
    const std::uint32_t lanes = executor_.lanes();
    const std::uint32_t runs = (grid_.width + lanes - 1) / lanes * grid_.height;
    frame.run(KernelId::shadow_edges, Stage::shadow_edges, name, false,
              {pixel_shadows_.get(), shadow_edges_.get()}, runs * words_);
}

double SoftShadows::find_edges() {
    double milliseconds = 0.0;
    executor_.with_mapped(*shadow_edges_, Access::read, [&](std::span<std::byte> bytes) {
        const Stopwatch watch;  // of the search: mapping waits for what the device still does
        edges_ = find_shadow_edges(grid_, {reinterpret_cast<const std::uint32_t*>(bytes.data()),
                                           bytes.size() / sizeof(std::uint32_t)});
        milliseconds = watch.total();
    });
    return milliseconds;
}

void SoftShadows::look_again(FrameContext& frame, Buffer& samples, Buffer& irradiance) {
    const double gain = frame.budget != nullptr ? frame.budget->gain(name) : 1.0;
    step_ = std::min(largest_step, step_share * gain * frame.plan.threshold);
    frame.params.shadow_step = static_cast<float>(step_);
    const std::uint32_t edge = shared::shadow_cell(executor_.lanes(), frame.plan.interleave);
    const std::uint32_t cells =
        ((grid_.width + edge - 1) / edge) * ((grid_.height + edge - 1) / edge);
    // A full cell has as many packets as a packet has lanes; edges are usually of a quarter.
    const std::uint32_t packets = std::max(1U, executor_.lanes() / 4);
    frame.run(KernelId::soft_shadows, Stage::area_lights, name, true,
              with_lamps(frame, {shared_.receivers.get(), shared_.pixel_slot.get(), &samples,
                                 pixel_shadows_.get(), shadow_edges_.get(), slopes_.get(),
                                 shared_.gbuffer[gbuffer_albedo].get(), &irradiance,
                                 shared_.counters.get()}),
              cells * frame.plan.interleave * frame.plan.interleave,
              gather_items_per_launch(executor_, frame.plan.samples_per_set * packets));
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
    const auto words = read_buffer<std::uint32_t>(executor_, *shadow_edges_, words_ * pixels);
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
