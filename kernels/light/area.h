// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Area lights are emissive triangles of one instance, which shine with the same radiance in all
// directions, to the outside of their triangles or to both sides. Points on them are uniform over
// their area. Of a textured light, whose radiance varies, triangles are chosen by area times mean
// radiance, and the radiance is that at the point.
#ifndef WEFT_KERNELS_LIGHT_AREA_H
#define WEFT_KERNELS_LIGHT_AREA_H

#include "kernels/bsdf/triangle_texture.h"
#include "kernels/core/offset.h"
#include "kernels/light/light_sample.h"

#define EMISSIVE_STRIDE ((uint)(sizeof(EmissiveTriangle) / sizeof(float)))

// Where light leaves an area light.
typedef struct {
    float3 origin;  // moved off the surface
    float3 normal;  // of the side it leaves from
    float sides;    // how many sides emit, of which this one was chosen at random
    float3 radiance;
    float area;  // 1 over the pdf per area with which the point was chosen
} AreaExit;

/// Point of an area light, uniform over the triangle that is chosen; the outside of its triangles.
/// Leaves out what it emits.
static inline LightPoint sample_area(const Geometry* geometry, LightRecord light,
                                     GLOBAL const EmissiveTriangle* emissive, float u, float v) {
    uint low = light.first +
               find_entry(&emissive[light.first].cumulative, EMISSIVE_STRIDE, light.count, u);
    float before = emissive[low].cumulative - emissive[low].probability;
    float s = rescale_number(u, before, emissive[low].probability);
    Triangle triangle = geometry->triangles[emissive[low].triangle];
    float3 a = xyz(geometry->positions[triangle.v0]);
    float3 b = xyz(geometry->positions[triangle.v1]);
    float3 c = xyz(geometry->positions[triangle.v2]);
    float root = square_root(s);
    LightPoint point;
    point.position = a * (1.0f - root) + b * (root * (1.0f - v)) + c * (root * v);
    point.normal = normalize3(cross3(b - a, c - a));
    point.entry = low;
    point.u = root * (1.0f - v);
    point.v = root * v;
    return point;
}

/// The same with the radiance there, and the pdf.
static inline LightPoint sample_emitter(const RenderParams* params, const Geometry* geometry,
                                        LightRecord light, GLOBAL const EmissiveTriangle* emissive,
                                        float u, float v) {
    LightPoint point = sample_area(geometry, light, emissive, u, v);
    point.radiance = xyz(light.power);
    point.area = light.area;
    if (!HAS(params, FEATURE_EMISSION_TEXTURES) || light.textured == 0u) return point;
    Triangle triangle = geometry->triangles[emissive[point.entry].triangle];
    uint material = geometry->instances[triangle.instance].material;
    point.radiance *= emission_texture_at(geometry, geometry->materials[material].emission_texture,
                                          triangle, point.u, point.v, 0.0f);
    point.area = 1.0f / emissive[point.entry].density;
    return point;
}

/// 1 over the pdf per area with which light samples choose points of a triangle of the light; not
/// finite where they never do.
static inline float sampled_area(const RenderParams* params, const Geometry* geometry,
                                 LightRecord light, GLOBAL const EmissiveTriangle* emissive,
                                 uint triangle) {
    if (!HAS(params, FEATURE_EMISSION_TEXTURES) || light.textured == 0u) return light.area;
    uint first = geometry->instances[geometry->triangles[triangle].instance].first_triangle;
    return 1.0f / emissive[light.first + triangle - first].density;
}

/// The point (u, v) that light leaves from, and of two sides the one that `side` falls on.
static inline AreaExit leave_area(const RenderParams* params, const Geometry* geometry,
                                  LightRecord light, GLOBAL const EmissiveTriangle* emissive,
                                  float u, float v, float side) {
    LightPoint point = sample_emitter(params, geometry, light, emissive, u, v);
    AreaExit leaves;
    leaves.radiance = point.radiance;
    leaves.area = point.area;
    leaves.normal = point.normal;
    leaves.sides = 1.0f;
    if (light.both_sides != 0u) {
        leaves.normal = side < 0.5f ? point.normal : -point.normal;
        leaves.sides = 2.0f;
    }
    leaves.origin =
        point.position + leaves.normal * surface_offset(point.position, params->scene.extent);
    return leaves;
}

/// First segment of a light path; `weight` is 1 over the probability of the light.
static inline EmittedRay emit_from_area(const RenderParams* params, const Geometry* geometry,
                                        LightRecord light, GLOBAL const EmissiveTriangle* emissive,
                                        const EmissionNumbers* numbers, float weight) {
    AreaExit leaves =
        leave_area(params, geometry, light, emissive, numbers->u, numbers->v, numbers->rest);
    weight *= leaves.sides;
    EmittedRay ray;
    ray.direction = to_world(cosine_direction(numbers->s, numbers->t), leaves.normal);
    ray.origin = leaves.origin;
    ray.flux = leaves.radiance * (weight * M_ONE_PI * leaves.area);
    return ray;
}

/// The cosine at a light's point, from `facing`, that of its outside: the cosine of the side that
/// is visible, whose normal is put into `*normal`. Not above 0 where no side that emits is visible.
static inline float seen_side(LightRecord light, float facing, float3* normal) {
    if (!(facing < 0.0f && light.both_sides != 0u)) return facing;
    *normal = -*normal;
    return -facing;
}

/// Pdf, 1/sr, of the direction to a point of pdf 1 / `area` on a light, at that distance and cosine
/// `facing`.
static inline float area_pdf(float area, float distance, float facing) {
    return (distance / facing) * (distance / area);
}

/// What a point on the light sends to a surface.
static inline LightSample area_at_surface(const RenderParams* params, const Geometry* geometry,
                                          LightRecord light,
                                          GLOBAL const EmissiveTriangle* emissive,
                                          const LitPoint* lit, float3 origin, float probability,
                                          float u, float v) {
    LightSample sample = no_light_sample();
    LightPoint point = sample_emitter(params, geometry, light, emissive, u, v);
    float3 towards = point.position - lit->position;
    if (faces(lit, towards) == 0) return sample;
    float distance = length3(towards);
    float3 normal = point.normal;
    float facing = seen_side(light, -dot3(towards, point.normal) / distance, &normal);
    if (!(facing > 0.0f) || !(distance > 0.0f)) return sample;
    sample.in = light_direction_at(params, lit, towards, distance);
    sample.power = point.radiance;
    sample.pdf = area_pdf(point.area, distance, facing) * probability;
    float3 target = point.position + normal * surface_offset(point.position, params->scene.extent);
    sample.origin = origin;
    sample.towards = target - origin;
    return sample;
}

/// What a chosen point on the light sends to a place, which is `found.distance` away along
/// `found.direction`. Its products are rounded in another order than those of area_at_surface.
static inline PlaceLight area_at_place(const RenderParams* params, const ChosenPoint* chosen,
                                       PlaceLight found) {
    float3 normal = chosen->point.normal;
    float facing = seen_side(chosen->light, -dot3(found.direction, normal), &normal);
    if (!(facing > 0.0f)) return found;
    found.pdf = (found.distance / facing) * found.distance * chosen->pdf;
    found.irradiance = chosen->point.radiance / found.pdf;
    found.target += normal * surface_offset(found.target, params->scene.extent);
    return found;
}

#endif
