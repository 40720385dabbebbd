// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Gradients of a record's irradiance over place and normal, and the radius up to which it serves.
// With v = y - x from the record to a VPL of normal m, n the record's normal, s = v.v, a = n.v, b =
// -m.v and c = a m - b n, the geometry term is f = a b / s^2, and
//   grad f   = c / s^2 + 4 a b v / s^3
//   t.H.u    = (4 ((c.t) (v.u) + (c.u) (v.t)) + (24 a b / s) (v.t) (v.u) - 4 a b t.u) / s^3
//   turn f   = b (n x v) / s^2
// with H the Hessian of f, for t and u in the tangent plane. Where f is bounded it is constant. The
// visibility of VPLs is taken not to change.
//
// The radius R is that at which the mean error of the first order, (|l1| + |l2|) R^2 / 8 by the
// eigenvalues l1 and l2 of H, is the share SamplingParams::record_error of the irradiance
// (Schwarzhaupt et al. 2012). H knows no shadows, so records that see only some of the VPLs get
// smaller radii.
#ifndef WEFT_KERNELS_CACHE_RECORD_CHANGE_H
#define WEFT_KERNELS_CACHE_RECORD_CHANGE_H

#include "kernels/light/connection.h"
#include "kernels/media/packet_media.h"

// By how much shadows shrink a radius: where half of the light is visible, by 1 / (1 +
// SHADOW_CARE).
#define SHADOW_CARE 1.0f
// Largest radius, as a share of the distance at which light would have fallen to nothing at its
// slope.
#define SLOPE_SHARE 0.5f

// Derivatives of the light of LANES records; of the symmetric H only the upper half.
typedef struct {
    WFloat3 move_red, move_green, move_blue;
    WFloat3 turn_red, turn_green, turn_blue;
    WFloat along, across, mixed;  // H of luminance in the tangent plane
    WFloat seen, all;             // luminance from visible VPLs, and from all, were none hidden
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

/// Adds a curvature for a VPL whose geometry term is bounded, and so flat only up to the edge of a
/// disc, or is not that of a surface: the curvature of light that falls off as from a point at the
/// VPL's distance. `square` is the squared distance, not 0.
static inline void add_bend(WFloat square, WFloat bright, WideChange* change) {
    WFloat bend = bright * 4.0f / square;
    change->along = change->along - bend;
    change->across = change->across - bend;
}

/// Radius by error, slope and the share of light that is visible, before pixel sizes bound it.
static inline WFloat error_radius(const RenderParams* params, const WideChange* change,
                                  WFloat3 tangent, WFloat3 bitangent, WFloat bright) {
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
    WFloat ratio = bright * (8.0f * params->sampling.record_error) / bend;
    WFloat radius = SELECT(bend > zero, wide_square_root(ratio), far);
    // H is also small where it changes its sign. So the distance at which light would have fallen
    // to nothing at its slope bounds the radius as well (Krivanek et al. 2006).
    WFloat slope = wide_square_root(slope_along * slope_along + slope_across * slope_across);
    WFloat fall = bright * SLOPE_SHARE / slope;
    fall = SELECT(slope > zero, fall, far);
    radius = VMIN(radius, fall);
    WFloat share = SELECT(change->all > zero, change->seen / change->all, WIDE(1.0f));
    return radius / (share * (WIDE(1.0f) - share) * (4.0f * SHADOW_CARE) + 1.0f);
}

#endif
