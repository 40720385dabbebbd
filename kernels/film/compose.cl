// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Composes the radiance of every pixel from its surface and irradiance, and adds it to the film.
// Edge pixels are left to edge_samples.cl where the frame has edge samples. One work-item for LANES
// pixels of a row; where one of them is not good (guard.h), or the row ends, pixel by pixel, with
// the same result.
#include "kernels/core/kernel.h"
#include "kernels/film/film.h"
#include "kernels/film/wide_pixels.h"

// FilmSample of LANES pixels.
typedef struct {
    WFloat3 emission, direct, indirect, media, reflection, refraction, glossy, albedo, normal;
    WFloat depth, alpha;
} WideSample;

static inline WFloat3 product(WFloat3 a, WFloat3 b) {
    a.x = a.x * b.x;
    a.y = a.y * b.y;
    a.z = a.z * b.z;
    return a;
}

static inline WMask is_good_lane(WFloat v) {
    const WFloat zero = WIDE(0.0f), infinity = WIDE(M_INFINITY);
    return (v >= zero) & (v < infinity);
}

/// Lanes that guard() lets pass.
static inline WMask are_good(WFloat3 v) {
    return is_good_lane(v.x) & is_good_lane(v.y) & is_good_lane(v.z);
}

static inline WFloat3 black(void) {
    WFloat3 none;
    none.x = WIDE(0.0f);
    none.y = none.x;
    none.z = none.x;
    return none;
}

/// COMPOSED of three channels.
static inline WFloat3 composed(WFloat3 radiance, WFloat3 reflectance, WFloat3 irradiance) {
    WFloat3 sum;
    sum.x = COMPOSED(radiance.x, reflectance.x, irradiance.x);
    sum.y = COMPOSED(radiance.y, reflectance.y, irradiance.y);
    sum.z = COMPOSED(radiance.z, reflectance.z, irradiance.z);
    return sum;
}

/// Irradiance by direct light; see pixel_light.
static inline WFloat3 direct_irradiance(const RenderParams* params, const SeenPixels* seen,
                                        const IrradianceBuffers* buffers, uint first) {
    WFloat3 e = black();
    if (HAS(params, FEATURE_EXACT_DIRECT)) {
        float x[LANES], y[LANES], z[LANES];
        for (uint lane = 0u; lane < LANES; ++lane) {
            uint pixel = first + lane;
            float3 one =
                pixel_light(params, buffers, pixel, pixel_is_lit(seen->ids, seen->albedo, pixel))
                    .direct;
            x[lane] = one.x;
            y[lane] = one.y;
            z[lane] = one.z;
        }
        e.x = wide_load(x, 0);
        e.y = wide_load(y, 0);
        e.z = wide_load(z, 0);
    } else if (HAS(params, FEATURE_SAMPLED_DIRECT)) {
        e = load_vectors(buffers->direct + first);
    }
    return e;
}

/// Distances of pixels' surfaces from the camera along its axis, 0 where there is none.
static inline WFloat wide_depth(const RenderParams* params, const SeenPixels* seen, uint first) {
    WFloat t = load_fourth(seen->position + first);
    if (!HAS(params, FEATURE_ORTHOGRAPHIC)) return t;
    WFloat zero = WIDE(0.0f);
    return SELECT(t > zero, t + params->camera.origin.w, zero);
}

/// Alpha of pixels; see film_alpha.
static inline WFloat wide_alpha(const RenderParams* params, const SeenPixels* seen,
                                const IrradianceBuffers* buffers, uint first) {
    const WFloat zero = WIDE(0.0f), one = WIDE(1.0f);
    float met[LANES];
    for (uint lane = 0u; lane < LANES; ++lane)
        met[lane] = seen->ids[2u * (first + lane)] != INVALID_INDEX ? 1.0f : 0.0f;
    WFloat beyond = one;
    if (environment_seen(params) == 0) {
        beyond = zero;
        if (HAS(params, FEATURE_MEDIA)) {
            WFloat3 through = load_vectors(buffers->view_transmittance + first);
            beyond = one - (through.x + through.y + through.z) * (1.0f / 3.0f);
        }
    }
    return SELECT(wide_load(met, 0) > zero, one, beyond);
}

/// What pixels show in mirrors and through their surfaces; returns which of them are good.
static inline WMask wide_chains(const RenderParams* params, const IrradianceBuffers* buffers,
                                uint first, WideSample* sample) {
    sample->reflection = black();
    sample->refraction = black();
    sample->glossy = black();
    if (HAS(params, FEATURE_REFLECTION))
        sample->reflection = load_vectors(buffers->reflection_light + first);
    if (HAS(params, FEATURE_REFRACTION))
        sample->refraction = load_vectors(buffers->refraction_light + first);
    if (HAS(params, FEATURE_GLOSSY)) sample->glossy = load_vectors(buffers->glossy_light + first);
    if (HAS(params, FEATURE_MEDIA)) {
        WFloat3 transmittance = load_vectors(buffers->view_transmittance + first);
        sample->reflection = product(sample->reflection, transmittance);
        sample->refraction = product(sample->refraction, transmittance);
        sample->glossy = product(sample->glossy, transmittance);
    }
    return are_good(sample->reflection) & are_good(sample->refraction) & are_good(sample->glossy);
}

/// The samples of pixels from `first` on, and which of them are good.
static inline WMask wide_sample(const RenderParams* params, const SeenPixels* seen,
                                const IrradianceBuffers* buffers, uint first, WideSample* sample) {
    sample->albedo = load_vectors(seen->albedo + first);
    sample->emission = load_vectors(seen->emission + first);
    sample->normal = load_vectors(seen->shading + first);
    sample->depth = wide_depth(params, seen, first) / params->scene.unit;
    sample->alpha = wide_alpha(params, seen, buffers, first);
    WFloat3 reflectance;
    reflectance.x = LAMBERT_REFLECTANCE(sample->albedo.x);
    reflectance.y = LAMBERT_REFLECTANCE(sample->albedo.y);
    reflectance.z = LAMBERT_REFLECTANCE(sample->albedo.z);
    // As in no_pixel_light: no component hands over radiance yet.
    sample->media = black();
    WFloat3 direct_radiance = black();
    WFloat3 indirect_radiance = black();
    if (HAS(params, FEATURE_MEDIA)) {
        WFloat3 transmittance = load_vectors(buffers->view_transmittance + first);
        reflectance = product(reflectance, transmittance);
        sample->emission = product(sample->emission, transmittance);
        direct_radiance = product(direct_radiance, transmittance);
        indirect_radiance = product(indirect_radiance, transmittance);
    }
    if (HAS(params, FEATURE_EMISSIVE_MEDIA)) {
        WFloat3 media_emission = load_vectors(buffers->view_emission + first);
        sample->emission.x = sample->emission.x + media_emission.x;
        sample->emission.y = sample->emission.y + media_emission.y;
        sample->emission.z = sample->emission.z + media_emission.z;
    }
    sample->direct =
        composed(direct_radiance, reflectance, direct_irradiance(params, seen, buffers, first));
    WFloat3 indirect = black();
    if (HAS(params, FEATURE_INDIRECT)) indirect = load_vectors(buffers->indirect + first);
    sample->indirect = composed(indirect_radiance, reflectance, indirect);
    WMask good = are_good(sample->emission) & are_good(sample->direct);
    good = good & are_good(sample->indirect);
    good = good & are_good(sample->albedo);
    good = good & is_good_lane(sample->depth);
    if (HAS(params, FEATURE_AIRLIGHT)) {
        sample->media = load_vectors(buffers->media_light + first);
        good = good & are_good(sample->media);
    }
    if (HAS(params, FEATURE_REFLECTION | FEATURE_REFRACTION | FEATURE_GLOSSY))
        good = good & wide_chains(params, buffers, first, sample);
    return good;
}

/// add_to_film for LANES pixels but those of `others`, which keep what they have.
static inline void add_wide(GLOBAL float* high, GLOBAL float* low, uint samples, WMask others,
                            WFloat x) {
    WFloat zero = WIDE(0.0f);
    if (samples == 0u) {
        // What others have before the first sample is undefined.
        wide_store(zero + x, high, 0);
        return;
    }
    WFloat sum = wide_load(high, 0);
    WFloat before = samples == 1u ? zero : wide_load(low, 0);
    WFloat total = sum + x;
    WFloat size = VMAX(sum, -sum);
    WFloat size_x = VMAX(x, -x);
    WFloat rest = before + SELECT(size >= size_x, (sum - total) + x, (x - total) + sum);
    wide_store(SELECT(others, sum, total), high, 0);
    wide_store(SELECT(others, before, rest), low, 0);
}

static inline void add_wide_vector(GLOBAL float* high, GLOBAL float* low, uint stride, uint samples,
                                   WMask others, WFloat3 x) {
    add_wide(high, low, samples, others, x.x);
    add_wide(high + stride, low + stride, samples, others, x.y);
    add_wide(high + 2u * stride, low + 2u * stride, samples, others, x.z);
}

static inline void add_wide_sample(const RenderParams* params, GLOBAL float* film_high,
                                   GLOBAL float* film_low, uint first, WMask others,
                                   const WideSample* sample) {
    uint stride = FILM_STRIDE(params->camera.width * params->camera.height);
    uint samples = params->sampling.sample;
    GLOBAL float* high = film_high + first;
    GLOBAL float* low = film_low + first;
    add_wide_vector(high + FILM_EMISSION * stride, low + FILM_EMISSION * stride, stride, samples,
                    others, sample->emission);
    add_wide_vector(high + FILM_DIRECT * stride, low + FILM_DIRECT * stride, stride, samples,
                    others, sample->direct);
    add_wide_vector(high + FILM_INDIRECT * stride, low + FILM_INDIRECT * stride, stride, samples,
                    others, sample->indirect);
    add_wide_vector(high + FILM_ALBEDO * stride, low + FILM_ALBEDO * stride, stride, samples,
                    others, sample->albedo);
    add_wide_vector(high + FILM_NORMAL * stride, low + FILM_NORMAL * stride, stride, samples,
                    others, sample->normal);
    add_wide(high + FILM_DEPTH * stride, low + FILM_DEPTH * stride, samples, others, sample->depth);
    add_wide(high + FILM_ALPHA * stride, low + FILM_ALPHA * stride, samples, others, sample->alpha);
    if (HAS(params, FEATURE_AIRLIGHT))
        add_wide_vector(high + FILM_MEDIA * stride, low + FILM_MEDIA * stride, stride, samples,
                        others, sample->media);
    if (HAS(params, FEATURE_REFLECTION)) {
        uint plane = film_reflection_plane(params->features) * stride;
        add_wide_vector(high + plane, low + plane, stride, samples, others, sample->reflection);
    }
    if (HAS(params, FEATURE_REFRACTION)) {
        uint plane = film_refraction_plane(params->features) * stride;
        add_wide_vector(high + plane, low + plane, stride, samples, others, sample->refraction);
    }
    if (HAS(params, FEATURE_GLOSSY)) {
        uint plane = film_glossy_plane(params->features) * stride;
        add_wide_vector(high + plane, low + plane, stride, samples, others, sample->glossy);
    }
}

WEFT_KERNEL(compose)
{
    if (WORK_ITEM(range) >= range.count) return;
    IRRADIANCE_MAKE(buffers);
    SEEN_PIXELS_MAKE(seen);
    PixelRun run = pixel_run(&params, range.first + WORK_ITEM(range));
    uint edges = params.sampling.edge_samples != 0u ? run_bits(&params, edge_masks, &run) : 0u;
    if (run.count == LANES) {
        WideSample sample;
        WMask good = wide_sample(&params, &seen, &buffers, run.first, &sample);
        if (mask_all(good) != 0) {
            add_wide_sample(&params, film_high, film_low, run.first, mask_of(edges), &sample);
            return;
        }
    }
    for (uint i = 0u; i < run.count; ++i) {
        if ((edges >> i & 1u) != 0u) continue;
        FilmSample sample = pixel_sample(&params, &seen, &buffers, nonfinite, run.first + i);
        add_film_sample(&params, film_high, film_low, run.first + i, &sample);
    }
}
