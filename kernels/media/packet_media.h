// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Transmittance of media between LANES points and one other, by channel. Where boundaries are
// convex it is an exponential of all lanes at once; else each lane's way is walked by itself. Grids
// are tracked lane by lane, with random numbers that depend on the ends of a way alone.
#ifndef WEFT_KERNELS_MEDIA_PACKET_MEDIA_H
#define WEFT_KERNELS_MEDIA_PACKET_MEDIA_H

#include "kernels/light/connection.h"
#include "kernels/media/convex_media.h"

// Slots of up to LANES receivers.
typedef struct {
    uint slot[LANES];
    uint count;
} ReceiverList;

// Which boundaries of media enclose the points of a packet.
typedef struct {
    uint enclosing_media[LANES];  // boundaries around them
    uint above[2];  // planes of convex boundaries that all of them lie above, a bit each
} PacketEnclosingMedia;

/// Finds the planes of convex boundaries that all points of a packet lie above.
static inline void find_above(const RenderParams* params, const Media* media, WFloat3 positions,
                              PacketEnclosingMedia* packet) {
    uint count = media->record->boundaries;
    if (!HAS(params, FEATURE_CONVEX_MEDIA) || count == 0u) return;
    for (uint i = 0u; i < media->record->plane_end[count - 1u]; ++i) {
        float4 plane = media->record->planes[i];
        if (wide_lowest(wide_dot_scalar(positions, xyz(plane)) - plane.w) > 0.0f)
            packet->above[i >> 5] |= 1u << (i & 31u);
    }
}

/// The enclosing media of listed slots at those positions.
static inline PacketEnclosingMedia listed_enclosing_media(const RenderParams* params,
                                                          const Media* media,
                                                          GLOBAL const float* planes, uint stride,
                                                          WFloat3 positions,
                                                          const ReceiverList* list) {
    PacketEnclosingMedia packet;
    packet.above[0] = 0u;
    packet.above[1] = 0u;
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        uint slot = list->slot[lane < list->count ? lane : 0u];
        packet.enclosing_media[lane] =
            HAS(params, FEATURE_MEDIA) ? as_bits(planes[RECEIVER_ENCLOSING_MEDIA * stride + slot])
                                       : 0u;
    }
    if (HAS(params, FEATURE_MEDIA)) find_above(params, media, positions, &packet);
    return packet;
}

/// The same for the slots from `slot` on.
static inline PacketEnclosingMedia load_enclosing_media(const RenderParams* params,
                                                        const Media* media,
                                                        GLOBAL const float* planes, uint stride,
                                                        WFloat3 positions, uint slot) {
    ReceiverList list;
    list.count = (uint)LANES;
    for (uint lane = 0u; lane < (uint)LANES; ++lane) list.slot[lane] = slot + lane;
    return listed_enclosing_media(params, media, planes, stride, positions, &list);
}

/// 1 where a plane of a convex boundary lies below a light and all of the packet.
static inline int is_above(const Media* media, const PacketEnclosingMedia* packet, uint boundary,
                           float3 light) {
    uint first = boundary == 0u ? 0u : media->record->plane_end[boundary - 1u];
    for (uint i = first; i < media->record->plane_end[boundary]; ++i) {
        if ((packet->above[i >> 5] >> (i & 31u) & 1u) == 0u) continue;
        float4 plane = media->record->planes[i];
        if (dot3(xyz(plane), light) > plane.w) return 1;
    }
    return 0;
}

// Three values a lane.
typedef struct {
    float x[LANES], y[LANES], z[LANES];
} LaneVectors;

static inline LaneVectors lanes_of(WFloat3 v) {
    LaneVectors lanes;
    wide_store(v.x, lanes.x, 0);
    wide_store(v.y, lanes.y, 0);
    wide_store(v.z, lanes.z, 0);
    return lanes;
}

static inline WFloat3 wide_of(const LaneVectors* lanes) {
    return wide_vector(wide_load(lanes->x, 0), wide_load(lanes->y, 0), wide_load(lanes->z, 0));
}

static inline float3 lane_vector(const LaneVectors* lanes, uint lane) {
    return f3(lanes->x[lane], lanes->y[lane], lanes->z[lane]);
}

static inline void set_lane(LaneVectors* lanes, uint lane, float3 v) {
    lanes->x[lane] = v.x;
    lanes->y[lane] = v.y;
    lanes->z[lane] = v.z;
}

/// The random numbers of a way from a place; `number` tells the ways of a place apart.
static inline Random way_random(const RenderParams* params, float3 place, uint number) {
    uint key = hash_pair(hash_pair(as_bits(place.x), as_bits(place.y)), as_bits(place.z));
    return make_random(params->sampling.seed ^ 0x6A09E667u, key,
                       hash_pair(params->sampling.sample, number));
}

/// Multiplies `transmittance` by that of the grid inside a boundary, over the `segment` of ways
/// from `places`, in the lanes of `bits`.
static inline void track_grid(const RenderParams* params, const Media* media, uint boundary,
                              const LaneVectors* places, const LaneVectors* ways,
                              WideSegment segment, uint bits, Random* random,
                              LaneVectors* transmittance) {
    DensityGrid grid;
    float3 sigma;
    if (grid_within(params, media, boundary, &grid, &sigma) == 0) return;
    float begin[LANES], end[LANES];
    wide_store(segment.begin, begin, 0);
    wide_store(segment.end, end, 0);
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        if ((bits >> lane & 1u) == 0u || !(end[lane] > begin[lane])) continue;
        float3 way = lane_vector(ways, lane);
        float length = length3(way);
        set_lane(
            transmittance, lane,
            lane_vector(transmittance, lane) *
                tracked_transmittance(&grid, sigma, lane_vector(places, lane), way / length,
                                      begin[lane] * length, end[lane] * length, random + lane));
    }
}

/// packet_transmittance where boundaries are convex.
static inline WFloat3 convex_transmittance(const RenderParams* params, const Media* media,
                                           WFloat3 positions, const PacketEnclosingMedia* packet,
                                           float3 light, WFloat3 d, uint number, WMask wanted) {
    WFloat one = WIDE(1.0f);
    WideLengths lengths = no_lengths(media, one);
    WFloat3 way = wide_vector(-d.x, -d.y, -d.z);
    uint met = 0u;
    for (uint k = 0u; k < media->record->boundaries; ++k) {
        if (is_above(media, packet, k, light) != 0) continue;
        WideSegment segment = segment_within(media, k, positions, way, one);
        WFloat length = segment.end - segment.begin;
        if (!mask_any(length > WIDE(0.0f))) continue;
        met |= 1u << k;
        add_length(media, k, length, &lengths);
    }
    if (met == 0u && media->record->outside == NO_MEDIUM) return wide_same(1.0f);
    WFloat3 transmittance =
        wide_transmittance(depth_of(params, media, &lengths, wide_square_root(wide_dot(d, d))));
    if (!HAS(params, FEATURE_DENSITY_GRIDS)) return transmittance;
    LaneVectors places = lanes_of(positions);
    LaneVectors ways = lanes_of(way);
    LaneVectors lanes = lanes_of(transmittance);
    Random random[LANES];
    for (uint lane = 0u; lane < (uint)LANES; ++lane)
        random[lane] = way_random(params, lane_vector(&places, lane), number);
    for (uint k = 0u; k < media->record->boundaries; ++k)
        if ((met >> k & 1u) != 0u)
            track_grid(params, media, k, &places, &ways,
                       segment_within(media, k, positions, way, one), mask_bits(wanted), random,
                       &lanes);
    return wide_of(&lanes);
}

/// Transmittance of media on the ways from a light to the lanes of `wanted`; `d` leads from the
/// light to their `positions`. `number` tells the ways of a lane apart. Where media are walked,
/// other lanes get 1.
static inline WFloat3 packet_transmittance(const RenderParams* params, const Media* media,
                                           WFloat3 positions, const PacketEnclosingMedia* packet,
                                           float3 from, WFloat3 d, uint number, WMask wanted) {
    if (HAS(params, FEATURE_CONVEX_MEDIA))
        return convex_transmittance(params, media, positions, packet, from, d, number, wanted);
    LaneVectors places = lanes_of(positions);
    LaneVectors ways = lanes_of(d);
    LaneVectors transmittance = lanes_of(wide_same(1.0f));
    uint bits = mask_bits(wanted);
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        if ((bits >> lane & 1u) == 0u) continue;
        float3 place = lane_vector(&places, lane);
        float3 way = -lane_vector(&ways, lane);
        Random random = way_random(params, place, number);
        set_lane(&transmittance, lane,
                 ray_transmittance(params, media, place, normalize3(way), length3(way),
                                   packet->enclosing_media[lane], &random));
    }
    return wide_of(&transmittance);
}

// Irradiance of LANES receivers.
typedef struct {
    WFloat red, green, blue;
} WideLight;

static inline WideLight no_light(void) {
    WideLight light;
    light.red = WIDE(0.0f);
    light.green = light.red;
    light.blue = light.red;
    return light;
}

/// Adds the light of a connection with geometry term `g` from a light that the lanes of `wanted`
/// see; see packet_transmittance.
static inline void add_connection(const RenderParams* params, const Media* media,
                                  const ReceiverPacket* packet,
                                  const PacketEnclosingMedia* enclosing_media, float3 from,
                                  float4 flux, WFloat g, WFloat3 d, uint number, WMask wanted,
                                  WideLight* light) {
    WFloat carried = SELECT(wanted, g, WIDE(0.0f));
    if (HAS(params, FEATURE_MEDIA)) {
        WFloat3 transmittance = packet_transmittance(params, media, packet->position,
                                                     enclosing_media, from, d, number, wanted);
        light->red = light->red + carried * flux.x * transmittance.x;
        light->green = light->green + carried * flux.y * transmittance.y;
        light->blue = light->blue + carried * flux.z * transmittance.z;
    } else {
        light->red = light->red + carried * flux.x;
        light->green = light->green + carried * flux.y;
        light->blue = light->blue + carried * flux.z;
    }
}

/// Adds `light` times `scale` to the planes of irradiance.
static inline void add_stored_light(const WideLight* light, float scale, uint stride, uint slot,
                                    GLOBAL float* irradiance) {
    WFloat red = light->red * scale;
    WFloat green = light->green * scale;
    WFloat blue = light->blue * scale;
    wide_store(red + wide_load(irradiance, slot), irradiance, slot);
    wide_store(green + wide_load(irradiance, stride + slot), irradiance, stride + slot);
    wide_store(blue + wide_load(irradiance, 2u * stride + slot), irradiance, 2u * stride + slot);
}

/// Writes `light` times `scale` to the planes of irradiance.
static inline void store_light(const WideLight* light, float scale, uint stride, uint slot,
                               GLOBAL float* irradiance) {
    wide_store(light->red * scale, irradiance, slot);
    wide_store(light->green * scale, irradiance, stride + slot);
    wide_store(light->blue * scale, irradiance, 2u * stride + slot);
}

#endif
