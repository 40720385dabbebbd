// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/temporal_record_cache.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/stopwatch.h"
#include "cache/prune_records.h"
#include "cache/validate_cache.h"
#include "kernels/cache/cache.h"
#include "pipeline/view_media.h"

namespace weft {
namespace {

/// Share of slots without a record beyond which the others are moved together.
constexpr double most_waste = 0.25;
/// Factor by which the number of records has to grow before they are pruned again.
constexpr double growth_to_prune = 1.1;
/// Weight with which others have to serve a record's place for it to be dispensable.
constexpr double enough_weight = 2.0;

std::uint32_t vpls_of(const FramePlan& plan) {
    return plan.sets * plan.vpls_per_set;
}

/// How the records of a pool gather the VPLs of a frame after that motion, or, where it is null,
/// for the first time.
shared::RecordUpdate update_of(const FramePlan& plan, const RecordPool& pool,
                               const SceneMotion* motion) {
    return {.vpls = vpls_of(plan),
            .roulette = static_cast<float>(plan.cache_roulette),
            .mask_words = pool.words(),
            .moved_boxes = motion != nullptr ? motion->box_count() : 0};
}

template <class T>
bool same_bits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

}  // namespace

void place_records(FrameContext& frame, const char* component, const RecordPool& pool,
                   std::uint32_t first, BufferRef<kinds::PixelSlots> pixel_slot) {
    frame.run(Stage::receivers, component,
              kernels::receivers{.surfaces = view(frame.buffers.gbuffer),
                                 .slots = pool.room(),
                                 .slot_pixel = pool.slot_pixel(),
                                 .view_enclosing_media = frame.buffers.view_enclosing_media(),
                                 .receiver_planes = pool.receivers(),
                                 .pixel_slot = pixel_slot},
              {.count = pool.slots() - first, .first = first});
}

void gather_records(FrameContext& frame, const char* component, Stage stage, const RecordPool& pool,
                    std::uint32_t first, const SceneMotion* motion) {
    const std::uint32_t lanes = frame.executor.lanes();
    const shared::RecordUpdate update = update_of(frame.plan, pool, motion);
    frame.run(
        stage, component,
        kernels::cache_records{
            .scene = frame.scene_buffers.seen_by_light(),
            .media_tables = frame.buffers.media(),
            .surfaces = view(frame.buffers.gbuffer),
            .update = update,
            .slots = pool.room(),
            .receiver_planes = pool.receivers(),
            .slot_pixel = pool.slot_pixel(),
            .vpls = frame.buffers.vpls,
            .moved_boxes = motion != nullptr ? motion->boxes() : BufferRef<kinds::MovedBounds>(),
            .states = pool.packet_states(),
            .invalid = pool.invalid(),
            .seen = pool.seen(),
            .records = pool.planes(),
            .counters = frame.buffers.counters},
        {.count = (pool.slots() - first) / lanes,
         .per_launch = gather_items_per_launch(frame.executor, update.vpls),
         .first = first / lanes});
}

TemporalRecordCache::TemporalRecordCache(Executor& executor, const FramePlan& plan,
                                         RecordPool& pool)
    : plan_(plan), pool_(pool), motion_(executor), paths_(executor, plan), store_(executor) {}

void TemporalRecordCache::refresh(FrameContext& frame, const char* component) {
    stats_ = {};
    ++frame_;
    const bool begins = frame.begins != FrameContext::Begins::nothing;
    if (begins) frame.wait();
    const Stopwatch watch;
    if (begins) motion_.observe(frame.executor, frame.scene);
    frame.add_host_stage(Stage::scene_changes, component, watch.total());
    // After an early end the pool may hold records that were not finished.
    if (slots_.size() != pool_.slots()) usable_ = false;
    if (frame.begins == FrameContext::Begins::sequence || !usable_ || (begins && motion_.all()))
        start_over(frame, component);
    else if (begins && motion_.any())
        follow_changes(frame, component);
    if (frame.ended_early()) usable_ = false;
    if (!usable_) return;
    if (store_is_old_) {
        frame.wait();
        const Stopwatch filling;
        fill_store(frame.executor);
        frame.add_host_stage(Stage::record_store, component, filling.total());
    }
    stats_.kept = store_.count();
    stats_.bytes = pool_.bytes_per_record() * pool_.room();
}

void TemporalRecordCache::start_over(FrameContext& frame, const char* component) {
    pool_.clear();
    slots_.clear();
    pruned_to_ = 0;
    store_is_old_ = true;
    paths_.walk(frame, component, motion_, false);
    usable_ = true;
}

void TemporalRecordCache::follow_changes(FrameContext& frame, const char* component) {
    drop_moved();
    compact();
    paths_.walk(frame, component, motion_, true);
    update_records(frame, component);
    if (plan_.validate_cache && !frame.ended_early()) validate(frame, component);
}

void TemporalRecordCache::update_records(FrameContext& frame, const char* component) {
    if (pool_.slots() == 0) return;
    const std::uint32_t lanes = frame.executor.lanes();
    const shared::RecordUpdate update = update_of(plan_, pool_, &motion_);
    frame.run(Stage::record_invalidation, component,
              kernels::record_invalidation{.scene = motion_.traced(),
                                           .update = update,
                                           .slots = pool_.room(),
                                           .receiver_planes = pool_.receivers(),
                                           .records = pool_.planes(),
                                           .vpls = frame.buffers.vpls,
                                           .vpl_changes = paths_.changes(),
                                           .moved_boxes = motion_.boxes(),
                                           .invalid = pool_.invalid(),
                                           .states = pool_.packet_states(),
                                           .counters = frame.buffers.counters},
              {.count = pool_.slots() / lanes,
               .per_launch = gather_items_per_launch(frame.executor, update.vpls)});
    gather_records(frame, component, Stage::record_updates, pool_, 0, &motion_);
    if (frame.ended_early()) return;
    store_is_old_ = true;
    const std::vector<std::uint32_t> states = pool_.states();
    for (std::uint32_t slot = 0; slot < pool_.slots(); ++slot)
        stats_.updated += slots_[slot].live && states[slot / lanes] != CACHE_KEEP ? 1 : 0;
}

void TemporalRecordCache::drop_moved() {
    std::vector<std::uint32_t> gone;
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot)
        if (slots_[slot].live && motion_.moved_instances()[slots_[slot].instance]) {
            slots_[slot].live = false;
            gone.push_back(slot);
        }
    if (gone.empty()) return;
    stats_.dropped += static_cast<std::uint32_t>(gone.size());
    pool_.invalidate(gone);
    store_is_old_ = true;
}

void TemporalRecordCache::compact() {
    std::vector<std::uint32_t> live;
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot)
        if (slots_[slot].live) live.push_back(slot);
    if (static_cast<double>(slots_.size() - live.size()) <=
        most_waste * static_cast<double>(slots_.size()))
        return;
    pool_.keep(live);
    std::vector<Slot> kept;
    kept.reserve(pool_.slots());
    for (const std::uint32_t slot : live) kept.push_back(slots_[slot]);
    kept.resize(pool_.slots());
    slots_ = std::move(kept);
    store_is_old_ = true;
}

void TemporalRecordCache::fill_store(Executor& executor) {
    RecordPool::Contents contents = pool_.read(0);
    prune(contents);
    store_.set(executor, contents.records);
    store_slots_ = std::move(contents.slots);
    store_is_old_ = false;
}

void TemporalRecordCache::prune(RecordPool::Contents& contents) {
    // Objects that move leave small records behind, closer to each other than is needed later. The
    // first records are only counted: if they were pruned, a scene that does not change would have
    // to make some of them again.
    if (pruned_to_ == 0) pruned_to_ = contents.records.size();
    if (static_cast<double>(contents.records.size()) <
        growth_to_prune * static_cast<double>(pruned_to_))
        return;
    const std::vector<std::size_t> surplus =
        dispensable_records(contents.records, plan_.cache_error, enough_weight);
    std::vector<std::uint32_t> gone;
    for (const std::size_t i : surplus) gone.push_back(contents.slots[i]);
    for (const std::uint32_t slot : gone) slots_[slot].live = false;
    pool_.invalidate(gone);
    stats_.evicted += static_cast<std::uint32_t>(gone.size());
    const auto keep = [&](auto& values) {
        std::size_t at = 0;
        std::size_t next = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (next < surplus.size() && surplus[next] == i)
                ++next;
            else
                values[at++] = values[i];
        }
        values.resize(at);
    };
    keep(contents.records);
    keep(contents.slots);
    pruned_to_ = contents.records.size();
}

void TemporalRecordCache::add(FrameContext& frame, const RecordPool::Contents& made,
                              std::span<const std::uint32_t> pixels, std::uint32_t first) {
    slots_.resize(pool_.slots());
    frame.executor.with_mapped(
        *frame.buffers.gbuffer.gb_ids, Access::read, [&](std::span<std::byte> bytes) {
            const std::span ids(reinterpret_cast<const std::uint32_t*>(bytes.data()),
                                bytes.size() / sizeof(std::uint32_t));
            for (const std::uint32_t slot : made.slots)
                slots_[slot] = {ids[std::size_t{2} * pixels[slot - first]], frame_, true};
        });
    stats_.made += static_cast<std::uint32_t>(made.slots.size());
    store_is_old_ = true;
}

void TemporalRecordCache::evict(FrameContext& frame) {
    const std::vector<std::uint32_t> used = store_.read_used(frame.executor);
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i] != 0) slots_[store_slots_[i]].last_used = frame_;
    std::vector<std::uint32_t> live;
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot)
        if (slots_[slot].live) live.push_back(slot);
    if (live.size() <= plan_.cache_records) {
        compact();
        return;
    }
    const std::size_t surplus = live.size() - plan_.cache_records;
    std::stable_sort(live.begin(), live.end(), [&](std::uint32_t a, std::uint32_t b) {
        return slots_[a].last_used < slots_[b].last_used;
    });
    live.resize(surplus);
    for (const std::uint32_t slot : live) slots_[slot].live = false;
    pool_.invalidate(live);
    stats_.evicted += static_cast<std::uint32_t>(live.size());
    store_is_old_ = true;
    compact();
}

void TemporalRecordCache::validate(FrameContext& frame, const char* component) {
    const std::uint32_t updated = stats_.updated;
    stats_.traced = pool_.count_invalid_connections();
    const RecordPool::Contents followed = pool_.read(0);
    const auto vpls = read_buffer(frame.executor, frame.buffers.vpls, vpls_of(plan_));
    const auto changes = read_buffer(frame.executor, paths_.changes(), vpls_of(plan_));
    stats_.affected = affected_connections(followed.records, vpls, changes, motion_.triangles());
    motion_.invalidate_everything(frame.executor);
    paths_.walk(frame, component, motion_, false);
    paths_.invalidate_all(frame.executor);
    update_records(frame, component);
    if (frame.ended_early()) return;
    const RecordPool::Contents anew = pool_.read(0);
    const auto vpls_anew = read_buffer(frame.executor, frame.buffers.vpls, vpls_of(plan_));
    for (std::size_t i = 0; i < vpls.size(); ++i)
        stats_.differing += same_bits(vpls[i], vpls_anew[i]) ? 0 : 1;
    for (std::size_t i = 0; i < anew.records.size(); ++i)
        stats_.differing += same_bits(followed.records[i], anew.records[i]) ? 0 : 1;
    stats_.updated = updated;
    motion_.forget();
}

}  // namespace weft
