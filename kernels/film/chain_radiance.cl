// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Turns the irradiance of the ends of view_chains.cl, in place, into the radiance that pixels show
// in mirrors, or through glass. One work-item per pixel.
#include "kernels/bsdf/lambert.h"
#include "kernels/core/kernel.h"
#include "kernels/core/vector.h"

WEFT_KERNEL(chain_radiance)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    float3 radiance = xyz(end_emission[pixel]);
    if (end_albedo[pixel].w > 0.0f)
        radiance += LAMBERT_REFLECTANCE(xyz(end_albedo[pixel])) * xyz(light[pixel]);
    light[pixel] = f4(radiance.x, radiance.y, radiance.z, 1.0f);
}
