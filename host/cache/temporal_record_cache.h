// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_TEMPORAL_RECORD_CACHE_H
#define WEFT_CACHE_TEMPORAL_RECORD_CACHE_H

#include <cstdint>
#include <span>
#include <vector>

#include "cache/record_pool.h"
#include "cache/record_store.h"
#include "pipeline/frame_context.h"
#include "pipeline/frame_renderer.h"
#include "pipeline/scene_motion.h"
#include "pipeline/virtual_lights.h"

namespace weft {

/// Fills the receivers of a pool's slots from `first` on with the surfaces of their pixels.
void place_records(FrameContext& frame, const char* component, const RecordPool& pool,
                   std::uint32_t first, BufferRef<kinds::PixelSlots> pixel_slot);

/// Gathers VPLs into the records of the slots from `first` on, as the states of their packets
/// require. `motion`: what has moved; null where all of them are computed for the first time.
void gather_records(FrameContext& frame, const char* component, Stage stage, const RecordPool& pool,
                    std::uint32_t first, const SceneMotion* motion);

/// Temporal Instant Caching (Debattista et al. 2009): records and VPLs outlast their frame, and
/// only light paths that a change has invalidated are computed again. Those are the segments of
/// light paths, and the connections of VPLs with records, that meet anything that has moved, where
/// it was or where it is; and all connections of VPLs that are elsewhere. Records on what has moved
/// are dropped. Afterwards every record holds, bit for bit, what it would if it were computed anew.
class TemporalRecordCache {
  public:
    /// Keeps the records of `pool`, which must outlive the cache.
    TemporalRecordCache(Executor& executor, const FramePlan& plan, RecordPool& pool);

    /// Updates VPLs and records to what the scene is now, before a frame looks anything up. At the
    /// beginning of a sequence, and after a frame that ended during an update, no record is kept.
    void refresh(FrameContext& frame, const char* component);
    /// Adds records that have just been made, in the pool's slots from `first` on, of `pixels`.
    void add(FrameContext& frame, const RecordPool::Contents& made,
             std::span<const std::uint32_t> pixels, std::uint32_t first);
    /// After a frame: drops the least recently used records beyond FramePlan::cache_records.
    void evict(FrameContext& frame);

    /// The records that earlier frames have made.
    [[nodiscard]] const RecordStore& store() const { return store_; }
    /// Statistics of the frame.
    [[nodiscard]] const CacheStats& stats() const { return stats_; }

  private:
    void start_over(FrameContext& frame, const char* component);
    void follow_changes(FrameContext& frame, const char* component);
    void update_records(FrameContext& frame, const char* component);
    void drop_moved();
    void compact();
    void fill_store(Executor& executor);
    /// Drops records that others have made dispensable, once there are many more of them than after
    /// the last pruning.
    void prune(RecordPool::Contents& contents);
    void validate(FrameContext& frame, const char* component);

    /// What the host knows of a slot of the pool.
    struct Slot {
        std::uint32_t instance = 0;
        std::uint32_t last_used = 0;  ///< frame, counted from the first
        bool live = false;
    };

    const FramePlan& plan_;
    RecordPool& pool_;
    SceneMotion motion_;
    LightPaths paths_;
    RecordStore store_;
    std::vector<std::uint32_t> store_slots_;
    std::vector<Slot> slots_;
    std::size_t pruned_to_ = 0;  ///< number of records after the last pruning
    std::uint32_t frame_ = 0;
    bool usable_ = false;        ///< VPLs and records are those of the scene last observed
    bool store_is_old_ = false;  ///< the store does not hold what the pool does
    CacheStats stats_;
};

}  // namespace weft

#endif
