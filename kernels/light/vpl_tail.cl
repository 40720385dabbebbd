// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Gives the VPLs of the last bounce the light of all bounces that would follow. From bounce to
// bounce light falls by about the same factor r, so that all that follows the last bounce, with it,
// is 1 / (1 - r) times what that has. r is measured in each channel over all bounces: the last ones
// have so few VPLs that the sum would be too high on average. In a closed room of one reflectance r
// is that reflectance, and the sum is exact. One work-item.
#include "kernels/core/kernel.h"
#include "kernels/core/vector.h"

// Paths in brighter rooms would go on too long for what their few last VPLs tell.
#define LARGEST_RATIO 0.95f

/// Flux of the VPL, which on a surface is stored over pi.
static inline float3 whole_flux(GLOBAL const Vpl* vpl) {
    float3 flux = xyz(vpl->flux);
    return as_bits(vpl->normal.w) == VPL_MEDIUM ? flux : flux * M_ONE_PI;
}

/// Flux of the VPLs of a bounce, of all sets.
static inline float3 flux_of_bounce(const RenderParams* params, GLOBAL const Vpl* vpls,
                                    uint bounce) {
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    for (uint set = 0u; set < params->sampling.sets; ++set) {
        GLOBAL const Vpl* first =
            vpls + set * params->sampling.walked_per_set + params->sampling.first_vpl[bounce];
        for (uint i = 0u; i < params->sampling.survivors[bounce]; ++i) sum += whole_flux(first + i);
    }
    return sum;
}

/// 1 / (1 - r) for the ratio r of two sums of light.
static inline float tail_factor(float after, float before) {
    if (!(after > 0.0f && before > after * 1e-30f)) return 1.0f;
    return 1.0f / (1.0f - m_min(after / before, LARGEST_RATIO));
}

WEFT_KERNEL(vpl_tail)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint last = params.sampling.bounces - 1u;
    float3 before = f3(0.0f, 0.0f, 0.0f);
    float3 after = before;
    for (uint bounce = 0u; bounce <= last; ++bounce) {
        float3 flux = flux_of_bounce(&params, vpls, bounce);
        if (bounce > 0u) after += flux;
        if (bounce < last) before += flux;
    }
    float3 factor = f3(tail_factor(after.x, before.x), tail_factor(after.y, before.y),
                       tail_factor(after.z, before.z));
    for (uint set = 0u; set < params.sampling.sets; ++set) {
        GLOBAL Vpl* vpl =
            vpls + set * params.sampling.walked_per_set + params.sampling.first_vpl[last];
        for (uint i = 0u; i < params.sampling.survivors[last]; ++i) {
            float4 flux = vpl[i].flux;
            vpl[i].flux = f4(flux.x * factor.x, flux.y * factor.y, flux.z * factor.z, flux.w);
        }
    }
}
