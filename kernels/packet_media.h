// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What media leave of the light between LANES points and one other, by channel. Where one medium
// fills all space this is exponentials; else each lane's way is walked by itself, with random
// numbers that depend on its ends alone.
#ifndef WEFT_PACKET_MEDIA_H
#define WEFT_PACKET_MEDIA_H

#include "connection.h"
#include "medium_walk.h"
#include "wide_maths.h"

// Boundaries of media around the points of a packet.
typedef struct {
    uint inside[LANES];
} PacketInside;

static inline PacketInside load_inside(const Params* params, GLOBAL const float* planes,
                                       uint slot) {
    PacketInside packet;
    if (HAS(params, FEATURE_MEDIA)) {
        for (uint lane = 0u; lane < (uint)LANES; ++lane)
            packet.inside[lane] = as_bits(planes[RECEIVER_INSIDE * params->slots + slot + lane]);
    } else {
        for (uint lane = 0u; lane < (uint)LANES; ++lane) packet.inside[lane] = 0u;
    }
    return packet;
}

/// 1 where all space is of one homogeneous medium, or clear.
static inline int space_is_uniform(const Params* params, const Media* media) {
    if (media->record->boundaries != 0u) return 0;
    uint outside = media->record->outside;
    if (outside == NO_MEDIUM) return 1;
    MediumRecord medium = media->media[outside];
    return has_grid(params, &medium) != 0 ? 0 : 1;
}

static inline WFloat3 wide_vector(WFloat x, WFloat y, WFloat z) {
    WFloat3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

/// exp(-sigma length) of each channel, for lengths that are finite and not negative.
static inline WFloat3 wide_transmittance(float3 sigma, WFloat length) {
    WFloat x = wide_exp_minus(length * sigma.x);
    WFloat y = sigma.y == sigma.x ? x : wide_exp_minus(length * sigma.y);
    WFloat z = sigma.z == sigma.y ? y : wide_exp_minus(length * sigma.z);
    return wide_vector(x, y, z);
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

/// Random numbers of the way from a place that is used for purpose `number`.
static inline Random way_random(const Params* params, float3 place, uint number) {
    uint key = hash_pair(hash_pair(as_bits(place.x), as_bits(place.y)), as_bits(place.z));
    return make_random(params->seed ^ 0x6A09E667u, key, hash_pair(params->frame, number));
}

/// What media leave of light on its ways from one point to the lanes of `wanted`; `d` leads from
/// it to their `positions`. `number` tells the ways of a lane apart. 1 in other lanes of media that
/// are walked.
static inline WFloat3 packet_transmittance(const Params* params, const Media* media,
                                           WFloat3 positions, const PacketInside* packet, WFloat3 d,
                                           uint number, WMask wanted) {
    WFloat one = WIDE(1.0f);
    if (space_is_uniform(params, media) != 0) {
        uint outside = media->record->outside;
        if (outside == NO_MEDIUM) return wide_vector(one, one, one);
        return wide_transmittance(xyz(media->media[outside].sigma_t),
                                  wide_square_root(wide_dot(d, d)));
    }
    LaneVectors places = lanes_of(positions);
    LaneVectors ways = lanes_of(d);
    LaneVectors left = lanes_of(wide_vector(one, one, one));
    uint bits = mask_bits(wanted);
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        if ((bits >> lane & 1u) == 0u) continue;
        float3 place = lane_vector(&places, lane);
        float3 way = -lane_vector(&ways, lane);
        Random random = way_random(params, place, number);
        set_lane(&left, lane,
                 ray_transmittance(params, media, place, normalize3(way), length3(way),
                                   packet->inside[lane], &random));
    }
    return wide_of(&left);
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
static inline void add_connection(const Params* params, const Media* media,
                                  const ReceiverPacket* packet, const PacketInside* inside,
                                  float4 flux, WFloat g, WFloat3 d, uint number, WMask wanted,
                                  WideLight* light) {
    WFloat carried = SELECT(wanted, g, WIDE(0.0f));
    if (HAS(params, FEATURE_MEDIA)) {
        WFloat3 left =
            packet_transmittance(params, media, packet->position, inside, d, number, wanted);
        light->red = light->red + carried * flux.x * left.x;
        light->green = light->green + carried * flux.y * left.y;
        light->blue = light->blue + carried * flux.z * left.z;
    } else {
        light->red = light->red + carried * flux.x;
        light->green = light->green + carried * flux.y;
        light->blue = light->blue + carried * flux.z;
    }
}

/// Writes `light` times `scale` to the planes of irradiance.
static inline void store_light(const Params* params, const WideLight* light, float scale, uint slot,
                               GLOBAL float* irradiance) {
    wide_store(light->red * scale, irradiance, slot);
    wide_store(light->green * scale, irradiance, params->slots + slot);
    wide_store(light->blue * scale, irradiance, 2u * params->slots + slot);
}

#endif
