// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/rays/embree_queries.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <tuple>
#include <type_traits>

#include "base/error.h"
#include "bench/rays/embree_calls.h"

namespace weft::bench {
namespace {

// Embree's rays are arrays of fields, each as many 4-byte values as the packet is wide.
constexpr std::size_t field_origin = 0;
constexpr std::size_t field_direction = 4;
constexpr std::size_t field_t_far = 8;
constexpr std::size_t field_mask = 9;
constexpr std::size_t field_triangle = 17;
constexpr std::size_t field_geometry = 18;
static_assert(offsetof(RTCRay8, tfar) == 8 * 4 * field_t_far);
static_assert(offsetof(RTCRay8, mask) == 8 * 4 * field_mask);
static_assert(offsetof(RTCRayHit8, hit) + offsetof(RTCHit8, primID) == 8 * 4 * field_triangle);
static_assert(offsetof(RTCRayHit16, hit) + offsetof(RTCHit16, geomID) == 16 * 4 * field_geometry);

template <int Width, class T, class Packet>
void put(Packet& packet, std::size_t field, std::size_t lane, T value) {
    static_assert(sizeof(T) == 4);
    std::memcpy(reinterpret_cast<std::byte*>(&packet) + 4 * (field * Width + lane), &value, 4);
}

template <int Width, class T, class Packet>
T get(const Packet& packet, std::size_t field, std::size_t lane) {
    static_assert(sizeof(T) == 4);
    T value;
    std::memcpy(&value, reinterpret_cast<const std::byte*>(&packet) + 4 * (field * Width + lane),
                4);
    return value;
}

constexpr std::uint32_t unused_lane = INVALID_INDEX;

/// Which lanes are to be traced, 0 or -1, aligned as Embree expects it.
template <int Width>
struct alignas(4 * Width) ValidLanes {
    int lanes[Width];
};

/// Rays in Embree's layout. Queries write into them, so an untouched copy is kept.
template <int Width, class Packet>
struct Batch {
    std::vector<Packet> pristine, packets;
    std::vector<ValidLanes<Width>> valid;
    std::vector<std::array<std::uint32_t, Width>> sources;  // index of the ray, or unused_lane
    std::size_t answer_count = 0;

    void add(std::size_t lane, std::uint32_t source, const float* origin, const float* direction,
             float t_max) {
        if (lane == 0) {
            pristine.emplace_back();
            std::memset(static_cast<void*>(&pristine.back()), 0, sizeof(Packet));
            valid.push_back({});
            sources.emplace_back().fill(unused_lane);
        }
        Packet& packet = pristine.back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            put<Width>(packet, field_origin + axis, lane, origin[axis]);
            put<Width>(packet, field_direction + axis, lane, direction[axis]);
        }
        put<Width>(packet, field_t_far, lane, t_max);
        put<Width>(packet, field_mask, lane, ~0U);
        if constexpr (sizeof(Packet) > Width * 4 * field_geometry) {
            put<Width>(packet, field_triangle, lane, RTC_INVALID_GEOMETRY_ID);
            put<Width>(packet, field_geometry, lane, RTC_INVALID_GEOMETRY_ID);
        }
        valid.back().lanes[lane] = -1;
        sources.back()[lane] = source;
    }
    void leave_out(std::size_t lane) {
        // Its fields stay those of no particular ray; Embree does not look at them.
        valid.back().lanes[lane] = 0;
        sources.back()[lane] = unused_lane;
    }
};

template <int Width, class Packet>
using SharedBatch = std::shared_ptr<Batch<Width, Packet>>;

template <int Width, class Packet>
SharedBatch<Width, Packet> make_batch(const RaySet& rays) {
    auto batch = std::make_shared<Batch<Width, Packet>>();
    batch->answer_count = rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i)
        batch->add(i % Width, static_cast<std::uint32_t>(i), &rays.origins[i].x,
                   &rays.directions[i].x, rays.origins[i].w);
    return batch;
}

/// Packets keep their lanes, so that all widths see the masks that vpl_gather would; packets and
/// single rays that trace nothing are left out.
template <int Width>
SharedBatch<Width, typename EmbreeWidth<Width>::Ray> make_batch(const PacketSet& set) {
    auto batch = std::make_shared<Batch<Width, typename EmbreeWidth<Width>::Ray>>();
    batch->answer_count = set.slots();
    for (std::size_t first = 0; first < set.slots(); first += Width) {
        const auto traced = [&](std::size_t lane) { return set.plane(3)[first + lane] > 0.0F; };
        bool any = false;
        for (std::size_t lane = 0; lane < Width; ++lane) any = any || traced(lane);
        if (!any) continue;
        for (std::size_t lane = 0; lane < Width; ++lane) {
            const std::size_t slot = first + lane;
            const float direction[3] = {set.plane(0)[slot], set.plane(1)[slot], set.plane(2)[slot]};
            batch->add(lane, static_cast<std::uint32_t>(slot),
                       &set.block_origins[slot / PACKET_BLOCK].x, direction, SHADOW_END);
            if (!traced(lane)) batch->leave_out(lane);
        }
    }
    return batch;
}

struct Mode {
    const char* name;
    RTCScene scene;
    bool coherent;
    int yardstick_widths;  // calls up to this width are yardsticks
};

constexpr int single = 1;
constexpr int all_widths = 16;

/// `one(options, valid, packet)` makes one call.
template <int Width, class Packet, class One>
Timing run_batch(Batch<Width, Packet>& batch, tbb::task_arena& arena, bool coherent,
                 const One& one) {
    const std::size_t count = batch.packets.size();
    // Blocks as the native executor makes them, but short of its cut into launches.
    const std::size_t grain = std::max<std::size_t>(1, count / 1024);
    const RunTimer watch;
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                          [&](const tbb::blocked_range<std::size_t>& range) {
                              QueryOptions options(coherent);
                              for (std::size_t i = range.begin(); i < range.end(); ++i)
                                  one(options, batch.valid[i].lanes, &batch.packets[i]);
                          });
    });
    return watch.elapsed();
}

template <int Width, class Packet, class Answer>
std::vector<std::uint32_t> read_answers(const Batch<Width, Packet>& batch, std::uint32_t nothing,
                                        const Answer& answer) {
    std::vector<std::uint32_t> answers(batch.answer_count, nothing);
    for (std::size_t i = 0; i < batch.packets.size(); ++i)
        for (std::size_t lane = 0; lane < Width; ++lane)
            if (batch.sources[i][lane] != unused_lane)
                answers[batch.sources[i][lane]] = answer(batch.packets[i], lane);
    return answers;
}

using Arena = std::shared_ptr<tbb::task_arena>;

template <int Width>
Candidate closest_candidate(SharedBatch<Width, typename EmbreeWidth<Width>::RayHit> batch,
                            const Arena& arena, const Mode& mode) {
    using Packet = typename EmbreeWidth<Width>::RayHit;
    const auto one = [scene = mode.scene](QueryOptions& options, const int* valid, Packet* packet) {
        options.intersect(valid, scene, packet);
    };
    const auto answer = [](const Packet& packet, std::size_t lane) {
        return get<Width, std::uint32_t>(packet, field_triangle, lane);
    };
    return {fmt::format("{} {}", mode.name, Width), (Width <= mode.yardstick_widths),
            [batch] { batch->packets = batch->pristine; },
            [=] { return run_batch(*batch, *arena, mode.coherent, one); },
            [=] { return read_answers(*batch, INVALID_INDEX, answer); }};
}

template <int Width>
Candidate any_candidate(SharedBatch<Width, typename EmbreeWidth<Width>::Ray> batch,
                        const Arena& arena, const Mode& mode) {
    using Packet = typename EmbreeWidth<Width>::Ray;
    const auto one = [scene = mode.scene](QueryOptions& options, const int* valid, Packet* packet) {
        options.occluded(valid, scene, packet);
    };
    // Embree marks a blocked ray by tfar = -inf.
    const auto answer = [](const Packet& packet, std::size_t lane) {
        return get<Width, float>(packet, field_t_far, lane) < 0.0F ? 1U : 0U;
    };
    return {fmt::format("{} {}", mode.name, Width), (Width <= mode.yardstick_widths),
            [batch] { batch->packets = batch->pristine; },
            [=] { return run_batch(*batch, *arena, mode.coherent, one); },
            [=] { return read_answers(*batch, 0, answer); }};
}

/// Calls `add.template operator()<Width>(mode)` for every variant that is measured; those in robust
/// mode up to `yardstick_widths` wide are what ratios refer to.
template <class Add>
void for_all_variants(const EmbreeScenes& scenes, int yardstick_widths, const Add& add) {
    for (const Mode& mode : {Mode{"robust", scenes.robust(), false, yardstick_widths},
                             Mode{"default", scenes.fast(), false, 0}}) {
        add.template operator()<1>(mode);
        add.template operator()<8>(mode);
        add.template operator()<16>(mode);
    }
    for (const Mode& mode : {Mode{"robust coherent", scenes.robust(), true, 0},
                             Mode{"default coherent", scenes.fast(), true, 0}}) {
        add.template operator()<8>(mode);
        add.template operator()<16>(mode);
    }
}

template <class Input>
std::vector<Candidate> any_candidates(const EmbreeScenes& scenes, const Arena& arena,
                                      const Input& input) {
    const auto make = [&]<int Width>(std::integral_constant<int, Width>) {
        if constexpr (std::is_same_v<Input, RaySet>)
            return make_batch<Width, typename EmbreeWidth<Width>::Ray>(input);
        else
            return make_batch<Width>(input);
    };
    const auto batches =
        std::tuple(make(std::integral_constant<int, 1>{}), make(std::integral_constant<int, 8>{}),
                   make(std::integral_constant<int, 16>{}));
    std::vector<Candidate> candidates;
    const int yardsticks = std::is_same_v<Input, RaySet> ? single : all_widths;
    for_all_variants(scenes, yardsticks, [&]<int Width>(const Mode& mode) {
        constexpr std::size_t index = Width == 1 ? 0 : Width == 8 ? 1 : 2;
        candidates.push_back(any_candidate<Width>(std::get<index>(batches), arena, mode));
    });
    return candidates;
}

}  // namespace

EmbreeQueries::EmbreeQueries(const EmbreeScenes& scenes, int threads)
    : scenes_(scenes),
      arena_(std::make_shared<tbb::task_arena>(
          threads > 0 ? threads : static_cast<int>(tbb::task_arena::automatic))) {}

std::vector<Candidate> EmbreeQueries::closest(const RaySet& rays) const {
    const auto batches = std::tuple(make_batch<1, RTCRayHit>(rays), make_batch<8, RTCRayHit8>(rays),
                                    make_batch<16, RTCRayHit16>(rays));
    std::vector<Candidate> candidates;
    for_all_variants(scenes_, single, [&]<int Width>(const Mode& mode) {
        constexpr std::size_t index = Width == 1 ? 0 : Width == 8 ? 1 : 2;
        candidates.push_back(closest_candidate<Width>(std::get<index>(batches), arena_, mode));
    });
    return candidates;
}

std::vector<Candidate> EmbreeQueries::any(const RaySet& rays) const {
    return any_candidates(scenes_, arena_, rays);
}

std::vector<Candidate> EmbreeQueries::packets(const PacketSet& packets) const {
    return any_candidates(scenes_, arena_, packets);
}

}  // namespace weft::bench
