// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Packets of receivers that do not follow one another.
#ifndef WEFT_LISTED_RECEIVERS_H
#define WEFT_LISTED_RECEIVERS_H

#include "connection.h"

// Slots of up to LANES receivers.
typedef struct {
    uint slot[LANES];
    uint count;
} ReceiverList;

/// A plane's values of the listed slots; lanes beyond them have that of the first.
static inline WFloat listed_plane(GLOBAL const float* plane, const ReceiverList* list) {
    float values[LANES];
    for (uint lane = 0u; lane < (uint)LANES; ++lane)
        values[lane] = plane[list->slot[lane < list->count ? lane : 0u]];
    return wide_load(values, 0);
}

static inline WFloat3 listed_vector(const Params* params, GLOBAL const float* planes, uint x,
                                    const ReceiverList* list) {
    GLOBAL const float* first = planes + x * params->slots;
    WFloat3 v;
    v.x = listed_plane(first, list);
    v.y = listed_plane(first + params->slots, list);
    v.z = listed_plane(first + 2u * params->slots, list);
    return v;
}

/// As load_receivers; a list holds at least one.
static inline ReceiverPacket listed_receivers(const Params* params, GLOBAL const float* planes,
                                              const ReceiverList* list) {
    ReceiverPacket packet;
    packet.position = listed_vector(params, planes, RECEIVER_X, list);
    packet.shading = listed_vector(params, planes, RECEIVER_SHADING_X, list);
    packet.normal = packet.shading;
    if (HAS(params, FEATURE_SMOOTH_NORMALS))
        packet.normal = listed_vector(params, planes, RECEIVER_NORMAL_X, list);
    WFloat valid = listed_plane(planes + RECEIVER_VALID * params->slots, list);
    uint lanes = list->count < 32u ? (1u << list->count) - 1u : 0xFFFFFFFFu;
    packet.valid = (valid > WIDE(0.0f)) & mask_of(lanes);
    return packet;
}

#endif
