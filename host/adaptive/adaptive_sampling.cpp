// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/adaptive_sampling.h"

#include <algorithm>
#include <array>
#include <utility>

#include "adaptive/level_layers.h"
#include "base/stopwatch.h"
#include "pipeline/view_media.h"

namespace weft {
namespace {

/// The most slots that a frame may use: one for every pixel, and the padding of every list, of
/// which there is one per round, region and sample set.
std::uint32_t most_slots(const TileGrid& grid, std::uint32_t interleave) {
    constexpr std::uint32_t rounds = 3;
    const std::uint32_t regions = work_regions(grid);
    return (grid.width * grid.height + PACKET_BLOCK - 1) / PACKET_BLOCK * PACKET_BLOCK +
           rounds * regions * interleave * interleave * PACKET_BLOCK;
}

/// Share of the threshold that errors of a sample may reach. The noise of an image falls as samples
/// are added and undersampling errs alike in all of them, so that the mean of its errors has to
/// fall faster.
double threshold_share(const FrameContext& frame) {
    return frame.plan.threshold_falls ? 1.0 / (frame.params.sampling.sample + 1.0) : 1.0;
}

std::uint32_t lattice_points(const TileGrid& grid, Level level) {
    const std::uint32_t stride = stride_of(level);
    return ((grid.width - 1) / stride + 1) * ((grid.height - 1) / stride + 1);
}

}  // namespace

AdaptiveSampling::AdaptiveSampling(Executor& executor, const TileGrid& grid,
                                   const LevelSettings& settings, std::uint32_t features)
    : grid_(grid),
      settings_(settings),
      slope_(settings.luminance_scale),
      memory_(grid.tiles()),
      slots_(most_slots(grid, settings.interleave)),
      no_slots_(std::size_t{grid.width} * grid.height, INVALID_INDEX) {
    const std::size_t planes = receiver_planes(features);
    slot_pixel_ = allocate<kinds::SlotPixels>(executor, slots_, "adaptive work list");
    pixel_slot_ = allocate<kinds::PixelSlots>(executor, no_slots_.size(), "adaptive pixel slots");
    block_set_ =
        allocate<kinds::BlockSets>(executor, slots_ / PACKET_BLOCK, "adaptive sample sets");
    receivers_ = allocate<kinds::ReceiverPlanes>(executor, planes * slots_, "adaptive receivers");
    tile_height_ = allocate<kinds::TileLevels>(executor, grid.tiles(), "tile levels");
    signal_ = allocate<kinds::LatticeSignals>(executor, lattice_points(grid, Level::middle),
                                              "lattice signal");
}

void AdaptiveSampling::sample(FrameContext& frame, const char* component, const GBuffer& gbuffer,
                              TileGeometry& tiles, BufferRef<kinds::SlotLight> irradiance,
                              const Steps& steps) {
    // A cancelled frame may not have written the records of its tiles.
    if (frame.executor.cancelled()) return;
    double host_ms = 0.0;
    const auto round = [&](const auto& decide) {
        frame.wait();
        const Stopwatch watch;
        const bool any = take_round(frame, tiles, decide());
        host_ms += watch.total();
        if (any) run_round(frame, component, gbuffer, steps);
    };
    begin(frame);
    write_buffer(frame.executor, pixel_slot_, no_slots_);
    work_ = {};
    LevelSettings settings = settings_;
    settings.threshold *= threshold_share(frame);
    if (frame.budget != nullptr) settings.threshold *= frame.budget->gain(component);
    scheduler_.emplace(grid_, settings, tiles.records());
    round([&] { return scheduler_->next_round(); });
    if (settings_.threshold > 0.0) {
        if (steps.least_levels) scheduler_->require(steps.least_levels());
        const std::vector<Level> held = memory_.held();
        for (const Level level : {Level::coarse, Level::middle}) {
            scheduler_->hold(held, level == Level::coarse ? Level::middle : Level::full);
            if (level == Level::middle) scheduler_->fade_from(fade_.earlier());
            if (!scheduler_->has(level)) {
                round([&] { return scheduler_->next_round(); });
                continue;
            }
            const auto points = signal(frame, component, gbuffer, level, irradiance, steps.beneath);
            // A frame that ended early may not have written the signal, so nothing is judged.
            if (frame.ended_early()) break;
            round([&] { return scheduler_->refine(level, points, slope_); });
        }
        if (!frame.ended_early()) {
            memory_.add(scheduler_->verdict());
            fade_.show(scheduler_->heights());
        }
    }
    frame.add_host_stage(Stage::scheduling, component, host_ms);
}

void AdaptiveSampling::begin(const FrameContext& frame) {
    if (frame.begins == FrameContext::Begins::sequence) {
        memory_.begin_sequence();
        fade_.begin_sequence();
    }
    if (frame.begins == FrameContext::Begins::image) {
        memory_.begin_image();
        fade_.begin_image();
    }
}

bool AdaptiveSampling::take_round(FrameContext& frame, TileGeometry& tiles, const WorkList& round) {
    if (round.pixels.empty()) return false;
    round_ = work_.pixels.empty() ? tiles.ordered(frame, scheduler_->sampled(), round)
                                  : ordered_round(frame, round);
    work_.pixels.insert(work_.pixels.end(), round_.pixels.begin(), round_.pixels.end());
    work_.block_sets.insert(work_.block_sets.end(), round_.block_sets.begin(),
                            round_.block_sets.end());
    write_buffer(frame.executor, slot_pixel_, work_.pixels);
    write_buffer(frame.executor, block_set_, work_.block_sets);
    return true;
}

void AdaptiveSampling::run_round(FrameContext& frame, const char* component, const GBuffer& gbuffer,
                                 const Steps& steps) {
    const auto count = static_cast<std::uint32_t>(round_.pixels.size());
    const auto first = static_cast<std::uint32_t>(work_.pixels.size()) - count;
    // Runs even in a frame that ends early, because reconstruction finds samples by their pixels.
    frame.run_whole([&] {
        frame.run(Stage::receivers, component,
                  kernels::receivers{.surfaces = view(gbuffer),
                                     .slots = slots_,
                                     .slot_pixel = slot_pixel_,
                                     .view_enclosing_media = frame.buffers.view_enclosing_media(),
                                     .receiver_planes = receivers_,
                                     .pixel_slot = pixel_slot_},
                  {.count = count, .first = first});
    });
    steps.gather(first, count);
}

std::vector<shared::float4> AdaptiveSampling::signal(FrameContext& frame, const char* component,
                                                     const GBuffer& gbuffer, Level level,
                                                     BufferRef<kinds::SlotLight> irradiance,
                                                     const LightBeneath& beneath) {
    const std::uint32_t points = lattice_points(grid_, level);
    frame.run(Stage::heuristic, component,
              kernels::lattice_signal{.surfaces = view(gbuffer),
                                      .lattice_stride = stride_of(level),
                                      .slots = slots_,
                                      .pixel_slot = pixel_slot_,
                                      .irradiance = irradiance,
                                      .beneath_slots = beneath.slots,
                                      .beneath_albedo = beneath.albedo,
                                      .beneath_emission = beneath.emission,
                                      .beneath_pixel_slot = beneath.pixel_slot,
                                      .beneath_irradiance = beneath.irradiance,
                                      .signal = signal_},
              {points});
    return read_buffer(frame.executor, signal_, points);
}

void AdaptiveSampling::reconstruct(FrameContext& frame, const char* component,
                                   const GBuffer& gbuffer, const TileGeometry& tiles,
                                   BufferRef<kinds::SlotLight> irradiance,
                                   BufferRef<kinds::ReconstructedLight> filtered) {
    write_buffer(frame.executor, tile_height_, scheduler_->heights());
    frame.run(Stage::reconstruction, component,
              kernels::reconstruct_tiles{.surfaces = view(gbuffer),
                                         .slots = slots_,
                                         .tiles = tiles.buffer(),
                                         .tile_height = tile_height_,
                                         .pixel_slot = pixel_slot_,
                                         .irradiance = irradiance,
                                         .filtered = filtered},
              {grid_.tiles()});
}

void AdaptiveSampling::add_layers(const std::string& component, Image& image) const {
    add_level_layers(component, *scheduler_, image);
}

}  // namespace weft
