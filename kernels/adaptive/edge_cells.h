// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Pixels at the edges of area lights' shadows, gathered from squares of the picture into packets.
#ifndef WEFT_KERNELS_ADAPTIVE_EDGE_CELLS_H
#define WEFT_KERNELS_ADAPTIVE_EDGE_CELLS_H

#include "kernels/adaptive/shadow_words.h"
#include "kernels/bsdf/lambert.h"
#include "kernels/core/receiver_values.h"
#include "kernels/media/packet_media.h"

#define CELL_PIXELS ((uint)(LANES * LANES))

// Where packets may be of pixels that looked at any sample first.
#define ANY_LOOK 0xFFFFFFFFu

// A pixel with edges of shadows: which of 32 lights they are of, and which were seen first.
typedef struct {
    uint slot;
    uint first_look;  // number of a light's sample
    uint edges, seen;
    float reflectance, radiance;  // luminance by irradiance 1, and of what is known so far
} EdgePixel;

// Position, shading normal and geometric normal of a receiver.
#define CELL_VALUES 9u

// Those of a cell. Packets are made of them for every light and sample, so what packets hold is
// gathered from the whole picture's planes once.
typedef struct {
    EdgePixel pixels[LANES * LANES];
    float receivers[CELL_VALUES][LANES * LANES];
    uint count;
    uint some;  // lights of which any has an edge
} EdgeCell;

// Some of them, by their places in the cell.
typedef struct {
    uint place[LANES * LANES];
    uint count;
} EdgeList;

// As many of a list as make a packet.
typedef struct {
    ReceiverList list;
    uint place[LANES];
} EdgePacket;

// What cells are found from.
typedef struct {
    GLOBAL const float* receiver_planes;
    GLOBAL const uint* pixel_slot;
    GLOBAL const uint* pixel_shadows;
    GLOBAL const uint* shadow_edges;
    GLOBAL const float4* gb_albedo;
    GLOBAL const float* irradiance;
    uint slots;  // stride of the planes of receivers and irradiance
} ShadowPlanes;

/// Every second bit of a number below 256.
static inline uint even_bits(uint code) {
    uint bits = code & 0x55u;
    bits = (bits | bits >> 1) & 0x33u;
    return (bits | bits >> 2) & 0x0Fu;
}

/// What is known of a pixel, x and y, that looked at sample `look` of every light first.
static inline void find_edge_pixel(const RenderParams* params, const ShadowPlanes* from, uint word,
                                   uint x, uint y, uint look, EdgePixel* found) {
    uint pixel = y * params->camera.width + x;
    uint plane = params->camera.width * params->camera.height;
    found->slot = from->pixel_slot[pixel];
    found->first_look = look;
    found->edges = from->shadow_edges[word * plane + pixel];
    found->seen = from->pixel_shadows[seen_plane(params, word) + shadow_place(params, x, y)];
    found->reflectance = LAMBERT_REFLECTANCE(luminance(xyz(from->gb_albedo[pixel])));
    float3 e = receiver_vector(from->irradiance, 0u, from->slots, found->slot);
    found->radiance = found->reflectance * luminance(e);
}

/// Copies a vector of a receiver to three of a cell's planes.
static inline void copy_vector(const ShadowPlanes* from, uint first, uint slot, uint to, uint place,
                               EdgeCell* cell) {
    float3 v = receiver_vector(from->receiver_planes, first, from->slots, slot);
    cell->receivers[to][place] = v.x;
    cell->receivers[to + 1u][place] = v.y;
    cell->receivers[to + 2u][place] = v.z;
}

/// Copies what packets need of the receiver of a slot.
static inline void copy_receiver(const RenderParams* params, const ShadowPlanes* from, uint slot,
                                 uint place, EdgeCell* cell) {
    uint normal = HAS(params, FEATURE_SMOOTH_NORMALS) ? RECEIVER_NORMAL_X : RECEIVER_SHADING_X;
    copy_vector(from, RECEIVER_X, slot, 0u, place, cell);
    copy_vector(from, RECEIVER_SHADING_X, slot, 3u, place, cell);
    copy_vector(from, normal, slot, 6u, place, cell);
}

/// Finds the pixels of a set (by place, not rotated) in a cell that have an edge of any light of a
/// word, along a Morton curve.
static inline void find_edge_pixels(const RenderParams* params, uint cell, uint set, uint rotated,
                                    uint word, const ShadowPlanes* from, EdgeCell* found) {
    uint edge = shadow_cell((uint)LANES, params->sampling.interleave);
    uint columns = (params->camera.width + edge - 1u) / edge;
    uint column = cell % columns * (uint)LANES;
    uint row = cell / columns * (uint)LANES;
    uint plane = params->camera.width * params->camera.height;
    GLOBAL const uint* edges = from->shadow_edges + word * plane;
    found->count = 0u;
    found->some = 0u;
    for (uint i = 0u; i < CELL_PIXELS; ++i) {
        uint u = column + even_bits(i);
        uint v = row + even_bits(i >> 1);
        uint x = u * params->sampling.interleave + set % params->sampling.interleave;
        uint y = v * params->sampling.interleave + set / params->sampling.interleave;
        if (x >= params->camera.width || y >= params->camera.height) continue;
        uint of_lights = edges[y * params->camera.width + x];
        if (of_lights == 0u) continue;
        EdgePixel* at = found->pixels + found->count;
        find_edge_pixel(params, from, word, x, y, shadow_look(params, u, v, rotated), at);
        copy_receiver(params, from, at->slot, found->count++, found);
        found->some |= of_lights;
    }
}

/// Those of a cell that have a light's edge.
static inline void list_edges(const EdgeCell* cell, uint bit, EdgeList* list) {
    list->count = 0u;
    for (uint i = 0u; i < cell->count; ++i)
        if ((cell->pixels[i].edges >> bit & 1u) != 0u) list->place[list->count++] = i;
}

/// The next packet of a list, from its entry `next` on, without pixels whose first look was at
/// sample `known`, if not ANY_LOOK; `next` becomes the entry after it. Empty where none is left.
static inline EdgePacket next_packet(const EdgeCell* cell, const EdgeList* from, uint known,
                                     uint* next) {
    EdgePacket packet;
    uint count = 0u;
    for (; *next < from->count && count < (uint)LANES; ++*next) {
        uint place = from->place[*next];
        if (cell->pixels[place].first_look == known) continue;
        packet.list.slot[count] = cell->pixels[place].slot;
        packet.place[count++] = place;
    }
    packet.list.count = count;
    return packet;
}

/// A vector of lanes; those beyond the packet have that of the first.
static inline WFloat3 packet_vector(const EdgeCell* cell, uint first, const EdgePacket* packet) {
    float x[LANES];
    float y[LANES];
    float z[LANES];
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        uint place = packet->place[lane < packet->list.count ? lane : 0u];
        x[lane] = cell->receivers[first][place];
        y[lane] = cell->receivers[first + 1u][place];
        z[lane] = cell->receivers[first + 2u][place];
    }
    return wide_vector(wide_load(x, 0), wide_load(y, 0), wide_load(z, 0));
}

/// The receivers of a packet that holds at least one.
static inline ReceiverPacket packet_receivers(const RenderParams* params, const EdgeCell* cell,
                                              const EdgePacket* edges) {
    ReceiverPacket packet;
    packet.position = packet_vector(cell, 0u, edges);
    packet.shading = packet_vector(cell, 3u, edges);
    packet.normal = packet.shading;
    if (HAS(params, FEATURE_SMOOTH_NORMALS)) packet.normal = packet_vector(cell, 6u, edges);
    uint count = edges->list.count;
    packet.valid = mask_of(count < 32u ? (1u << count) - 1u : 0xFFFFFFFFu);
    return packet;
}

/// The lanes whose first look saw the light.
static inline WMask seen_lanes(const EdgeCell* cell, uint bit, const EdgePacket* packet) {
    uint lanes = 0u;
    for (uint lane = 0u; lane < packet->list.count; ++lane)
        lanes |= (cell->pixels[packet->place[lane]].seen >> bit & 1u) << lane;
    return mask_of(lanes);
}

#endif
