// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_CACHE_RECORD_POOL_H
#define WEFT_CACHE_RECORD_POOL_H

#include <cstdint>
#include <span>
#include <vector>

#include "device/device_buffer.h"

namespace weft {

/// Keeps the irradiance records that a device computes, by slot: their receivers, their values,
/// and, of records that outlast their frame, which VPLs they see. Slots in use are a whole number
/// of packets; those that hold no record are invalid receivers.
class RecordPool {
  public:
    struct Settings {
        std::uint32_t features = 0;   ///< of the frames
        bool temporal = false;        ///< records may be computed again
        std::uint32_t mask_vpls = 0;  ///< number of VPLs in the mask of a record
    };
    RecordPool(Executor& executor, const Settings& settings);

    /// Slots in use.
    [[nodiscard]] std::uint32_t slots() const { return slots_; }
    /// Slots that are allocated: the stride of all planes.
    [[nodiscard]] std::uint32_t room() const { return room_; }
    /// Words of the masks of a packet; see kernels/cache/cache_masks.h.
    [[nodiscard]] std::uint32_t words() const { return words_; }
    /// Bytes that a record takes on the device.
    [[nodiscard]] std::size_t bytes_per_record() const;

    void clear() { slots_ = 0; }
    /// Adds slots for the records of these pixels, a whole number of packets. Returns the first.
    std::uint32_t append(std::span<const std::uint32_t> pixels);
    /// Sets what is to be done with every packet: CACHE_* of kernels/cache/cache.h.
    void set_states(std::uint32_t state);
    /// Reads the state of every packet from the device.
    [[nodiscard]] std::vector<std::uint32_t> states();

    /// How many connections of all packets are stale; see kernels/cache/cache_masks.h.
    [[nodiscard]] std::uint64_t count_invalid_connections();

    /// Records with the slots that they are in.
    struct Contents {
        std::vector<shared::CacheRecord> records;
        std::vector<std::uint32_t> slots;
    };
    /// Reads the records in the slots from `first` on.
    [[nodiscard]] Contents read(std::uint32_t first);
    /// Reads the RECORD_* planes, whose stride is room().
    [[nodiscard]] std::vector<float> read_planes();
    /// Makes receivers of these slots invalid.
    void invalidate(std::span<const std::uint32_t> slots);
    /// Drops all records but those in these slots, which move to the first slots in this order.
    void keep(std::span<const std::uint32_t> slots);

    [[nodiscard]] BufferRef<kinds::ReceiverPlanes> receivers() const { return receivers_; }
    [[nodiscard]] BufferRef<kinds::SlotPixels> slot_pixel() const { return slot_pixel_; }
    [[nodiscard]] BufferRef<kinds::RecordPlanes> planes() const { return planes_; }
    [[nodiscard]] BufferRef<kinds::PacketStates> packet_states() const { return states_; }
    [[nodiscard]] BufferRef<kinds::InvalidConnections> invalid() const { return invalid_; }
    [[nodiscard]] BufferRef<kinds::VisibleConnections> seen() const { return seen_; }

  private:
    void make_room(std::uint32_t slots);
    void allocate(std::uint32_t room);
    [[nodiscard]] std::uint32_t packets(std::uint32_t slots) const;

    Executor& executor_;
    Settings settings_;
    std::uint32_t lanes_, receiver_planes_, words_;
    std::uint32_t slots_ = 0;
    std::uint32_t room_ = 0;
    std::vector<std::uint32_t> pixels_;
    DeviceBuffer<kinds::ReceiverPlanes> receivers_;
    DeviceBuffer<kinds::SlotPixels> slot_pixel_;
    DeviceBuffer<kinds::RecordPlanes> planes_;
    DeviceBuffer<kinds::PacketStates> states_;
    DeviceBuffer<kinds::InvalidConnections> invalid_;
    DeviceBuffer<kinds::VisibleConnections> seen_;
};

}  // namespace weft

#endif
