// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Packs pixels at the edges of area lights' shadows into packets, for soft_shadows.cl. A cell is a
// square of the image; it holds LANES x LANES pixels of a sample set.
#ifndef WEFT_KERNELS_ADAPTIVE_EDGE_CELLS_H
#define WEFT_KERNELS_ADAPTIVE_EDGE_CELLS_H

#include "kernels/adaptive/visibility_mask.h"
#include "kernels/bsdf/lambert.h"
#include "kernels/core/receiver_values.h"
#include "kernels/media/packet_media.h"

#define CELL_PIXELS ((uint)(LANES * LANES))

// For next_packet: takes pixels whichever sample they have probed.
#define ANY_SAMPLE 0xFFFFFFFFu

// A pixel at the edge of a shadow, for 32 lights: a bit of `edges` tells that the shadow of a light
// ends here, a bit of `seen` that the pixel's probe found the light visible.
typedef struct {
    uint slot;
    uint probed;  // number of the sample of each light that the probe began with
    uint edges, seen;
    float reflectance, radiance;  // luminance by irradiance 1, and by the direct light so far
} EdgePixel;

// Position, shading normal and geometric normal of a receiver.
#define CELL_VALUES 9u

// The edge pixels of a cell, with their receivers. Packets are formed anew for every light and
// sample, so receivers are copied here from the planes of the whole image once.
typedef struct {
    EdgePixel pixels[LANES * LANES];
    float receivers[CELL_VALUES][LANES * LANES];
    uint count;
    uint some;  // lights with an edge at any of the pixels, a bit each
} EdgeCell;

// Some of a cell's pixels, by their indices in it.
typedef struct {
    uint place[LANES * LANES];
    uint count;
} EdgeList;

// Up to LANES pixels of a list, by slot and by index in the cell.
typedef struct {
    ReceiverList list;
    uint place[LANES];
} EdgePacket;

// The buffers that cells are filled from.
typedef struct {
    GLOBAL const float* receiver_planes;
    GLOBAL const uint* pixel_slot;
    GLOBAL const uint* pixel_shadows;
    GLOBAL const uint* shadow_edges;
    GLOBAL const float4* gb_albedo;
    GLOBAL const float* irradiance;
    uint slots;  // stride of the planes of receivers and irradiance
} ShadowPlanes;

/// The even bits of a number below 256, moved together: one coordinate of a Morton code.
static inline uint even_bits(uint code) {
    uint bits = code & 0x55u;
    bits = (bits | bits >> 1) & 0x33u;
    return (bits | bits >> 2) & 0x0Fu;
}

/// Fills in the pixel (`x`, `y`), whose probes began with sample `sample` of every light, for the
/// 32 lights of a word.
static inline void find_edge_pixel(const RenderParams* params, const ShadowPlanes* from, uint word,
                                   uint x, uint y, uint sample, EdgePixel* found) {
    uint pixel = y * params->camera.width + x;
    uint plane = params->camera.width * params->camera.height;
    found->slot = from->pixel_slot[pixel];
    found->probed = sample;
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

/// Finds the pixels of a cell that are of sample set `set` (by place; `rotated` after rotation) and
/// lie at the edge of a shadow of any of the 32 lights of a word. They follow a Morton curve.
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
        find_edge_pixel(params, from, word, x, y, probed_sample(params, u, v, rotated), at);
        copy_receiver(params, from, at->slot, found->count++, found);
        found->some |= of_lights;
    }
}

/// Lists the pixels of a cell at the edge of the shadow of light `bit`.
static inline void list_edges(const EdgeCell* cell, uint bit, EdgeList* list) {
    list->count = 0u;
    for (uint i = 0u; i < cell->count; ++i)
        if ((cell->pixels[i].edges >> bit & 1u) != 0u) list->place[list->count++] = i;
}

/// The next packet of a list, from its entry `next` on; `next` becomes the entry after it. Leaves
/// out pixels whose probe began with sample `known`, if not ANY_SAMPLE: they need no further ray to
/// it. The packet is empty at the end of the list.
static inline EdgePacket next_packet(const EdgeCell* cell, const EdgeList* from, uint known,
                                     uint* next) {
    EdgePacket packet;
    uint count = 0u;
    for (; *next < from->count && count < (uint)LANES; ++*next) {
        uint place = from->place[*next];
        if (cell->pixels[place].probed == known) continue;
        packet.list.slot[count] = cell->pixels[place].slot;
        packet.place[count++] = place;
    }
    packet.list.count = count;
    return packet;
}

/// A vector of each lane, from planes `first` to `first` + 2. Lanes beyond the packet repeat the
/// first.
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

/// The lanes whose probe found light `bit` visible.
static inline WMask seen_lanes(const EdgeCell* cell, uint bit, const EdgePacket* packet) {
    uint lanes = 0u;
    for (uint lane = 0u; lane < packet->list.count; ++lane)
        lanes |= (cell->pixels[packet->place[lane]].seen >> bit & 1u) << lane;
    return mask_of(lanes);
}

#endif
