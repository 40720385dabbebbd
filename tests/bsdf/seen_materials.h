// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials whose lobes tests look at. The test defines NATIVE_KERNELS before it includes this.
#ifndef WEFT_TESTS_BSDF_SEEN_MATERIALS_H
#define WEFT_TESTS_BSDF_SEEN_MATERIALS_H

#include <cmath>

#include "tests/testing/native_kernels.h"

namespace weft::seen_materials {

using native::f3;
using native::float3;
using native::LayeredBsdf;
using native::LayeredMaterial;
using native::make_facets;
using native::SeenLobes;

// As surfaces are seen that the camera sees itself, and those that are seen in mirrors.
constexpr native::FacetChoice middle{0.5F, 0.5F, 0.5F, ANY_ALPHA};
constexpr native::FacetChoice mirrored{0.5F, 0.5F, 0.5F, GLOSSY_ALPHA};

inline float3 direction(float cosine) {
    return f3(std::sqrt((1.0F - cosine) * (1.0F + cosine)), 0.0F, cosine);
}

/// A dielectric of index 1.5 with a body of that colour.
inline LayeredMaterial dielectric(float alpha, float base) {
    LayeredMaterial material{};
    material.base = f3(base, base, base);
    material.f0 = f3(0.04F, 0.04F, 0.04F);
    material.f90 = 1.0F;
    material.facets = make_facets(alpha, alpha, 0);
    material.sheet = material.facets;
    material.coat_facets = make_facets(0.0F, 0.0F, 0);
    material.ratio = {1.5F, 1.25F};
    material.glass_albedo = 1.0F;
    material.coat_normal = f3(0, 0, 1);
    material.diffuse_normal = f3(0, 0, 1);
    material.geometric_normal = f3(0, 0, 1);
    return material;
}

inline LayeredMaterial metal(float alpha) {
    LayeredMaterial material = dielectric(alpha, 0.8F);
    material.metallic = 1.0F;
    return material;
}

inline LayeredMaterial coated(float alpha) {
    LayeredMaterial material = dielectric(alpha, 0.8F);
    material.coat = 1.0F;
    return material;
}

inline LayeredMaterial pane(float alpha) {
    LayeredMaterial material = dielectric(alpha, 1.0F);
    material.transmission = 1.0F;
    material.flags = LAYERED_THIN;
    return material;
}

inline LayeredMaterial glass(float alpha) {
    LayeredMaterial material = dielectric(alpha, 1.0F);
    material.transmission = 1.0F;
    return material;
}

inline SeenLobes lobes_of(const LayeredMaterial& material, float cosine,
                          native::FacetChoice choice = middle) {
    const float3 v = direction(cosine);
    const LayeredBsdf bsdf = native::make_layered(&material, v);
    SeenLobes lobes = native::no_lobes();
    native::find_layered_lobes(&bsdf, v, choice, &lobes);
    return lobes;
}

}  // namespace weft::seen_materials

#endif
