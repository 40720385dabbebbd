// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Turns the light of components into radiance, and adds that to the film. Components hand over
// radiance, or irradiance, which counts times the surface's diffuse reflectance. Values that are
// not finite, or are negative, are counted and set to 0, so that they never reach the film. The
// film sums samples in compensated float pairs.
#ifndef WEFT_KERNELS_FILM_FILM_H
#define WEFT_KERNELS_FILM_FILM_H

#include "kernels/bsdf/lambert.h"
#include "kernels/core/guard.h"
#include "kernels/film/camera.h"
#include "kernels/film/discontinuity.h"
#include "kernels/light/environment.h"

// Fills in IrradianceBuffers from `slots` and the arguments of GROUP_ComposedLight; those that a
// frame does not have are never read.
#define IRRADIANCE_MAKE(name)                     \
    IrradianceBuffers name;                       \
    name.pixel_slot = pixel_slot;                 \
    name.direct = direct;                         \
    name.exact_irradiance = exact_irradiance;     \
    name.slots = slots;                           \
    name.indirect = indirect;                     \
    name.view_transmittance = view_transmittance; \
    name.view_emission = view_emission;           \
    name.media_light = media_light;               \
    name.reflection_light = reflection_light;     \
    name.refraction_light = refraction_light;     \
    name.glossy_light = glossy_light

#define SEEN_PIXELS_MAKE(name)   \
    SeenPixels name;             \
    name.ids = gb_ids;           \
    name.position = gb_position; \
    name.shading = gb_shading;   \
    name.albedo = gb_albedo;     \
    name.emission = gb_emission

typedef struct {
    GLOBAL const uint* pixel_slot;            // where exact irradiance is found
    GLOBAL const float4* direct;              // by pixel
    GLOBAL const float* exact_irradiance;     // by slot
    uint slots;                               // stride of its planes
    GLOBAL const float4* indirect;            // by pixel
    GLOBAL const float4* view_transmittance;  // of media along a pixel's view ray
    GLOBAL const float4* view_emission;       // radiance that they emit to the camera
    GLOBAL const float4* media_light;         // and that they scatter to the camera
    GLOBAL const float4* reflection_light;    // radiance that pixels show in mirrors
    GLOBAL const float4* refraction_light;    // through glass and gaps
    GLOBAL const float4* glossy_light;        // and on glossy surfaces
} IrradianceBuffers;

// Light of a pixel's surface, and of the media before it.
typedef struct {
    float3 direct, indirect;                    // irradiance
    float3 direct_radiance, indirect_radiance;  // that the surface sends to the camera besides what
                                                // it reflects diffusely
    float3 transmittance;   // of the media between the surface and the camera, by channel
    float3 media_emission;  // radiance that media emit to the camera
    float3 media;           // and that they scatter to it
    float3 reflection, refraction, glossy;  // radiance that the surface shows in mirrors,
                                            // through it and by gloss
} PixelLight;

/// Radiance of a component, from what it hands over as radiance and as irradiance. For numbers,
/// vectors or wide values.
#define COMPOSED(radiance, reflectance, irradiance) ((radiance) + (reflectance) * (irradiance))

// What the primary rays through pixels found; see gbuffer.h.
typedef struct {
    GLOBAL const uint* ids;
    GLOBAL const float4* position;
    GLOBAL const float4* shading;
    GLOBAL const float4* albedo;
    GLOBAL const float4* emission;
} SeenPixels;

// What the film holds of one point of the image.
typedef struct {
    float3 emission, direct, indirect, media;  // radiance
    float3 reflection, refraction, glossy;
    float3 albedo, normal;
    float depth;  // scene units
    float alpha;  // 1 where a surface is seen; elsewhere what media hide of the background
} FilmSample;

static inline FilmSample no_film_sample(void) {
    FilmSample sample;
    sample.emission = f3(0.0f, 0.0f, 0.0f);
    sample.direct = sample.emission;
    sample.indirect = sample.emission;
    sample.media = sample.emission;
    sample.reflection = sample.emission;
    sample.refraction = sample.emission;
    sample.glossy = sample.emission;
    sample.albedo = sample.emission;
    sample.normal = sample.emission;
    sample.depth = 0.0f;
    sample.alpha = 0.0f;
    return sample;
}

static inline PixelLight no_pixel_light(void) {
    PixelLight light;
    light.direct = f3(0.0f, 0.0f, 0.0f);
    light.indirect = light.direct;
    light.direct_radiance = light.direct;
    light.indirect_radiance = light.direct;
    light.transmittance = f3(1.0f, 1.0f, 1.0f);
    light.media_emission = light.direct;
    light.media = light.direct;
    light.reflection = light.direct;
    light.refraction = light.direct;
    light.glossy = light.direct;
    return light;
}

/// Fills in what media do to a pixel's light.
static inline void add_view_media(const RenderParams* params, const IrradianceBuffers* buffers,
                                  uint pixel, PixelLight* light) {
    if (HAS(params, FEATURE_MEDIA)) light->transmittance = xyz(buffers->view_transmittance[pixel]);
    if (HAS(params, FEATURE_EMISSIVE_MEDIA))
        light->media_emission = xyz(buffers->view_emission[pixel]);
    if (HAS(params, FEATURE_AIRLIGHT)) light->media = xyz(buffers->media_light[pixel]);
}

/// Fills in what a pixel shows in mirrors and through its surface.
static inline void add_view_chains(const RenderParams* params, const IrradianceBuffers* buffers,
                                   uint pixel, PixelLight* light) {
    if (HAS(params, FEATURE_REFLECTION)) light->reflection = xyz(buffers->reflection_light[pixel]);
    if (HAS(params, FEATURE_REFRACTION)) light->refraction = xyz(buffers->refraction_light[pixel]);
    if (HAS(params, FEATURE_GLOSSY)) light->glossy = xyz(buffers->glossy_light[pixel]);
}

/// Light of a pixel; `lit` says whether it shows a surface that reflects diffusely.
static inline PixelLight pixel_light(const RenderParams* params, const IrradianceBuffers* buffers,
                                     uint pixel, int lit) {
    PixelLight light = no_pixel_light();
    if (HAS(params, FEATURE_SAMPLED_DIRECT)) light.direct = xyz(buffers->direct[pixel]);
    if (HAS(params, FEATURE_EXACT_DIRECT) && lit != 0)
        light.direct +=
            slot_irradiance(buffers->exact_irradiance, buffers->slots, buffers->pixel_slot[pixel]);
    if (HAS(params, FEATURE_INDIRECT)) light.indirect = xyz(buffers->indirect[pixel]);
    add_view_media(params, buffers, pixel, &light);
    return light;
}

/// Alpha of a ray through media of that transmittance; `met` says whether it meets a surface.
static inline float film_alpha(const RenderParams* params, int met, float3 transmittance) {
    return met != 0 ? 1.0f : background_alpha(params, transmittance);
}

/// What a surface under that light sends to the camera; `t` is how far along its ray it lies.
/// Without a surface, `met` is 0.
static inline FilmSample film_sample(const RenderParams* params, GLOBAL NonfiniteCounter* nonfinite,
                                     uint pixel, int met, float3 emission, float3 albedo,
                                     PixelLight light, float3 normal, float t) {
    FilmSample sample;
    float3 reflectance = LAMBERT_REFLECTANCE(albedo);
    if (HAS(params, FEATURE_MEDIA)) {
        reflectance *= light.transmittance;
        emission *= light.transmittance;
        light.direct_radiance *= light.transmittance;
        light.indirect_radiance *= light.transmittance;
        light.reflection *= light.transmittance;
        light.refraction *= light.transmittance;
        light.glossy *= light.transmittance;
    }
    if (HAS(params, FEATURE_EMISSIVE_MEDIA)) emission += light.media_emission;
    float3 direct = COMPOSED(light.direct_radiance, reflectance, light.direct);
    float3 indirect = COMPOSED(light.indirect_radiance, reflectance, light.indirect);
    sample.emission = guard(nonfinite, COMPONENT_EMISSION, pixel, emission);
    sample.direct = guard(nonfinite, COMPONENT_DIRECT, pixel, direct);
    sample.indirect = guard(nonfinite, COMPONENT_INDIRECT, pixel, indirect);
    sample.media = light.media;
    if (HAS(params, FEATURE_AIRLIGHT))
        sample.media = guard(nonfinite, COMPONENT_MEDIA, pixel, light.media);
    sample.reflection = light.reflection;
    if (HAS(params, FEATURE_REFLECTION))
        sample.reflection = guard(nonfinite, COMPONENT_REFLECTION, pixel, light.reflection);
    sample.refraction = light.refraction;
    if (HAS(params, FEATURE_REFRACTION))
        sample.refraction = guard(nonfinite, COMPONENT_REFRACTION, pixel, light.refraction);
    sample.glossy = light.glossy;
    if (HAS(params, FEATURE_GLOSSY))
        sample.glossy = guard(nonfinite, COMPONENT_GLOSSY, pixel, light.glossy);
    sample.albedo = guard(nonfinite, COMPONENT_SURFACE, pixel, albedo);
    sample.normal = normal;
    float depth = (met != 0 ? camera_depth(params, t) : 0.0f) / params->scene.unit;
    sample.depth = guard(nonfinite, COMPONENT_SURFACE, pixel, f3(depth, 0.0f, 0.0f)).x;
    sample.alpha = film_alpha(params, met, light.transmittance);
    return sample;
}

/// What the pixel's own primary ray shows.
static inline FilmSample pixel_sample(const RenderParams* params, const SeenPixels* seen,
                                      const IrradianceBuffers* buffers,
                                      GLOBAL NonfiniteCounter* nonfinite, uint pixel) {
    int lit = pixel_is_lit(seen->ids, seen->albedo, pixel);
    int met = seen->ids[2u * pixel] != INVALID_INDEX ? 1 : 0;
    PixelLight light = pixel_light(params, buffers, pixel, lit);
    add_view_chains(params, buffers, pixel, &light);
    return film_sample(params, nonfinite, pixel, met, xyz(seen->emission[pixel]),
                       xyz(seen->albedo[pixel]), light, xyz(seen->shading[pixel]),
                       seen->position[pixel].w);
}

/// Neumaier's compensated sum, to which `samples` have been added. What is undefined before the
/// first one is not read, and what is 0 after it is neither written nor read.
static inline void add_to_film(GLOBAL float* high, GLOBAL float* low, uint at, uint samples,
                               float x) {
    if (samples == 0u) {
        high[at] = 0.0f + x;
        return;
    }
    float sum = high[at];
    float rest = samples == 1u ? 0.0f : low[at];
    float total = sum + x;
    if (absolute(sum) >= absolute(x))
        rest += (sum - total) + x;
    else
        rest += (x - total) + sum;
    high[at] = total;
    low[at] = rest;
}

static inline void add_vector(GLOBAL float* high, GLOBAL float* low, uint at, uint stride,
                              uint samples, float3 x) {
    add_to_film(high, low, at, samples, x.x);
    add_to_film(high, low, at + stride, samples, x.y);
    add_to_film(high, low, at + 2u * stride, samples, x.z);
}

static inline void add_film_sample(const RenderParams* params, GLOBAL float* film_high,
                                   GLOBAL float* film_low, uint pixel, const FilmSample* sample) {
    uint stride = FILM_STRIDE(params->camera.width * params->camera.height);
    uint samples = params->sampling.sample;
    GLOBAL float* high = film_high + pixel;
    GLOBAL float* low = film_low + pixel;
    add_vector(high, low, FILM_EMISSION * stride, stride, samples, sample->emission);
    add_vector(high, low, FILM_DIRECT * stride, stride, samples, sample->direct);
    add_vector(high, low, FILM_INDIRECT * stride, stride, samples, sample->indirect);
    add_vector(high, low, FILM_ALBEDO * stride, stride, samples, sample->albedo);
    add_vector(high, low, FILM_NORMAL * stride, stride, samples, sample->normal);
    add_to_film(high, low, FILM_DEPTH * stride, samples, sample->depth);
    add_to_film(high, low, FILM_ALPHA * stride, samples, sample->alpha);
    if (HAS(params, FEATURE_AIRLIGHT))
        add_vector(high, low, FILM_MEDIA * stride, stride, samples, sample->media);
    if (HAS(params, FEATURE_REFLECTION))
        add_vector(high, low, film_reflection_plane(params->features) * stride, stride, samples,
                   sample->reflection);
    if (HAS(params, FEATURE_REFRACTION))
        add_vector(high, low, film_refraction_plane(params->features) * stride, stride, samples,
                   sample->refraction);
    if (HAS(params, FEATURE_GLOSSY))
        add_vector(high, low, film_glossy_plane(params->features) * stride, stride, samples,
                   sample->glossy);
}

#endif
