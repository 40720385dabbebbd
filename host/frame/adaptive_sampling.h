// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FRAME_ADAPTIVE_SAMPLING_H
#define WEFT_FRAME_ADAPTIVE_SAMPLING_H

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "frame/frame_context.h"
#include "schedule/level_scheduler.h"

namespace weft {

/// The tiles of a picture and what the G-buffer says of them, for all adaptive components.
class TileGeometry {
  public:
    TileGeometry(Executor& executor, std::uint32_t width, std::uint32_t height);

    /// Launches tile_geometry.cl on the frame's G-buffer and reads its records.
    void examine(FrameContext& frame);

    [[nodiscard]] const TileGrid& grid() const { return grid_; }
    [[nodiscard]] std::span<const shared::TileRecord> records() const { return records_; }
    [[nodiscard]] Buffer& buffer() const { return *buffer_; }

  private:
    TileGrid grid_;
    std::unique_ptr<Buffer> buffer_;
    std::vector<shared::TileRecord> records_;
};

/// Samples of one component where its scheduler wants them: executes what LevelScheduler decides.
class AdaptiveSampling {
  public:
    /// What a component does in a frame.
    struct Steps {
        /// Makes the samples of slots [first, first + count), both multiples of PACKET_BLOCK.
        std::function<void(std::uint32_t first, std::uint32_t count)> gather;
        /// Where given: tells, once the coarse lattice has its samples, the least level of each
        /// tile.
        std::function<std::vector<Level>()> least_levels;
    };

    AdaptiveSampling(Executor& executor, const TileGrid& grid, const LevelSettings& settings,
                     std::uint32_t features);

    /// Slots that a frame needs at most; the stride of this component's planes.
    [[nodiscard]] std::uint32_t slots() const { return slots_; }
    [[nodiscard]] Buffer& receivers() const { return *receivers_; }
    [[nodiscard]] Buffer& block_set() const { return *block_set_; }
    [[nodiscard]] Buffer& slot_pixel() const { return *slot_pixel_; }
    [[nodiscard]] Buffer& pixel_slot() const { return *pixel_slot_; }
    /// The round that is being gathered.
    [[nodiscard]] const WorkList& last_round() const { return round_; }

    /// All rounds of a frame: `irradiance` by slot, made by `steps`.
    void sample(FrameContext& frame, const char* component, const TileGeometry& tiles,
                Buffer& irradiance, const Steps& steps);

    /// Irradiance by slot to irradiance of every pixel.
    void reconstruct(FrameContext& frame, const char* component, const TileGeometry& tiles,
                     Buffer& irradiance, Buffer& filtered);

    /// Of the last frame.
    [[nodiscard]] const LevelScheduler& scheduler() const { return *scheduler_; }
    [[nodiscard]] std::uint32_t slots_used() const {
        return static_cast<std::uint32_t>(work_.pixels.size());
    }

  private:
    /// Orders a round and adds it to the work list on the device; returns whether it has any pixel.
    bool take_round(FrameContext& frame, const WorkList& round);
    void run_round(FrameContext& frame, const char* component, const Steps& steps);
    [[nodiscard]] std::vector<shared::float4> signal(FrameContext& frame, const char* component,
                                                     Level level, Buffer& irradiance);

    TileGrid grid_;
    LevelSettings settings_;
    std::uint32_t slots_;
    std::unique_ptr<Buffer> slot_pixel_, pixel_slot_, block_set_, receivers_;
    std::unique_ptr<Buffer> tile_stride_, signal_;
    std::vector<std::uint32_t> no_slots_;
    std::optional<LevelScheduler> scheduler_;
    WorkList round_;
    WorkList work_;  ///< of all rounds so far
};

}  // namespace weft

#endif
