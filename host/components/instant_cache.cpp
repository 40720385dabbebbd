// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "components/component.h"
#include "frame/adaptive_sampling.h"
#include "frame/record_store.h"
#include "frame/view_media.h"
#include "frame/virtual_lights.h"
#include "kernels/cache.h"
#include "kernels/receivers.h"
#include "schedule/cache_picks.h"

namespace weft {
namespace {

constexpr const char* name = "indirect";

bool called_for(const FramePlan& plan) {
    return plan.has_indirect() && plan.cached;
}

ComponentNeeds needs(const FramePlan&) {
    ComponentNeeds needs;
    needs.kernels = {KernelId::vpl_walk, KernelId::cache_tiles, KernelId::cache_records,
                     KernelId::cache_lookup};
    needs.features = FEATURE_INDIRECT;
    return needs;
}

/// Instant Caching (Debattista et al. 2009): diffuse interreflection from irradiance records, each
/// of which has gathered all VPLs of the frame. Records are placed in rounds: all pixels look up
/// what there is, and where they lack light, a few of them become records, ever closer to each
/// other.
class InstantCache : public Component {
  public:
    explicit InstantCache(const ComponentInputs& inputs);

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext&) override {}
    void hand_over(ComposedIrradiance& composed) const override {
        composed.indirect = filtered_.get();
    }

  private:
    /// Adds what the records of a round give to all pixels.
    void look_up(FrameContext& frame);
    [[nodiscard]] std::vector<TileMask> missing_pixels(Executor& executor) const;
    /// Makes records of these pixels.
    void make_records(FrameContext& frame, const std::vector<std::uint32_t>& pixels);
    void grow(FrameContext& frame, std::size_t slots);
    void store(FrameContext& frame, const WorkList& list);

    TileGrid grid_;
    RecordStore store_;
    std::unique_ptr<Buffer> filtered_, missing_, tile_boxes_, pixel_slot_;
    /// By slot of a round; see grow.
    std::unique_ptr<Buffer> slot_pixel_, receivers_, planes_;
    std::size_t slots_ = 0;
};

InstantCache::InstantCache(const ComponentInputs& inputs)
    : grid_{inputs.width, inputs.height},
      store_(inputs.executor),
      filtered_(
          inputs.executor.allocate(inputs.pixels() * sizeof(shared::float4), "cached irradiance")),
      missing_(inputs.executor.allocate(grid_.tiles() * sizeof(TileMask), "missing pixels")),
      tile_boxes_(
          inputs.executor.allocate(grid_.tiles() * 2 * sizeof(shared::float4), "bounds of tiles")),
      pixel_slot_(inputs.executor.allocate(inputs.pixels() * sizeof(std::uint32_t),
                                           "pixel slots of records")) {}

void InstantCache::look_up(FrameContext& frame) {
    frame.params.cache_records = store_.count();
    frame.run(KernelId::cache_lookup, "cache lookup", name, true,
              with_gbuffer(frame.buffers.gbuffer,
                           {tile_boxes_.get(), &store_.records(), &store_.boxes(), filtered_.get(),
                            missing_.get(), frame.buffers.counters.get()}),
              grid_.tiles());
}

std::vector<TileMask> InstantCache::missing_pixels(Executor& executor) const {
    return read_buffer<TileMask>(executor, *missing_, grid_.tiles());
}

void InstantCache::grow(FrameContext& frame, std::size_t slots) {
    if (slots <= slots_) return;
    slots_ =
        std::max(slots, std::min(2 * slots_, std::size_t{grid_.tiles()} * TILE_EDGE * TILE_EDGE));
    Executor& executor = frame.executor;
    slot_pixel_ = executor.allocate(slots_ * sizeof(std::uint32_t), "places of records");
    receivers_ = executor.allocate(slots_ * receiver_planes(frame.params.features) * sizeof(float),
                                   "receivers of records");
    planes_ = executor.allocate(slots_ * RECORD_PLANES * sizeof(float), "new records");
}

void InstantCache::make_records(FrameContext& frame, const std::vector<std::uint32_t>& pixels) {
    const Stopwatch watch;
    WorkList list{pixels, {}};
    list.pixels.resize((pixels.size() + PACKET_BLOCK - 1) / PACKET_BLOCK * PACKET_BLOCK,
                       NO_TRIANGLE);
    list.block_sets.resize(list.pixels.size() / PACKET_BLOCK, 0);
    list = ordered_round(frame, list);
    grow(frame, list.pixels.size());
    write_buffer<std::uint32_t>(frame.executor, *slot_pixel_, list.pixels);
    frame.add_host_stage("record places", name, watch.total());

    const auto count = static_cast<std::uint32_t>(list.pixels.size());
    const std::uint32_t slots_before = std::exchange(frame.params.slots, count);
    frame.run(KernelId::receivers, "receivers", name, false,
              with_gbuffer(frame.buffers.gbuffer, {slot_pixel_.get(), view_inside(frame.buffers),
                                                   receivers_.get(), pixel_slot_.get()}),
              count);
    frame.params.list_first = 0;
    frame.params.list_length = frame.plan.sets * frame.plan.vpls_per_set;
    const float roulette_before =
        std::exchange(frame.params.roulette, static_cast<float>(frame.plan.cache_roulette));
    std::vector<Buffer*> arguments = with_media(frame.buffers, {});
    for (Buffer* const buffer : with_gbuffer(
             frame.buffers.gbuffer, {receivers_.get(), slot_pixel_.get(), frame.buffers.vpls.get(),
                                     planes_.get(), frame.buffers.counters.get()}))
        arguments.push_back(buffer);
    frame.run(KernelId::cache_records, "irradiance records", name, true, arguments,
              count / frame.executor.lanes(),
              gather_items_per_launch(frame.executor, frame.params.list_length));
    frame.params.slots = slots_before;
    frame.params.roulette = roulette_before;
    if (!frame.ended_early()) store(frame, list);
}

void InstantCache::store(FrameContext& frame, const WorkList& list) {
    const Stopwatch watch;
    const std::size_t count = list.pixels.size();
    const std::size_t planes = receiver_planes(frame.params.features);
    const auto values =
        read_buffer<float>(frame.executor, *planes_, count * std::size_t{RECORD_PLANES});
    const auto places = read_buffer<float>(frame.executor, *receivers_, count * planes);
    std::vector<shared::CacheRecord> records;
    for (std::size_t slot = 0; slot < count; ++slot) {
        if (list.pixels[slot] == NO_TRIANGLE) continue;
        const auto plane = [&](std::size_t i) { return values[i * count + slot]; };
        const auto three = [&](std::size_t i, float w) {
            return shared::float4{plane(i), plane(i + 1), plane(i + 2), w};
        };
        const auto place = [&](std::size_t i, float w) {
            return shared::float4{places[i * count + slot], places[(i + 1) * count + slot],
                                  places[(i + 2) * count + slot], w};
        };
        records.push_back(
            {three(RECORD_PLACE, plane(RECORD_RADIUS)), place(RECEIVER_X, 0.0F),
             place(RECEIVER_SHADING_X, plane(RECORD_GUARDED)), three(RECORD_LIGHT, 0.0F),
             three(RECORD_MOVE, 0.0F), three(RECORD_MOVE + 3, 0.0F), three(RECORD_MOVE + 6, 0.0F),
             three(RECORD_TURN, 0.0F), three(RECORD_TURN + 3, 0.0F), three(RECORD_TURN + 6, 0.0F)});
    }
    store_.set(frame.executor, records);
    frame.add_host_stage("record store", name, watch.total());
}

void InstantCache::sample(FrameContext& frame) {
    frame.run_whole([&] {
        frame.run(KernelId::cache_tiles, "tile bounds", name, false,
                  with_gbuffer(frame.buffers.gbuffer,
                               {tile_boxes_.get(), filtered_.get(), missing_.get()}),
                  grid_.tiles());
    });
    walk_vpls(frame, name);
    for (const std::uint32_t edge : cache_rounds) {
        if (frame.ended_early()) return;
        const std::vector<std::uint32_t> picks =
            pick_missing(grid_, missing_pixels(frame.executor), edge);
        if (picks.empty()) return;
        make_records(frame, picks);
        if (!frame.ended_early()) look_up(frame);
    }
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<InstantCache>(inputs);
}

}  // namespace

ComponentKind instant_cache_component() {
    return {"instant_cache", Choice::unnamed, called_for, needs, make};
}

}  // namespace weft
