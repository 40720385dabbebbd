// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include "base/stopwatch.h"
#include "cache/cache_picks.h"
#include "cache/cached_pixels.h"
#include "cache/record_pool.h"
#include "cache/record_store.h"
#include "cache/temporal_record_cache.h"
#include "components/component.h"
#include "kernels/cache/cache.h"
#include "pipeline/virtual_lights.h"

namespace weft {
namespace {

constexpr const char* name = "indirect";

bool is_enabled(const FramePlan& plan) {
    return plan.gathers_vpls() && plan.cached;
}

ComponentRequirements requirements(const FramePlan& plan) {
    ComponentRequirements requirements;
    requirements.kernels = {KernelId::receivers, KernelId::cache_tiles, KernelId::cache_records,
                            KernelId::cache_lookup};
    std::ranges::copy(vpl_kernels(plan), std::back_inserter(requirements.kernels));
    requirements.features = FEATURE_INDIRECT;
    if (plan.temporal) {
        requirements.kernels.insert(requirements.kernels.end(),
                                    {KernelId::vpl_invalidation, KernelId::record_invalidation});
        requirements.features |= FEATURE_TEMPORAL;
    }
    return requirements;
}

/// Instant Caching (Debattista et al. 2009): diffuse interreflection from irradiance records, each
/// of which has gathered all VPLs of the frame. Records are placed in rounds: all pixels look up
/// the records that exist, and of those that lack irradiance a few become records, closer together
/// in every round. With FramePlan::temporal records and VPLs outlast their frame: see
/// TemporalRecordCache.
class InstantCache : public Component {
  public:
    explicit InstantCache(const ComponentInputs& inputs);

    void sample(FrameContext& frame) override;
    void reconstruct(FrameContext&) override {}
    [[nodiscard]] double light_share(FrameContext& frame) const override {
        return pixels_.lit_share(frame.executor);
    }
    void bind_outputs(ComposedIrradiance& composed) const override {
        composed.indirect = pixels_.irradiance();
    }
    [[nodiscard]] std::optional<CacheStats> cache() const override {
        if (kept_ == nullptr) return {};
        return kept_->stats();
    }

  private:
    /// Makes records of these pixels.
    void make_records(FrameContext& frame, const std::vector<std::uint32_t>& pixels);

    CachedPixels pixels_;
    RecordPool pool_;
    RecordStore store_;                          ///< the records of a round
    std::unique_ptr<TemporalRecordCache> kept_;  ///< null unless records outlast their frame
    DeviceBuffer<kinds::PixelSlots> pixel_slot_;
};

RecordPool::Settings pool_settings(const ComponentInputs& inputs) {
    const FramePlan& plan = inputs.plan;
    const bool masks = plan.temporal && plan.cache_masks;
    return {inputs.features, plan.temporal, masks ? plan.sets * plan.vpls_per_set : 0};
}

InstantCache::InstantCache(const ComponentInputs& inputs)
    : pixels_(inputs.executor, inputs.width, inputs.height),
      pool_(inputs.executor, pool_settings(inputs)),
      store_(inputs.executor),
      pixel_slot_(
          allocate<kinds::PixelSlots>(inputs.executor, inputs.pixels(), "pixel slots of records")) {
    if (inputs.plan.temporal)
        kept_ = std::make_unique<TemporalRecordCache>(inputs.executor, inputs.plan, pool_);
}

void InstantCache::make_records(FrameContext& frame, const std::vector<std::uint32_t>& pixels) {
    Stopwatch watch;
    const std::vector<std::uint32_t> ordered = record_order(frame, pixels);
    const std::uint32_t first = pool_.append(ordered);
    frame.add_host_stage(Stage::record_places, name, watch.lap());
    place_records(frame, name, pool_, first, pixel_slot_);
    pool_.set_states(CACHE_FRESH);
    gather_records(frame, name, Stage::irradiance_records, pool_, first, nullptr);
    if (frame.ended_early()) return;
    frame.wait();
    watch.lap();
    const RecordPool::Contents made = pool_.read(first);
    store_.set(frame.executor, made.records);
    if (kept_) kept_->add(frame, made, ordered, first);
    frame.add_host_stage(Stage::record_store, name, watch.lap());
}

void InstantCache::sample(FrameContext& frame) {
    pixels_.begin_frame(frame, name);
    if (kept_) {
        kept_->refresh(frame, name);
        if (kept_->store().count() > 0) pixels_.look_up(frame, name, kept_->store());
    } else {
        pool_.clear();
        walk_vpls(frame, name);
    }
    for (const std::uint32_t edge : cache_rounds) {
        if (frame.ended_early()) return;
        const std::vector<std::uint32_t> picks = pixels_.picks(frame.executor, edge);
        if (picks.empty()) break;
        make_records(frame, picks);
        if (!frame.ended_early()) pixels_.look_up(frame, name, store_);
    }
    if (kept_ && !frame.ended_early()) kept_->evict(frame);
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<InstantCache>(inputs);
}

}  // namespace

ComponentKind instant_cache_component() {
    return {"instant_cache", Choice::unnamed, is_enabled, requirements, make};
}

}  // namespace weft
