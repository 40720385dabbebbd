// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance records from all VPLs of a frame, in packets: their light, how it changes with place
// and normal, and how far that serves. With v = y - x from the record to a VPL, s = v.v, a = n.v,
// b = -m.v and c = a m - b n, the geometry term is f = a b / s^2, and
//   grad f   = c / s^2 + 4 a b v / s^3
//   t.H.u    = (4 ((c.t) (v.u) + (c.u) (v.t)) + (24 a b / s) (v.t) (v.u) - 4 a b t.u) / s^3
//   turn f   = b (n x v) / s^2
// for t and u in the tangent plane. Where f is bounded it is constant. What lies between a record
// and a VPL is taken not to change.
//
// The radius is that at which the mean error of the first order, (|l1| + |l2|) R^2 / 8 by the
// eigenvalues of H, is Params::cache_error of the irradiance (Schwarzhaupt et al. 2012). H sees no
// shadows: records that see some VPLs and not others serve less far.
#include "cache.h"
#include "connection.h"
#include "counters.h"
#include "gbuffer.h"
#include "packet_media.h"

// How much nearer a record serves that sees half of its light.
#define SHADOW_CARE 1.0f
// Share of the distance at which light would have fallen to nothing at its slope.
#define SLOPE_SHARE 0.5f
// How far a record serves at most, in edges of a square as large as a pixel on its surface. It
// serves its own pixel at least: with an error of 0 every pixel gathers all VPLs.
#define MOST_PIXELS 20.0f
// Rays that look for what may lie between a record and the places it serves; a multiple of LANES.
#define PROBES 16u

// Derivatives of the light of LANES records; only the upper half of the symmetric H.
typedef struct {
    WFloat3 move_red, move_green, move_blue;
    WFloat3 turn_red, turn_green, turn_blue;
    WFloat along, across, mixed;  // H of luminance in the tangent plane
    WFloat seen, all;  // luminance from VPLs that are seen, and where nothing lay between
} WideChange;

static inline WideChange no_change(void) {
    WideChange change;
    change.move_red = wide_same(0.0f);
    change.move_green = change.move_red;
    change.move_blue = change.move_red;
    change.turn_red = change.move_red;
    change.turn_green = change.move_red;
    change.turn_blue = change.move_red;
    change.along = WIDE(0.0f);
    change.across = change.along;
    change.mixed = change.along;
    change.seen = change.along;
    change.all = change.along;
    return change;
}

static inline WFloat wide_luminance(WFloat red, WFloat green, WFloat blue) {
    return red * 0.2126f + green * 0.7152f + blue * 0.0722f;
}

static inline void add_scaled(WFloat3* sum, WFloat3 v, WFloat scale) {
    sum->x = sum->x + v.x * scale;
    sum->y = sum->y + v.y * scale;
    sum->z = sum->z + v.z * scale;
}

/// Adds what a surface VPL of flux `light`, by lane, adds to the derivatives. `d` leads from it to
/// the records; `tangent` and `bitangent` span their tangent planes.
static inline void add_change(const ReceiverPacket* packet, float3 normal, WFloat3 d,
                              WFloat3 tangent, WFloat3 bitangent, const WideLight* light,
                              WideChange* change) {
    WFloat3 n = packet->shading;
    WFloat inverse = WIDE(1.0f) / wide_dot(d, d);
    WFloat square = inverse * inverse;
    WFloat a = -wide_dot(d, n);
    WFloat b = wide_dot_scalar(d, normal);
    WFloat slope = a * b * inverse * 4.0f;
    // -v is d.
    WFloat3 move = wide_vector((a * normal.x - b * n.x - slope * d.x) * square,
                               (a * normal.y - b * n.y - slope * d.y) * square,
                               (a * normal.z - b * n.z - slope * d.z) * square);
    WFloat lever = -b * square;
    WFloat3 turn = wide_vector(lever * (n.y * d.z - n.z * d.y), lever * (n.z * d.x - n.x * d.z),
                               lever * (n.x * d.y - n.y * d.x));
    add_scaled(&change->move_red, move, light->red);
    add_scaled(&change->move_green, move, light->green);
    add_scaled(&change->move_blue, move, light->blue);
    add_scaled(&change->turn_red, turn, light->red);
    add_scaled(&change->turn_green, turn, light->green);
    add_scaled(&change->turn_blue, turn, light->blue);
    WFloat bright = wide_luminance(light->red, light->green, light->blue);
    WFloat weight = bright * (square * inverse * 4.0f);
    // c.t is a (m.t), since n.t is 0.
    WFloat ct = a * wide_dot_scalar(tangent, normal);
    WFloat cu = a * wide_dot_scalar(bitangent, normal);
    WFloat vt = -wide_dot(d, tangent);
    WFloat vu = -wide_dot(d, bitangent);
    WFloat steep = a * b * inverse * 6.0f;
    change->along = change->along + weight * (ct * vt * 2.0f + steep * vt * vt - a * b);
    change->across = change->across + weight * (cu * vu * 2.0f + steep * vu * vu - a * b);
    change->mixed = change->mixed + weight * (ct * vu + cu * vt + steep * vt * vu);
}

static inline void store_vector(const Params* params, WFloat3 v, uint plane, uint slot,
                                GLOBAL float* records) {
    wide_store(v.x, records, plane * params->slots + slot);
    wide_store(v.y, records, (plane + 1u) * params->slots + slot);
    wide_store(v.z, records, (plane + 2u) * params->slots + slot);
}

static inline void store_record(const Params* params, const WideLight* light,
                                const WideChange* change, uint slot, GLOBAL float* records) {
    store_vector(params, wide_vector(light->red, light->green, light->blue), RECORD_LIGHT, slot,
                 records);
    store_vector(params, change->move_red, RECORD_MOVE, slot, records);
    store_vector(params, change->move_green, RECORD_MOVE + 3u, slot, records);
    store_vector(params, change->move_blue, RECORD_MOVE + 6u, slot, records);
    store_vector(params, change->turn_red, RECORD_TURN, slot, records);
    store_vector(params, change->turn_green, RECORD_TURN + 3u, slot, records);
    store_vector(params, change->turn_blue, RECORD_TURN + 6u, slot, records);
}

/// Adds the curvature of light that falls off as from a point at the distance of a VPL: of VPLs
/// whose geometry term is bounded, which is flat only up to the edge of a disc, or is another.
/// `square` is the squared distance, not 0.
static inline void add_bend(WFloat square, WFloat bright, WideChange* change) {
    WFloat bend = bright * 4.0f / square;
    change->along = change->along - bend;
    change->across = change->across - bend;
}

// LANES records in the making.
typedef struct {
    ReceiverPacket packet;
    PacketInside inside;
    WFloat3 tangent, bitangent;
    WFloat level;  // see roulette_level
    WideLight light;
    WideChange change;
} RecordPacket;

static inline void begin_records(const Params* params, const Media* media,
                                 GLOBAL const float* receiver_planes, uint slot,
                                 RecordPacket* records) {
    records->packet = load_receivers(params, receiver_planes, slot);
    records->inside = load_inside(params, media, receiver_planes, records->packet.position, slot);
    LaneVectors normals = lanes_of(records->packet.shading);
    LaneVectors tangents;
    LaneVectors bitangents;
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        float3 t;
        float3 b;
        make_basis(lane_vector(&normals, lane), &t, &b);
        set_lane(&tangents, lane, t);
        set_lane(&bitangents, lane, b);
    }
    records->tangent = wide_of(&tangents);
    records->bitangent = wide_of(&bitangents);
    records->level = WIDE(0.0f);
    records->light = no_light();
    records->change = no_change();
}

/// Adds a VPL, the `number`th. Returns how many rays it took.
static inline uint add_vpl(const Params* params, Scene scene, const Media* media,
                           GLOBAL const Vpl* vpl, uint number, RecordPacket* records) {
    float3 flux = xyz(vpl->flux);
    float bright = luminance(flux);
    if (!(max_component(flux) > 0.0f)) return 0u;
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    WFloat3 d = from_vpl(&records->packet, vpl);
    uint kind = as_bits(vpl->normal.w);
    WMask useful;
    WFloat g = connection(&records->packet, vpl, kind, d, &useful);
    WFloat times = one;
    if (params->roulette > 0.0f) {
        // As in vpl_gather.cl; derivatives grow by the same share.
        WFloat least = records->level / bright;
        useful = useful & (g >= least * vpl->flux.w);
        times = SELECT(g < least, least / g, times);
    }
    if (!mask_any(useful)) return 0u;
    uint rays = mask_count(useful);
    WMask blocked = trace_any_packet(scene, xyz(vpl->position), d, useful);
    // Lanes without use may be anywhere, even at the VPL.
    d = wide_vector(SELECT(useful, d.x, one), SELECT(useful, d.y, zero), SELECT(useful, d.z, zero));
    g = SELECT(useful, g, zero);
    WFloat gain = SELECT(useful, g * times * bright, zero);
    WideChange* change = &records->change;
    change->all = change->all + gain;
    useful = useful & mask_not(blocked);
    if (!mask_any(useful)) return rays;
    gain = SELECT(useful, gain, zero);
    change->seen = change->seen + gain;
    // Of geometry term 1, then of theirs.
    WideLight part = no_light();
    add_connection(params, media, &records->packet, &records->inside, xyz(vpl->position), vpl->flux,
                   SELECT(useful, times, zero), d, number, useful, &part);
    records->light.red = records->light.red + part.red * g;
    records->light.green = records->light.green + part.green * g;
    records->light.blue = records->light.blue + part.blue * g;
    WMask free = useful & (g < WIDE(vpl->position.w));
    if (kind != VPL_SURFACE) free = mask_of(0u);
    add_bend(wide_dot(d, d), SELECT(free, zero, gain), change);
    if (!mask_any(free)) return rays;
    part.red = SELECT(free, part.red, zero);
    part.green = SELECT(free, part.green, zero);
    part.blue = SELECT(free, part.blue, zero);
    add_change(&records->packet, xyz(vpl->normal), d, records->tangent, records->bitangent, &part,
               change);
    return rays;
}

/// Radius by error and by the share of light that is seen, before pixels have a say.
static inline WFloat error_radius(const Params* params, const WideChange* change, WFloat3 tangent,
                                  WFloat3 bitangent, WFloat bright) {
    WFloat slope_along =
        wide_luminance(wide_dot(change->move_red, tangent), wide_dot(change->move_green, tangent),
                       wide_dot(change->move_blue, tangent));
    WFloat slope_across = wide_luminance(wide_dot(change->move_red, bitangent),
                                         wide_dot(change->move_green, bitangent),
                                         wide_dot(change->move_blue, bitangent));
    WFloat sum = change->along + change->across;
    WFloat difference = change->along - change->across;
    WFloat apart = wide_square_root(difference * difference + change->mixed * change->mixed * 4.0f);
    WFloat bend = VMAX(sum, -sum);
    bend = VMAX(bend, apart);
    WFloat zero = WIDE(0.0f);
    WFloat far = WIDE(MEDIA_EVERYWHERE);
    WFloat ratio = bright * (8.0f * params->cache_error) / bend;
    WFloat radius = SELECT(bend > zero, wide_square_root(ratio), far);
    // H is small as well where it changes its sign; further than light falls to nothing at its
    // slope no record serves (Krivanek et al. 2006).
    WFloat slope = wide_square_root(slope_along * slope_along + slope_across * slope_across);
    WFloat fall = bright * SLOPE_SHARE / slope;
    fall = SELECT(slope > zero, fall, far);
    radius = VMIN(radius, fall);
    WFloat share = SELECT(change->all > zero, change->seen / change->all, WIDE(1.0f));
    return radius / (share * (WIDE(1.0f) - share) * (4.0f * SHADOW_CARE) + 1.0f);
}

/// 1 where anything lies within `radius` of a place on the lit side of its surface, as far as a few
/// rays tell: rings of eight, near the surface and above it.
static inline int is_guarded(Scene scene, float3 position, float3 normal, float radius) {
    float3 t;
    float3 b;
    make_basis(normal, &t, &b);
    for (uint first = 0u; first < PROBES; first += (uint)LANES) {
        LaneVectors ways;
        for (uint lane = 0u; lane < (uint)LANES; ++lane) {
            uint i = first + lane;
            float angle = 0.78539816f * ((float)(i % 8u) + (i < 8u ? 0.0f : 0.5f));
            float height = i < 8u ? 0.1f : 0.6f;
            float across = square_root(1.0f - height * height);
            float sine;
            float cosine;
            m_sincos(angle, &sine, &cosine);
            float3 way = (t * cosine + b * sine) * across + normal * height;
            set_lane(&ways, lane, way * (1.2f * radius));
        }
        if (mask_any(trace_any_packet(scene, position, wide_of(&ways), mask_of(0xFFFFu)))) return 1;
    }
    return 0;
}

/// Holds radii to what pixels want, and looks for what may lie in the way.
static inline void finish_records(const Params* params, Scene scene, const RecordPacket* packet,
                                  GLOBAL const uint* slot_pixel, GLOBAL const float4* gb_position,
                                  GLOBAL const float4* gb_normal, uint slot,
                                  GLOBAL float* records) {
    LaneVectors normals = lanes_of(packet->packet.shading);
    LaneVectors places = lanes_of(packet->packet.position);
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        GLOBAL float* radius = records + RECORD_RADIUS * params->slots + slot + lane;
        GLOBAL float* guarded = records + RECORD_GUARDED * params->slots + slot + lane;
        uint pixel = slot_pixel[slot + lane];
        *guarded = 0.0f;
        if (pixel == NO_TRIANGLE) continue;
        float4 at = gb_position[pixel];
        float across = at.w * params->pixel_angle;
        float width = square_root(gb_normal[pixel].w * across);
        *radius = m_clamp(*radius, across, MOST_PIXELS * width);
        GLOBAL float* place = records + RECORD_PLACE * params->slots + slot + lane;
        place[0] = at.x;
        place[params->slots] = at.y;
        place[2u * params->slots] = at.z;
        float3 origin = lane_vector(&places, lane);
        if (is_guarded(scene, origin, lane_vector(&normals, lane), *radius) != 0) *guarded = 1.0f;
    }
}

WEFT_KERNEL(cache_records)
(PARAMS, SCENE_ARGS, MEDIA_ARGS, GBUFFER_ARGS, GLOBAL const float* receiver_planes,
 GLOBAL const uint* slot_pixel, GLOBAL const Vpl* vpls, GLOBAL float* records,
 GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint slot = (params.first + GLOBAL_ID) * (uint)LANES;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    RecordPacket made;
    begin_records(&params, &through, receiver_planes, slot, &made);
    GLOBAL const Vpl* vpl = vpls + params.list_first;
    uint count = mask_any(made.packet.valid) ? params.list_length : 0u;
    if (params.roulette > 0.0f && count > 0u)
        made.level = roulette_level(&params, &made.packet, vpl, count);
    uint rays = 0u;
    for (uint i = 0u; i < count; ++i) rays += add_vpl(&params, scene, &through, vpl + i, i, &made);
    count_rays(counters + params.counter, rays);
    store_record(&params, &made.light, &made.change, slot, records);
    WFloat bright = wide_luminance(made.light.red, made.light.green, made.light.blue);
    wide_store(error_radius(&params, &made.change, made.tangent, made.bitangent, bright), records,
               RECORD_RADIUS * params.slots + slot);
    finish_records(&params, scene, &made, slot_pixel, gb_position, gb_normal, slot, records);
}
