// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <vector>

#include "base/stopwatch.h"
#include "components/component.h"
#include "frame/adaptive_sampling.h"
#include "frame/kept_records.h"
#include "frame/record_pool.h"
#include "frame/record_store.h"
#include "frame/virtual_lights.h"
#include "kernels/cache.h"
#include "schedule/cache_picks.h"

namespace weft {
namespace {

constexpr const char* name = "indirect";

bool called_for(const FramePlan& plan) {
    return plan.has_indirect() && plan.cached;
}

ComponentNeeds needs(const FramePlan& plan) {
    ComponentNeeds needs;
    needs.kernels = {KernelId::vpl_walk, KernelId::cache_tiles, KernelId::cache_records,
                     KernelId::cache_lookup};
    needs.features = FEATURE_INDIRECT;
    if (plan.temporal) {
        needs.kernels.insert(needs.kernels.end(), {KernelId::vpl_doubts, KernelId::cache_doubts});
        needs.features |= FEATURE_TEMPORAL;
    }
    return needs;
}

/// Instant Caching (Debattista et al. 2009): diffuse interreflection from irradiance records, each
/// of which has gathered all VPLs of the frame. Records are placed in rounds: all pixels look up
/// what there is, and where they lack light, a few of them become records, ever closer to each
/// other. With FramePlan::temporal records and VPLs outlast their frame: see KeptRecords.
class InstantCache : public Component {
  public:
    explicit InstantCache(const ComponentInputs& inputs);

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext&) override {}
    void hand_over(ComposedIrradiance& composed) const override {
        composed.indirect = filtered_.get();
    }
    [[nodiscard]] std::optional<CacheStats> cache() const override {
        if (kept_ == nullptr) return {};
        return kept_->stats();
    }

  private:
    /// Adds what the records of a store give to all pixels.
    void look_up(FrameContext& frame, const RecordStore& store);
    [[nodiscard]] std::vector<TileMask> missing_pixels(Executor& executor) const;
    /// Makes records of these pixels.
    void make_records(FrameContext& frame, const std::vector<std::uint32_t>& pixels);

    TileGrid grid_;
    RecordPool pool_;
    RecordStore store_;                  ///< those of a round
    std::unique_ptr<KeptRecords> kept_;  ///< where records outlast their frame
    std::unique_ptr<Buffer> filtered_, missing_, tile_boxes_, pixel_slot_;
};

RecordPool::Settings pool_settings(const ComponentInputs& inputs) {
    const FramePlan& plan = inputs.plan;
    const bool masks = plan.temporal && plan.cache_masks;
    return {inputs.features, plan.temporal, masks ? plan.sets * plan.vpls_per_set : 0};
}

InstantCache::InstantCache(const ComponentInputs& inputs)
    : grid_{inputs.width, inputs.height},
      pool_(inputs.executor, pool_settings(inputs)),
      store_(inputs.executor),
      filtered_(
          inputs.executor.allocate(inputs.pixels() * sizeof(shared::float4), "cached irradiance")),
      missing_(inputs.executor.allocate(grid_.tiles() * sizeof(TileMask), "missing pixels")),
      tile_boxes_(
          inputs.executor.allocate(grid_.tiles() * 2 * sizeof(shared::float4), "bounds of tiles")),
      pixel_slot_(inputs.executor.allocate(inputs.pixels() * sizeof(std::uint32_t),
                                           "pixel slots of records")) {
    if (inputs.plan.temporal)
        kept_ = std::make_unique<KeptRecords>(inputs.executor, inputs.plan, pool_);
}

void InstantCache::look_up(FrameContext& frame, const RecordStore& store) {
    frame.params.cache_records = store.count();
    frame.run(KernelId::cache_lookup, "cache lookup", name, true,
              with_gbuffer(frame.buffers.gbuffer,
                           {tile_boxes_.get(), &store.records(), &store.boxes(), &store.used(),
                            filtered_.get(), missing_.get(), frame.buffers.counters.get()}),
              grid_.tiles());
}

std::vector<TileMask> InstantCache::missing_pixels(Executor& executor) const {
    return read_buffer<TileMask>(executor, *missing_, grid_.tiles());
}

void InstantCache::make_records(FrameContext& frame, const std::vector<std::uint32_t>& pixels) {
    Stopwatch watch;
    WorkList list{pixels, {}};
    list.pixels.resize((pixels.size() + PACKET_BLOCK - 1) / PACKET_BLOCK * PACKET_BLOCK,
                       NO_TRIANGLE);
    list.block_sets.resize(list.pixels.size() / PACKET_BLOCK, 0);
    list = ordered_round(frame, list);
    const std::uint32_t first = pool_.append(list.pixels);
    frame.add_host_stage("record places", name, watch.lap());
    place_records(frame, name, pool_, first, *pixel_slot_);
    pool_.set_states(CACHE_FRESH);
    gather_records(frame, name, "irradiance records", pool_, first, nullptr);
    if (frame.ended_early()) return;
    watch.lap();
    const RecordPool::Contents made = pool_.read(first);
    store_.set(frame.executor, made.records);
    if (kept_) kept_->add(frame, made, list.pixels, first);
    frame.add_host_stage("record store", name, watch.lap());
}

void InstantCache::sample(FrameContext& frame) {
    frame.run_whole([&] {
        frame.run(KernelId::cache_tiles, "tile bounds", name, false,
                  with_gbuffer(frame.buffers.gbuffer,
                               {tile_boxes_.get(), filtered_.get(), missing_.get()}),
                  grid_.tiles());
    });
    if (kept_) {
        kept_->refresh(frame, name);
        if (kept_->store().count() > 0) look_up(frame, kept_->store());
    } else {
        pool_.clear();
        walk_vpls(frame, name);
    }
    for (const std::uint32_t edge : cache_rounds) {
        if (frame.ended_early()) return;
        const std::vector<std::uint32_t> picks =
            pick_missing(grid_, missing_pixels(frame.executor), edge);
        if (picks.empty()) break;
        make_records(frame, picks);
        if (!frame.ended_early()) look_up(frame, store_);
    }
    if (kept_ && !frame.ended_early()) kept_->evict(frame);
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<InstantCache>(inputs);
}

}  // namespace

ComponentKind instant_cache_component() {
    return {"instant_cache", Choice::unnamed, called_for, needs, make};
}

}  // namespace weft
