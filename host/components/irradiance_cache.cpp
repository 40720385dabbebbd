// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "base/stopwatch.h"
#include "cache/cache_picks.h"
#include "cache/cached_pixels.h"
#include "cache/neighbour_clamping.h"
#include "cache/record_pool.h"
#include "cache/record_store.h"
#include "cache/temporal_record_cache.h"
#include "components/component.h"
#include "kernels/cache/cache.h"

namespace weft {
namespace {

constexpr const char* name = "indirect";

/// Most bytes of hemisphere cells at a time; it limits how many records a batch makes.
constexpr std::size_t cell_bytes = std::size_t{32} << 20;

bool is_enabled(const FramePlan& plan) {
    return plan.has_indirect() && plan.traces_hemispheres();
}

ComponentRequirements requirements(const FramePlan&) {
    ComponentRequirements requirements;
    requirements.kernels = {KernelId::receivers, KernelId::cache_tiles, KernelId::hemisphere_rays,
                            KernelId::hemisphere_records, KernelId::cache_lookup};
    requirements.features = FEATURE_INDIRECT | FEATURE_HEMISPHERES;
    return requirements;
}

std::uint32_t cells_of(const FramePlan& plan) {
    return plan.cache_elevations * plan.cache_azimuths;
}

/// Irradiance caching (Ward, Rubinstein and Clear 1988; Ward and Heckbert 1992): diffuse
/// interreflection from irradiance records, each of which has traced rays into the hemisphere above
/// it. They are placed in the rounds of instant_cache.cpp. After each round radii are clamped by
/// those of neighbours (Krivanek et al. 2006), and all pixels look up all records anew. Does not
/// support participating media: the program refuses scenes with any.
class IrradianceCache : public Component {
  public:
    explicit IrradianceCache(const ComponentInputs& inputs);

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext&) override {}
    [[nodiscard]] double light_share(FrameContext& frame) const override {
        return pixels_.lit_share(frame.executor);
    }
    void bind_outputs(ComposedIrradiance& composed) const override {
        composed.indirect = pixels_.irradiance();
    }

  private:
    /// Makes records of these pixels. Returns the first of their slots in the pool.
    std::uint32_t make_records(FrameContext& frame, const std::vector<std::uint32_t>& pixels);
    /// Traces the rays of the records of `count` slots from `first` on, and sums them up.
    void trace_batch(FrameContext& frame, std::uint32_t first, std::uint32_t count);
    /// Fills the store with the records of slots from `first` on, clamped by those of all slots.
    void fill_store(FrameContext& frame, std::uint32_t first);

    CachedPixels pixels_;
    RecordPool pool_;
    RecordStore store_;
    std::uint32_t batch_;  ///< slots
    DeviceBuffer<kinds::PixelSlots> pixel_slot_;
    DeviceBuffer<kinds::HemisphereCells> cells_;
};

/// Slots of a batch: no more than a round can fill.
std::uint32_t batch_of(const ComponentInputs& inputs) {
    const std::size_t bytes = cells_of(inputs.plan) * sizeof(shared::float4);
    const std::size_t slots = std::min(cell_bytes / bytes, inputs.pixels() + PACKET_BLOCK - 1);
    return static_cast<std::uint32_t>(std::max<std::size_t>(1, slots / PACKET_BLOCK) *
                                      PACKET_BLOCK);
}

IrradianceCache::IrradianceCache(const ComponentInputs& inputs)
    : pixels_(inputs.executor, inputs.width, inputs.height),
      pool_(inputs.executor, {inputs.features, false, 0}),
      store_(inputs.executor),
      batch_(batch_of(inputs)),
      pixel_slot_(
          allocate<kinds::PixelSlots>(inputs.executor, inputs.pixels(), "pixel slots of records")),
      cells_(allocate<kinds::HemisphereCells>(
          inputs.executor, std::size_t{batch_} * cells_of(inputs.plan), "hemispheres of records")) {
}

void IrradianceCache::trace_batch(FrameContext& frame, std::uint32_t first, std::uint32_t count) {
    const FrameBuffers& buffers = frame.buffers;
    const shared::HemisphereGrid grid{.first = first,
                                      .elevations = frame.plan.cache_elevations,
                                      .azimuths = frame.plan.cache_azimuths};
    frame.run(Stage::hemisphere_rays, name,
              kernels::hemisphere_rays{.scene = *frame.scene_buffers.traced,
                                       .geometry = view(frame.scene_buffers.geometry),
                                       .light_table = view(frame.scene_buffers.light_table),
                                       .light_nodes = frame.scene_buffers.light_nodes,
                                       .environment = view(frame.scene_buffers.environment),
                                       .grid = grid,
                                       .slots = pool_.room(),
                                       .receiver_planes = pool_.receivers(),
                                       .slot_pixel = pool_.slot_pixel(),
                                       .cells = cells_,
                                       .counters = buffers.counters,
                                       .nonfinite = buffers.nonfinite},
              {count * cells_of(frame.plan)});
    frame.run(Stage::irradiance_records, name,
              kernels::hemisphere_records{.surfaces = view(buffers.gbuffer),
                                          .grid = grid,
                                          .slots = pool_.room(),
                                          .receiver_planes = pool_.receivers(),
                                          .slot_pixel = pool_.slot_pixel(),
                                          .cells = cells_,
                                          .records = pool_.planes()},
              {count});
}

std::uint32_t IrradianceCache::make_records(FrameContext& frame,
                                            const std::vector<std::uint32_t>& pixels) {
    Stopwatch watch;
    const std::uint32_t first = pool_.append(record_order(frame, pixels));
    frame.add_host_stage(Stage::record_places, name, watch.lap());
    place_records(frame, name, pool_, first, pixel_slot_);
    for (std::uint32_t slot = first; slot < pool_.slots(); slot += batch_)
        trace_batch(frame, slot, std::min(batch_, pool_.slots() - slot));
    return first;
}

void IrradianceCache::fill_store(FrameContext& frame, std::uint32_t first) {
    frame.wait();
    Stopwatch watch;
    RecordPool::Contents all = pool_.read(0);
    const std::vector<float> planes = pool_.read_planes();
    std::vector<shared::float4> places;
    places.reserve(all.records.size());
    for (const shared::CacheRecord& record : all.records) places.push_back(record.position);
    const std::vector<float> radii = neighbour_clamped(places, frame.plan.cache_error);
    std::vector<shared::CacheRecord> records;
    for (std::size_t i = 0; i < all.records.size(); ++i) {
        const std::uint32_t slot = all.slots[i];
        if (slot < first) continue;
        const float least = planes[std::size_t{RECORD_LEAST} * pool_.room() + slot];
        records.push_back(all.records[i]);
        records.back().position.w = std::max(radii[i], least);
    }
    store_.set(frame.executor, records);
    frame.add_host_stage(Stage::record_store, name, watch.lap());
}

void IrradianceCache::sample(FrameContext& frame) {
    pool_.clear();
    pixels_.begin_frame(frame, name);
    for (const std::uint32_t edge : cache_rounds) {
        if (frame.ended_early()) return;
        const std::vector<std::uint32_t> picks = pixels_.picks(frame.executor, edge);
        if (picks.empty()) break;
        const std::uint32_t first = make_records(frame, picks);
        if (frame.ended_early()) return;
        // The last round makes a record of every pixel that lacks irradiance. It must not take
        // irradiance from other pixels, so its records clamp none that were made before.
        const bool last = edge == *std::rbegin(cache_rounds);
        fill_store(frame, last ? first : 0);
        frame.run_whole([&] {
            if (!last) pixels_.begin(frame, name);
            pixels_.look_up(frame, name, store_);
        });
    }
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<IrradianceCache>(inputs);
}

}  // namespace

ComponentKind irradiance_cache_component() {
    return {"irradiance_cache", Choice::unnamed, is_enabled, requirements, make};
}

}  // namespace weft
