// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Light in homogeneous media: transmittance, the Henyey-Greenstein phase function, free paths by
// spectral MIS, and equi-angular sampling towards a light. All kernels take the transmittance of a
// medium from here.
//
// Extinction is per kernel unit and not negative; directions are unit vectors of travel, so that
// light that goes straight on has the cosine 1.
#ifndef WEFT_KERNELS_MEDIA_MEDIUM_H
#define WEFT_KERNELS_MEDIA_MEDIUM_H

#include "kernels/core/maths.h"
#include "kernels/core/types.h"
#include "kernels/core/vector.h"

// Optical depth from which on the transmittance is no float any more.
#define OPAQUE_DEPTH 104.0f

/// exp(-sigma length), to 2 ulp: 1 for a length or an extinction of 0.
static inline float transmittance1(float sigma, float length) {
    if (!(sigma > 0.0f && length > 0.0f)) return 1.0f;
    float depth = sigma * length;
    if (!(depth < OPAQUE_DEPTH)) return 0.0f;
    // A product of such factors is rounded by itself: where it is not, its rounding would be an
    // error of up to 5e-6 of the result.
    if (depth < 1e-8f || sigma > 1e30f || length > 1e30f) return m_exp(-depth);
    FloatPair exact = m_two_product(sigma, length);
    return m_exp_pair(-exact.high, -exact.low);
}

/// Opacity of a segment, 1 - exp(-sigma length), without cancellation, to 3 ulp.
static inline float opacity1(float sigma, float length) {
    if (!(sigma > 0.0f && length > 0.0f)) return 0.0f;
    float depth = sigma * length;
    if (!(depth < OPAQUE_DEPTH)) return 1.0f;
    return -m_expm1(-depth);
}

/// Integral of the transmittance over a segment, in units of length: (1 - exp(-sigma length)) /
/// sigma, and `length` in clear air. Times a source per unit of length it is the light that leaves
/// the segment.
static inline float lit_length1(float sigma, float length) {
    if (!(length > 0.0f)) return 0.0f;
    float depth = sigma * length;
    // Below, the quotient of two denormals would lose all digits.
    if (!(depth > 1e-8f)) return length;
    return opacity1(sigma, length) / sigma;
}

/// transmittance1 of each channel.
static inline float3 beer_transmittance(float3 sigma, float length) {
    float x = transmittance1(sigma.x, length);
    // Most media are grey.
    if (sigma.y == sigma.x && sigma.z == sigma.x) return f3(x, x, x);
    return f3(x, transmittance1(sigma.y, length), transmittance1(sigma.z, length));
}

/// The least of the channels that are not clear; 0 where all are.
static inline float clearest_channel(float3 sigma) {
    float x = sigma.x > 0.0f ? sigma.x : M_INFINITY;
    float y = sigma.y > 0.0f ? sigma.y : M_INFINITY;
    float z = sigma.z > 0.0f ? sigma.z : M_INFINITY;
    float least = m_min(x, m_min(y, z));
    return least < M_INFINITY ? least : 0.0f;
}

/// Phase function of Henyey and Greenstein (1941), 1/sr: (1 - g^2) / (4 pi (1 + g^2 - 2 g
/// cos)^(3/2)); -1 < g < 1. `from` and `to` are directions of travel.
static inline float phase_function(float g, float3 from, float3 to) {
    // (1 - |g|)^2 + 2 |g| (1 - |cos|): as differences of the vectors nothing cancels where the
    // function peaks.
    float3 between = g > 0.0f ? to - from : to + from;
    float rest = 1.0f - absolute(g);
    float square = rest * rest + absolute(g) * dot3(between, between);
    return (rest * (1.0f + absolute(g))) / (12.5663706f * square * square_root(square));
}

/// Direction of travel after scattering along `from`, with the pdf of phase_function, which
/// `*pdf` receives. u, v: uniform in [0, 1).
static inline float3 scatter_direction(float g, float3 from, float u, float v, float* pdf) {
    // The inverse of the distribution, 1 - cos = 2 (1-g)^2 (1-u) (1+gu) / (1-g+2gu)^2, and
    // likewise 1 + cos: no division by g, no cancellation at either end.
    float rest = g > 0.0f ? (1.0f - g) + 2.0f * g * u : (1.0f + g) - 2.0f * g * (1.0f - u);
    float low = (1.0f - g) / rest;
    float high = (1.0f + g) / rest;
    float one_less = m_min(2.0f * low * low * ((1.0f - u) * (1.0f + g * u)), 2.0f);
    float one_more = m_min(2.0f * high * high * (u * (1.0f - g * (1.0f - u))), 2.0f);
    float cosine = one_less < 1.0f ? 1.0f - one_less : one_more - 1.0f;
    float sine = square_root(one_less * one_more);
    float s, c;
    m_sincos(6.28318531f * v, &s, &c);
    float3 tangent, bitangent;
    make_basis(from, &tangent, &bitangent);
    float ends = low * high;
    *pdf = 1.0f / (12.5663706f * (ends * ends) * rest);
    return normalize3(tangent * (sine * c) + bitangent * (sine * s) + from * cosine);
}

// Spectral MIS (Miller, Georgiev and Jarosz 2019; the balance heuristic over channels): every
// distance of a path is sampled for one channel. `ratio` holds, for each channel, the pdf of the
// path so far had all its distances been sampled for it, over the mean of these pdfs. Chosen with
// probability ratio / 3, the channel of a distance is that of the path so far by Bayes' rule, and a
// path's contribution is ratio times its throughput: no channel is ever divided by its own pdf, so
// weights stay below 3.

/// A free path in the medium, for a channel that `choice` falls into; infinite where the channel is
/// clear.
static inline float free_path(float3 sigma, float3 ratio, float choice, float u) {
    float at = choice * (ratio.x + ratio.y + ratio.z);
    float chosen = at < ratio.x ? sigma.x : (at < ratio.x + ratio.y ? sigma.y : sigma.z);
    return chosen > 0.0f ? -m_log1p(-u) / chosen : M_INFINITY;
}

/// Updates the ratios by the pdfs of an event, by channel; returns the pdf of the event over all
/// channels. The ratios become 0 where that is 0.
static inline float update_ratio(float3* ratio, float3 pdf) {
    float3 product = *ratio * pdf;
    float mean = (product.x + product.y + product.z) * 0.333333333f;
    *ratio = mean > 0.0f ? product / mean : f3(0.0f, 0.0f, 0.0f);
    return mean;
}

// A ray seen from a light's point: equi-angular sampling (Kulla and Fajardo 2012) spreads points on
// the ray evenly over the angles under which the light sees them.
typedef struct {
    float distance;      // of the ray's origin; 0: no such sampling
    float sine, cosine;  // of the angle between the ray and the way to the light
    float angle;         // under which the light sees the ray
} AngularView;

/// A light on the ray itself is taken to be this share of its distance beside it. That changes the
/// pdf, but not its integral.
#define ANGULAR_LEAST 0.0001220703125f  // 2^-13

/// The first `length` of a ray, seen from `light`.
static inline AngularView angular_view(float3 origin, float3 direction, float length,
                                       float3 light) {
    AngularView view;
    float3 to_light = light - origin;
    view.distance = length3(to_light);
    view.sine = 1.0f;
    view.cosine = 0.0f;
    view.angle = 0.0f;
    if (!(view.distance > 0.0f && length > 0.0f)) {
        view.distance = 0.0f;
        return view;
    }
    float3 unit = to_light / view.distance;
    view.sine = m_max(length3(cross3(direction, unit)), ANGULAR_LEAST);
    view.cosine = dot3(direction, unit);
    float share = m_min(length / view.distance, 1e18f);
    view.angle = m_atan2(view.sine * share,
                         view.sine * view.sine + view.cosine * view.cosine - view.cosine * share);
    if (!(view.angle > 0.0f)) view.distance = 0.0f;
    return view;
}

/// A distance along the ray, at most `length`.
static inline float angular_sample(AngularView view, float length, float u) {
    float s, c;
    m_sincos(u * view.angle, &s, &c);
    float square = view.sine * view.sine + view.cosine * view.cosine;
    float t = view.distance * (s * square / (view.sine * c + view.cosine * s));
    return m_clamp(t, 0.0f, length);
}

/// Pdf of angular_sample at `t`, per kernel unit; 0 without such sampling.
static inline float angular_pdf(AngularView view, float t) {
    if (!(view.distance > 0.0f)) return 0.0f;
    float along = t / view.distance - view.cosine;
    return view.sine / (view.angle * view.distance * (view.sine * view.sine + along * along));
}

#endif
