// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Fresnel's equations: which share of light a smooth boundary reflects, for clear dielectrics, for
// metals, and by Schlick's approximation. `c` is the cosine between the boundary's normal and the
// direction on the side that is asked for, in [0, 1].
#ifndef WEFT_KERNELS_BSDF_FRESNEL_H
#define WEFT_KERNELS_BSDF_FRESNEL_H

#include "kernels/core/vector.h"

// Indices that differ by less than this bend and reflect nothing (2.4e-7 at normal incidence).
#define LEAST_INDEX_STEP 0.0009765625f  // 2^-10

// A boundary as seen from one of its sides. The host makes both numbers from doubles: `step` made
// of a float `eta` near 1 would have lost most of its digits.
typedef struct {
    float eta;   // index beyond the boundary over the index on this side
    float step;  // eta^2 - 1
} IndexRatio;

/// Whether there is a boundary at all.
static inline bool bends_light(IndexRatio ratio) {
    return absolute(ratio.step) >= LEAST_INDEX_STEP * (ratio.eta + 1.0f);
}

// What a dielectric does with light at one angle.
typedef struct {
    float reflected, transmitted;  // shares of the power of unpolarised light; their sum is 1
    float g;  // eta times the cosine of the refracted direction; 0 at total reflection
} DielectricFresnel;

/// Fresnel's equations for a dielectric. With g^2 = c^2 + eta^2 - 1 the amplitudes (c - g) / (c +
/// g) and (eta^2 c - g) / (eta^2 c + g) become quotients in which nothing cancels for eta near 1,
/// and so does 1 - F: 5e-7 of F and 3e-7 of 1 - F for c above 1e-3 and |eta - 1| above 1e-4. Near
/// the critical angle the rounding of c leaves 1e-5.
static inline DielectricFresnel dielectric_fresnel(IndexRatio ratio, float c) {
    DielectricFresnel f;
    f.reflected = 1.0f;
    f.transmitted = 0.0f;
    f.g = 0.0f;
    float square = c * c + ratio.step;
    if (!(square > 0.0f)) return f;
    f.g = square_root(square);
    float eta2 = ratio.eta * ratio.eta;
    float sum = c + f.g;
    float other = eta2 * c + f.g;
    float s = ratio.step / (sum * sum);
    float p = ratio.step * ((eta2 + 1.0f) * c * c - 1.0f) / (other * other);
    f.reflected = 0.5f * (s * s + p * p);
    f.transmitted = 2.0f * c * f.g * (1.0f / (sum * sum) + eta2 / (other * other));
    return f;
}

/// Share of the light that a dielectric reflects at normal incidence, (eta - 1)^2 / (eta + 1)^2.
static inline float normal_reflectance(IndexRatio ratio) {
    float root = ratio.step / ((ratio.eta + 1.0f) * (ratio.eta + 1.0f));
    return root * root;
}

/// Direction that leads away from a boundary beyond it, for light that leaves on this side along
/// `v`: Snell's law. `m` is the normal on the side of `v`, c = dot(v, m), and g that of
/// dielectric_fresnel, above 0.
static inline float3 refracted_direction(IndexRatio ratio, float3 v, float3 m, float c, float g) {
    return (v + m * (ratio.step / (c + g))) * (-1.0f / ratio.eta);
}

/// Mirror image of `v` at the plane with the normal `m`, where c = dot(v, m).
static inline float3 reflected_direction(float3 v, float3 m, float c) {
    return m * (2.0f * c) - v;
}

/// Fresnel's equations for a metal with the index eta + i k relative to what lies before it, in
/// sums of squares, which cannot become negative.
static inline float conductor_fresnel1(float eta, float k, float c) {
    // The root u + i w of (eta + i k)^2 - sin^2; the larger of the two first, from which the other
    // follows without cancellation.
    float real = eta * eta - k * k;
    float imaginary = 2.0f * eta * k;
    float t = real - (1.0f - c) * (1.0f + c);
    float size = square_root(t * t + imaginary * imaginary);
    float larger = square_root(0.5f * (size + absolute(t)));
    float smaller = larger > 0.0f ? eta * k / larger : 0.0f;
    float u = t >= 0.0f ? larger : smaller;
    float w = t >= 0.0f ? smaller : larger;
    float s_less = (c - u) * (c - u) + w * w;
    float s_more = (c + u) * (c + u) + w * w;
    float p = real * c;
    float q = imaginary * c;
    float p_less = (p - u) * (p - u) + (q - w) * (q - w);
    float p_more = (p + u) * (p + u) + (q + w) * (q + w);
    // Both are 0 only where the index is 0, or along a boundary of none.
    float s = s_more > 0.0f ? s_less / s_more : 1.0f;
    return p_more > 0.0f ? 0.5f * (s + p_less / p_more) : s;
}

/// The same for each channel.
static inline float3 conductor_fresnel(float3 eta, float3 k, float c) {
    return f3(conductor_fresnel1(eta.x, k.x, c), conductor_fresnel1(eta.y, k.y, c),
              conductor_fresnel1(eta.z, k.z, c));
}

/// Schlick's weight (1 - c)^5 (Schlick 1994, equation 15).
static inline float schlick_weight(float c) {
    float less = m_max(1.0f - c, 0.0f);
    float square = less * less;
    return square * square * less;
}

/// Schlick's approximation from f0, at normal incidence, to f90, along the surface.
static inline float3 schlick_fresnel(float3 f0, float3 f90, float c) {
    return f0 + (f90 - f0) * schlick_weight(c);
}

// What a coloured boundary does with light at one angle.
typedef struct {
    float3 reflected, transmitted;  // their sum is 1
    float g;                        // see DielectricFresnel
} ColouredFresnel;

/// Fresnel's equations for a dielectric whose reflectance is f0 at normal incidence and f90 along
/// the surface (glTF: KHR_materials_specular, KHR_materials_volume). The exact term takes the place
/// of Schlick's weight, so that f0 of the index and f90 = 1 give the exact term itself. Total
/// reflection is total, whatever f90 is.
static inline ColouredFresnel coloured_fresnel(IndexRatio ratio, float3 f0, float f90, float c) {
    DielectricFresnel exact = dielectric_fresnel(ratio, c);
    ColouredFresnel f;
    f.g = exact.g;
    f.reflected = f3(1.0f, 1.0f, 1.0f);
    f.transmitted = f3(0.0f, 0.0f, 0.0f);
    if (exact.g == 0.0f) return f;
    float normal = normal_reflectance(ratio);
    float edge = (exact.reflected - normal) / (1.0f - normal);
    float rest = exact.transmitted / (1.0f - normal);
    float3 one = f3(1.0f, 1.0f, 1.0f);
    float3 along = f3(f90, f90, f90);
    // The exact term falls below its value at normal incidence where eta is above 4.
    f.reflected = highest3(f0 * rest + along * edge, f3(0.0f, 0.0f, 0.0f));
    f.transmitted = lowest3((one - f0) * rest + (one - along) * edge, one);
    return f;
}

#endif
