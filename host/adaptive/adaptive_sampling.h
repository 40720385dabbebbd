// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_ADAPTIVE_ADAPTIVE_SAMPLING_H
#define WEFT_ADAPTIVE_ADAPTIVE_SAMPLING_H

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "adaptive/level_fade.h"
#include "adaptive/level_scheduler.h"
#include "adaptive/sampling_decision.h"
#include "pipeline/frame_context.h"
#include "pipeline/tile_geometry.h"

namespace weft {

/// The light of the image's own surfaces, on top of which the light of a component is seen that
/// samples others. Errors are as visible as they are beside it.
struct LightBeneath {
    BufferRef<kinds::SurfaceAlbedo> albedo;
    BufferRef<kinds::SurfaceEmission> emission;
    BufferRef<kinds::PixelSlots> pixel_slot;
    BufferRef<kinds::SlotLight> irradiance;
    std::uint32_t slots = 0;  ///< stride of its planes; 0: there is no such light
};

/// Samples one component adaptively: makes the samples that its LevelScheduler decides on, and
/// reconstructs the pixels between them.
class AdaptiveSampling : public SamplingDecision {
  public:
    /// The steps of a frame that each component does in its own way.
    struct Steps {
        /// Makes the samples of slots [first, first + count), both multiples of PACKET_BLOCK.
        std::function<void(std::uint32_t first, std::uint32_t count)> gather;
        /// Optional: returns the least level of each tile once the coarse lattice has its samples.
        std::function<std::vector<Level>()> least_levels{};
        LightBeneath beneath{};
    };

    AdaptiveSampling(Executor& executor, const TileGrid& grid, const LevelSettings& settings,
                     std::uint32_t features);

    /// The most slots that a frame may use, and the stride of this component's planes.
    [[nodiscard]] std::uint32_t slots() const { return slots_; }
    /// Whether pixels may go without samples.
    [[nodiscard]] bool undersamples() const { return settings_.threshold > 0.0; }
    [[nodiscard]] BufferRef<kinds::ReceiverPlanes> receivers() const { return receivers_; }
    [[nodiscard]] BufferRef<kinds::BlockSets> block_set() const { return block_set_; }
    [[nodiscard]] BufferRef<kinds::SlotPixels> slot_pixel() const { return slot_pixel_; }
    [[nodiscard]] BufferRef<kinds::PixelSlots> pixel_slot() const { return pixel_slot_; }

    /// Runs all rounds of a frame, in which `steps` makes samples of the surfaces of `gbuffer` and
    /// leaves their irradiance, by slot, in `irradiance`. `tiles` are the tiles of the G-buffer.
    void sample(FrameContext& frame, const char* component, const GBuffer& gbuffer,
                TileGeometry& tiles, BufferRef<kinds::SlotLight> irradiance, const Steps& steps);

    /// Reconstructs the irradiance of every pixel from that of the slots.
    void reconstruct(FrameContext& frame, const char* component, const GBuffer& gbuffer,
                     const TileGeometry& tiles, BufferRef<kinds::SlotLight> irradiance,
                     BufferRef<kinds::ReconstructedLight> filtered);

    [[nodiscard]] LevelCounts counts() const override {
        return {scheduler_->tiles_by_level(), scheduler_->samples()};
    }
    [[nodiscard]] bool can_save() const override { return scheduler_->can_save(); }
    [[nodiscard]] bool can_spend() const override { return scheduler_->can_spend(); }
    void add_layers(const std::string& component, Image& image) const override;
    [[nodiscard]] std::uint32_t slots_used() const {
        return static_cast<std::uint32_t>(work_.pixels.size());
    }

  private:
    /// Begins a sequence or an image in memory_ and fade_ where the frame is the first of one.
    void begin(const FrameContext& frame);
    /// Orders a round and adds it to the work list on the device; returns whether it has any pixel.
    bool take_round(FrameContext& frame, TileGeometry& tiles, const WorkList& round);
    void run_round(FrameContext& frame, const char* component, const GBuffer& gbuffer,
                   const Steps& steps);
    [[nodiscard]] std::vector<shared::float4> signal(FrameContext& frame, const char* component,
                                                     const GBuffer& gbuffer, Level level,
                                                     BufferRef<kinds::SlotLight> irradiance,
                                                     const LightBeneath& beneath);

    TileGrid grid_;
    LevelSettings settings_;
    BrightnessSlope slope_;
    LevelHysteresis memory_;
    LevelFade fade_;
    std::uint32_t slots_;
    DeviceBuffer<kinds::SlotPixels> slot_pixel_;
    DeviceBuffer<kinds::PixelSlots> pixel_slot_;
    DeviceBuffer<kinds::BlockSets> block_set_;
    DeviceBuffer<kinds::ReceiverPlanes> receivers_;
    DeviceBuffer<kinds::TileLevels> tile_height_;
    DeviceBuffer<kinds::LatticeSignals> signal_;
    std::vector<std::uint32_t> no_slots_;
    std::optional<LevelScheduler> scheduler_;
    WorkList round_;
    WorkList work_;  ///< pixels of all rounds so far
};

}  // namespace weft

#endif
