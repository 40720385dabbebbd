// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "cache/record_pool.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "kernels/cache/cache.h"
#include "kernels/core/receivers.h"
#include "pipeline/frame_context.h"

namespace weft {
namespace {

constexpr std::uint32_t least_slots = 4096;

std::uint32_t whole_blocks(std::size_t slots) {
    return static_cast<std::uint32_t>((slots + PACKET_BLOCK - 1) / PACKET_BLOCK * PACKET_BLOCK);
}

/// Where the bits of a packet and a VPL are, as kernels/cache/cache_masks.h lays them out.
struct MaskLayout {
    std::uint32_t lanes, words, vpls;

    [[nodiscard]] std::size_t word(std::uint32_t slot, std::uint32_t vpl) const {
        return std::size_t{slot / lanes} * words + vpl / (32 / lanes);
    }
    [[nodiscard]] std::uint32_t bit(std::uint32_t slot, std::uint32_t vpl) const {
        return vpl % (32 / lanes) * lanes + slot % lanes;
    }
};

}  // namespace

RecordPool::RecordPool(Executor& executor, const Settings& settings)
    : executor_(executor),
      settings_(settings),
      lanes_(executor.lanes()),
      receiver_planes_(static_cast<std::uint32_t>(receiver_planes(settings.features))),
      words_((settings.mask_vpls + 32 / lanes_ - 1) / (32 / lanes_)) {
    allocate(least_slots);
}

std::uint32_t RecordPool::packets(std::uint32_t slots) const {
    return slots / lanes_;
}

std::size_t RecordPool::bytes_per_record() const {
    const std::size_t floats = receiver_planes_ + RECORD_PLANES + 1;
    const std::size_t per_packet = (std::size_t{2} * words_ + 1) * sizeof(std::uint32_t);
    return floats * sizeof(float) + per_packet / lanes_ + sizeof(shared::CacheRecord);
}

void RecordPool::allocate(std::uint32_t room) {
    room_ = room;
    // Buffers without a use are small, not empty.
    constexpr std::size_t least = 4;
    const std::size_t slots = room;
    const std::size_t states = settings_.temporal ? packets(room) : 0;
    const std::size_t mask_words = std::max(least, std::size_t{packets(room)} * words_);
    receivers_ = weft::allocate<kinds::ReceiverPlanes>(executor_, slots * receiver_planes_,
                                                       "receivers of records");
    slot_pixel_ = weft::allocate<kinds::SlotPixels>(executor_, slots, "places of records");
    planes_ = weft::allocate<kinds::RecordPlanes>(executor_, slots * RECORD_PLANES, "new records");
    states_ = weft::allocate<kinds::PacketStates>(executor_, std::max(least, states),
                                                  "states of records");
    invalid_ = weft::allocate<kinds::InvalidConnections>(executor_, mask_words,
                                                         "invalid connections of records");
    seen_ = weft::allocate<kinds::VisibleConnections>(executor_, mask_words, "what records see");
}

void RecordPool::make_room(std::uint32_t slots) {
    if (slots <= room_) return;
    const std::uint32_t before = room_;
    const auto receivers =
        read_buffer(executor_, receivers_, std::size_t{before} * receiver_planes_);
    const auto planes = read_planes();
    const auto seen = read_buffer(executor_, seen_, std::size_t{packets(slots_)} * words_);
    allocate(std::max(slots, 2 * before));
    const auto spread = [&](const std::vector<float>& values, std::uint32_t count) {
        std::vector<float> wider(std::size_t{room_} * count);
        for (std::size_t plane = 0; plane < count; ++plane)
            std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(plane * before), slots_,
                        wider.begin() + static_cast<std::ptrdiff_t>(plane * room_));
        return wider;
    };
    write_buffer(executor_, receivers_, spread(receivers, receiver_planes_));
    write_buffer(executor_, planes_, spread(planes, RECORD_PLANES));
    write_buffer(executor_, seen_, seen);
}

std::uint32_t RecordPool::append(std::span<const std::uint32_t> pixels) {
    const std::uint32_t first = slots_;
    make_room(first + whole_blocks(pixels.size()));
    pixels_.resize(first, INVALID_INDEX);
    pixels_.insert(pixels_.end(), pixels.begin(), pixels.end());
    pixels_.resize(first + whole_blocks(pixels.size()), INVALID_INDEX);
    slots_ = static_cast<std::uint32_t>(pixels_.size());
    write_buffer(executor_, slot_pixel_, pixels_);
    return first;
}

void RecordPool::set_states(std::uint32_t state) {
    if (!settings_.temporal) return;
    const std::vector<std::uint32_t> all(packets(slots_), state);
    write_buffer(executor_, states_, all);
}

std::vector<std::uint32_t> RecordPool::states() {
    return read_buffer(executor_, states_, packets(slots_));
}

std::uint64_t RecordPool::count_invalid_connections() {
    const auto words = read_buffer(executor_, invalid_, std::size_t{packets(slots_)} * words_);
    const std::vector<std::uint32_t> of_packets = states();
    std::uint64_t count = 0;
    for (std::size_t packet = 0; packet < of_packets.size(); ++packet) {
        if (of_packets[packet] == CACHE_KEEP) continue;
        for (std::size_t word = 0; word < words_; ++word)
            count += static_cast<std::uint64_t>(std::popcount(words[packet * words_ + word]));
    }
    return count;
}

std::vector<float> RecordPool::read_planes() {
    return read_buffer(executor_, planes_, std::size_t{room_} * RECORD_PLANES);
}

RecordPool::Contents RecordPool::read(std::uint32_t first) {
    const auto values = read_planes();
    const auto places = read_buffer(executor_, receivers_, std::size_t{room_} * receiver_planes_);
    Contents contents;
    for (std::uint32_t slot = first; slot < slots_; ++slot) {
        const auto plane = [&](std::size_t i) { return values[i * room_ + slot]; };
        const auto three = [&](std::size_t i, float w) {
            return shared::float4{plane(i), plane(i + 1), plane(i + 2), w};
        };
        const auto place = [&](std::size_t i, float w) {
            return shared::float4{places[i * room_ + slot], places[(i + 1) * room_ + slot],
                                  places[(i + 2) * room_ + slot], w};
        };
        if (!(places[std::size_t{RECEIVER_VALID} * room_ + slot] > 0.0F)) continue;
        const float radius = plane(RECORD_RADIUS);
        std::array<float, CACHE_SECTORS> clear{};
        float nearest = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < clear.size(); ++i) {
            nearest = std::min(nearest, plane(RECORD_CLEARANCE + i));
            const float distance = plane(RECORD_CLEARANCE + i) / GUARD_REACH;
            clear[i] = distance * distance;
        }
        // As the kernel compares them: lookups of a record in the open need no shadow ray.
        const float guarded = nearest < GUARD_REACH * radius ? 1.0F : 0.0F;
        contents.records.push_back({three(RECORD_PLACE, radius),
                                    place(RECEIVER_X, 0.0F),
                                    place(RECEIVER_SHADING_X, guarded),
                                    {clear[0], clear[1], clear[2], clear[3]},
                                    {clear[4], clear[5], clear[6], clear[7]},
                                    three(RECORD_LIGHT, 0.0F),
                                    three(RECORD_MOVE, 0.0F),
                                    three(RECORD_MOVE + 3, 0.0F),
                                    three(RECORD_MOVE + 6, 0.0F),
                                    three(RECORD_TURN, 0.0F),
                                    three(RECORD_TURN + 3, 0.0F),
                                    three(RECORD_TURN + 6, 0.0F)});
        contents.slots.push_back(slot);
    }
    return contents;
}

void RecordPool::invalidate(std::span<const std::uint32_t> slots) {
    if (slots.empty()) return;
    auto receivers = read_buffer(executor_, receivers_, std::size_t{room_} * receiver_planes_);
    for (const std::uint32_t slot : slots)
        receivers[std::size_t{RECEIVER_VALID} * room_ + slot] = 0.0F;
    write_buffer(executor_, receivers_, receivers);
}

void RecordPool::keep(std::span<const std::uint32_t> slots) {
    const auto pick = [&](const auto& buffer, std::uint32_t count) {
        const auto values = read_buffer(executor_, buffer, std::size_t{room_} * count);
        std::vector<float> kept(values.size(), 0.0F);
        for (std::size_t plane = 0; plane < count; ++plane)
            for (std::size_t i = 0; i < slots.size(); ++i)
                kept[plane * room_ + i] = values[plane * room_ + slots[i]];
        write_buffer(executor_, buffer, kept);
    };
    pick(receivers_, receiver_planes_);
    pick(planes_, RECORD_PLANES);
    if (words_ > 0) {
        const MaskLayout layout{lanes_, words_, settings_.mask_vpls};
        const std::size_t count = std::size_t{packets(slots_)} * words_;
        const auto seen = read_buffer(executor_, seen_, count);
        std::vector<std::uint32_t> kept(count, 0);
        for (std::uint32_t i = 0; i < slots.size(); ++i)
            for (std::uint32_t vpl = 0; vpl < settings_.mask_vpls; ++vpl)
                kept[layout.word(i, vpl)] |=
                    (seen[layout.word(slots[i], vpl)] >> layout.bit(slots[i], vpl) & 1U)
                    << layout.bit(i, vpl);
        write_buffer(executor_, seen_, kept);
    }
    slots_ = whole_blocks(slots.size());
    pixels_.assign(slots_, INVALID_INDEX);
}

}  // namespace weft
